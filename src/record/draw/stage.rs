//! A scene, prepared for recording.

use super::chart::ghost::Ghost;
use super::chart::load_axis::LoadAxis;
use super::chart::traces::ExactValues;
use super::curve_ends::CurveEnds;
use super::drawing::{Drawing, Place, RunDrawing, Subject};
use super::field::{further, zone};
use super::fields::{FieldExtent, FrameFields};
use super::ink::canvas;
use super::ink::line_plane::caption;
use super::ink::palette::Palette;
use super::ink::pane::Pane;
use super::parts;
use super::patch::patch_map::PatchMap;
use super::patch::patch_tree::PatchTreePicture;
use super::plane::Plane;
use crate::contact::{Contact, Phase, Quantity, Reading, Readings};
use crate::diagnosis::{Diagnosis, Reference};
use crate::grid::Grid;
use crate::record::description;
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::properties;
use crate::record::scene::Scene;
use crate::record::setups::SETUP;
use crate::setup::Part;
use rerun::{AnyValues, RecordingStream, RecordingStreamResult, TextDocument};
use std::sync::{Arc, Mutex, PoisonError};

/// The drawings of a scene and the other data for its recorder and its layout, without the problem itself.
pub(crate) struct Stage {
    /// Root of the entities, with a leading `/`.
    pub root: String,
    pub title: String,
    pub palette: &'static Palette,
    /// Rows of the table of parameters.
    description: String,
    /// The properties of the scene, for tables of recordings.
    properties: AnyValues,
    /// The setup that repeats it, if there is one, as TOML.
    setup: Option<String>,
    pub grid: Grid,
    /// Parts that are recorded.
    pub what: Parts,
    pub exact: ExactValues,
    /// Whether an earlier solve stands beside it.
    pub has_ghost: bool,
    /// The highest pressure that is expected.
    pub highest_pressure: f64,
    ends: Mutex<CurveEnds>,
    drawings: Vec<Box<dyn Drawing>>,
    plane: Plane,
    contact_modulus: f64,
    /// The reference state for errors by wavelength.
    reference: Option<Arc<Reference>>,
    /// The map of contact patches over loads, once there are loads.
    pub patches: Option<PatchMap>,
    /// The tree of contact patches over loads, if they are followed.
    pub tree: Option<PatchTreePicture>,
    /// Height of the window that the pictures are drawn for, in points.
    pub window_height: f64,
}

impl Stage {
    /// The stage of a scene whose entities lie under `root`; `place` is that of the scene among several.
    pub(crate) fn new(scene: &Scene<'_>, root: String, options: &Options, place: Option<usize>) -> Self {
        let grid = *scene.problem.surface().grid();
        let options = Options { what: options.what.and(Parts::on(&grid)), ..options.clone() };
        let (forecast, palette) = (scene.forecast(), Palette::new(options.theme));
        let exact = scene.exact.as_ref();
        let kappa_r = exact.and_then(|exact| exact.kappa_r);
        let plane = Plane::new(scene, &root, &options);
        let subject = Subject { scene, forecast, root: &root, options: &options, palette, plane: &plane, place };
        let rows = parts::all().filter(|row| options.what.has(row.part));
        let has_fields = options.what.has(Part::Fields);
        let further = if has_fields { further::draw(&subject) } else { Vec::new() };
        let zone = if has_fields { zone::draw(&subject) } else { None };
        Self {
            title: scene.title.clone(),
            palette,
            description: description::of_scene(scene, &options.units()),
            properties: properties::of_scene(scene),
            setup: scene.text(),
            what: options.what,
            grid,
            exact: [kappa_r, exact.map(|exact| exact.relative_area)],
            has_ghost: options.ghost.is_some(),
            highest_pressure: forecast.max_pressure,
            ends: Mutex::new(CurveEnds::before(kappa_r, forecast, scene.reduced_pressure())),
            drawings: rows.filter_map(|row| (row.draw)(&subject)).chain(further).chain(zone).collect(),
            plane,
            contact_modulus: scene.problem.contact_modulus(),
            reference: scene.reference.clone(),
            patches: None,
            tree: None,
            window_height: options.window[1],
            root,
        }
    }

    /// The upper ends of axes of curves.
    pub(crate) fn ends(&self) -> CurveEnds {
        *self.ends.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether no setup describes the scene, as for results of other codes, which may have a single step.
    pub(crate) fn is_of_other_code(&self) -> bool {
        self.setup.is_none()
    }

    /// Fits the axes of curves to the end of a run, and returns whether that was necessary: the layout must then be sent again.
    pub(crate) fn fit_curves(&self, contact: &Reading<'_>) -> bool {
        let (ends, kappa_r) = (CurveEnds::after(contact), contact.resolved().kappa_r);
        let is_known = kappa_r > 0.0 && kappa_r.is_finite();
        let is_needed = is_known && !ends.are_read_on(&self.ends());
        if is_needed {
            *self.ends.lock().unwrap_or_else(PoisonError::into_inner) = ends;
        }
        is_needed
    }

    /// Adds the map of contact patches of a line under `loads`, if contacts are recorded.
    pub(crate) fn map_patches(&mut self, loads: &LoadAxis) {
        if let (Plane::Line(plane), true) = (&self.plane, self.what.has(Part::Mask)) {
            self.patches = Some(PatchMap::new(plane, loads));
        }
    }

    /// Adds the tree of contact patches under `loads`, if contacts are recorded.
    pub(crate) fn follow_patches(&mut self, loads: &LoadAxis) {
        self.tree = self.what.has(Part::Mask).then(|| PatchTreePicture::new(&self.root, self.palette, loads));
    }

    /// The panes of the drawings that stand in some places.
    pub(crate) fn panes(&self, places: &[Place]) -> Vec<(Place, Pane)> {
        let panes = self.drawings.iter().flat_map(|drawing| drawing.panes());
        panes.filter(|(place, _)| places.contains(place)).collect()
    }

    /// Gives each picture the proportions of its pane, whose width and height in points `size` finds by the root of the picture; the
    /// flat pictures of the fields have the root of the scene.
    pub(crate) fn fit(&mut self, size: impl Fn(&str) -> Option<[f64; 2]>) {
        if let Some(size) = size(&self.root) {
            self.plane.fit(size);
            self.patches.iter_mut().for_each(|map| map.fit(size));
        }
        if let Some(tree) = &mut self.tree
            && let Some(size) = size(tree.root())
        {
            tree.fit(size);
        }
        self.drawings.iter_mut().for_each(|drawing| drawing.fit(&size));
    }

    /// Records everything that stays.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        if let Some(setup) = &self.setup {
            to.log_static(format!("{}/{SETUP}", self.root), &TextDocument::new(setup.as_str()))?;
        }
        properties::send(to, &self.root, &self.properties)?;
        self.patches.as_ref().map_or(Ok(()), |patches| patches.log_static(to))?;
        self.tree.as_ref().map_or(Ok(()), |tree| tree.log_static(to))?;
        self.drawings.iter().try_for_each(|drawing| drawing.log_static(to))
    }

    /// Records an earlier solve, for the parts that this scene also shows.
    pub(crate) fn log_ghost(&self, to: &RecordingStream, ghost: &Ghost) -> RecordingStreamResult<()> {
        if self.what.has(Part::Traces) {
            ghost.log(to, &self.root)?;
        }
        let Some(pressure) = &ghost.pressure else { return Ok(()) };
        self.drawings.iter().try_for_each(|drawing| drawing.log_earlier(to, pressure))
    }

    /// The collectors of the drawings for a run.
    pub(crate) fn runs(&self) -> impl Iterator<Item = Box<dyn RunDrawing>> {
        self.drawings.iter().filter_map(|drawing| drawing.run())
    }

    /// The diagnosis of a run, if an instrument is recorded.
    pub(crate) fn diagnosis(&self) -> Option<Diagnosis> {
        let reference = self.reference.clone().filter(|_| self.what.has(Part::Waterfall));
        let diagnosis = Diagnosis::on(&self.grid, self.contact_modulus, reference);
        let diagnosis = if self.what.has(Part::Energy) { diagnosis.with_energies() } else { diagnosis };
        self.what.has_instruments().then_some(diagnosis)
    }

    /// The end of a run and the error of its grid, in words.
    pub(crate) fn result(contact: &Contact, reading: &Reading<'_>) -> String {
        let Contact { status, certificate, work, .. } = contact;
        let how = if contact.is_converged() { status.to_string() } else { format!("not converged ({status})") };
        let [kappa_r, error] = [Quantity::KappaR, Quantity::KappaRError].map(|it| reading.value(it));
        let grid = match error.is_nan() || kappa_r.is_nan() {
            true => String::new(),
            false => format!(". kappa_r is {kappa_r:.4}, with an error of about {:.1} % on this grid", 100.0 * error),
        };
        let certified = match Quantity::Certificate.tells_of(contact) {
            true => format!(" with the certificate {:.2e}", certificate.eta),
            false => String::new(),
        };
        format!(
            "{how}{certified}, after {} steps, {} transforms and {:.3} s{grid}",
            work.iterations, work.transforms, work.seconds
        )
    }

    /// The description with a result, and further rows on the run.
    pub(crate) fn described(&self, result: &str, run: &str) -> TextDocument {
        let rows = &self.description;
        TextDocument::from_markdown(format!("**Result**: {result}\n\n{}{rows}{run}", description::HEAD))
    }

    pub(crate) fn description(&self) -> String {
        format!("{}/description", self.root)
    }

    /// Records a state at the current time.
    pub(crate) fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        self.drawings.iter().try_for_each(|drawing| drawing.log_frame(to, fields))
    }

    /// Records what is found for a contact and not for the steps before it, at the current time.
    pub(crate) fn log_contact(&self, to: &RecordingStream, contact: &Contact) -> RecordingStreamResult<()> {
        self.drawings.iter().try_for_each(|drawing| drawing.log_contact(to, contact))
    }

    /// The ranges of the axes that are needed to show a state.
    pub(crate) fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        self.drawings.iter().map(|drawing| drawing.extent(fields)).fold(FieldExtent::NONE, FieldExtent::and)
    }

    /// Fits axes and scales to some states, for all times.
    pub(crate) fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        self.drawings.iter().try_for_each(|drawing| drawing.settle(to, extent))
    }

    /// Records again what cannot be stretched of a state, at the current time; `all` is the reach of all states.
    pub(crate) fn redraw(
        &self,
        to: &RecordingStream,
        fields: &FrameFields<'_>,
        all: &FieldExtent,
    ) -> RecordingStreamResult<()> {
        self.drawings.iter().try_for_each(|drawing| drawing.redraw(to, fields, all))
    }

    /// Records words above the pictures at the current time.
    pub(crate) fn log_caption(&self, to: &RecordingStream, words: &str) -> RecordingStreamResult<()> {
        to.log(caption(&self.root), &canvas::caption(self.palette, self.plane.frame(), words))
    }

    /// The place of the solver in its scheme, in words.
    pub(crate) fn caption(&self, phase: Phase, stride: [usize; 2]) -> String {
        let [ny, nx] = [0, 1].map(|axis| self.grid.shape()[axis] / stride[axis]);
        let points = if self.grid.is_line() { format!("{nx} points") } else { format!("{ny} x {nx}") };
        let Phase { outer, inner, .. } = phase;
        let inner = if inner > 0 { format!(", inner step {inner}") } else { String::new() };
        format!("{points}, outer step {outer}{inner}")
    }
}

/// The level of a grid with every `stride`-th node.
pub(crate) fn level(stride: [usize; 2]) -> usize {
    stride[0].max(stride[1]).ilog2() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coarser_side_decides_the_level() {
        assert_eq!([[1, 1], [4, 4], [1, 8]].map(level), [0, 2, 3]);
    }
}
