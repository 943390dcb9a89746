//! A scene, prepared for recording.

use super::below::StressPicture;
use super::canvas;
use super::density::DensityPicture;
use super::fields::{Extent, Fields};
use super::ghost::Ghost;
use super::instruments::Instruments;
use super::line::LinePicture;
use super::load_axis::LoadAxis;
use super::mirror::MeasuredPart;
use super::palette::Palette;
use super::patches::PatchMap;
use super::picture::Picture;
use super::spectrum::SpectrumPicture;
use super::surface::SurfacePicture;
use super::traces::{self, ExactValues};
use crate::contact::{Contact, Observables, Phase, Resolved};
use crate::grid::Grid;
use crate::record::description;
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::properties;
use crate::record::scene::Scene;
use crate::record::setups::SETUP;
use crate::setup::Part;
use rerun::{AnyValues, RecordingStream, RecordingStreamResult, TextDocument};
use std::sync::{Mutex, PoisonError};

/// `kappa_r` of rough surfaces, where no exact value is known.
const KAPPA_R: f64 = 1.6;
/// The end of the axis of a curve that settles over its last value.
const ROOM: f64 = 1.6;
/// The end of an axis over the last value of a curve from which on the curve is too flat to be read.
const FLAT: f64 = 4.0;
/// The largest ratio of a relative area to its forecast that is common.
const DOUBT: f64 = 1.5;
/// The end of an axis of the relative area of full contact.
const WHOLE: f64 = 1.05;

/// The drawings of a scene and all else that its recorder and its layout need, without the problem itself.
pub struct Stage {
    /// Root of the entities, with a leading `/`.
    pub root: String,
    pub title: String,
    pub palette: &'static Palette,
    /// Rows of the table of parameters.
    description: String,
    /// What is known of the scene, for tables of recordings.
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
    ends: Mutex<Ends>,
    pub picture: Box<dyn Picture>,
    /// Pictures of the whole run, if they are asked for.
    pub instruments: Option<Instruments>,
    /// The power spectra, if they are asked for.
    pub spectrum: Option<SpectrumPicture>,
    /// The density of the error, if it is asked for.
    pub density: Option<DensityPicture>,
    /// The stress below, if it is asked for.
    pub below: Option<StressPicture>,
    /// The map of contact patches over loads, once there are loads.
    pub patches: Option<PatchMap>,
    /// The part that was measured, if the rest is its mirror image.
    measured: Option<MeasuredPart>,
    /// Height of the window that the pictures are drawn for, in points.
    pub window_height: f64,
}

/// Upper ends of axes of curves that settle, known before solving so that the first steps do not dwarf the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    pub kappa_r: f64,
    pub relative_area: f64,
    /// That of `kappa`, where the reduced pressure is known.
    pub kappa: Option<f64>,
}

impl Ends {
    /// The ends for curves that settle at some `kappa_r` and relative area.
    fn new(kappa_r: f64, relative_area: f64, reduced_pressure: Option<f64>) -> Self {
        let area = ROOM * relative_area;
        Self {
            kappa_r: ROOM * kappa_r,
            relative_area: area.min(WHOLE),
            kappa: reduced_pressure.map(|load| area / load),
        }
    }

    /// Whether curves that would have these ends can be read on axes with the ends of `other`.
    fn are_read_on(&self, other: &Self) -> bool {
        let is_read = |own: f64, other: f64| (own / ROOM..=own * FLAT / ROOM).contains(&other);
        is_read(self.kappa_r, other.kappa_r) && is_read(self.relative_area, other.relative_area)
    }
}

impl Stage {
    pub fn new(scene: &Scene<'_>, root: String, options: &Options) -> Self {
        let grid = *scene.problem.surface().grid();
        let options = Options { what: options.what.and(Parts::on(&grid)), ..options.clone() };
        let forecast = scene.forecast();
        let exact = scene.exact.as_ref();
        let kappa_r = exact.and_then(|exact| exact.kappa_r);
        let palette = Palette::of(options.theme);
        let picture: Box<dyn Picture> = if grid.is_line() {
            Box::new(LinePicture::new(scene, forecast, &root, &options))
        } else {
            Box::new(SurfacePicture::new(scene, forecast, &root, &options))
        };
        Self {
            title: scene.title.clone(),
            palette,
            description: description::of_scene(scene, &options.length_unit),
            properties: properties::of_scene(scene),
            setup: scene.setup.as_ref().map(|setup| setup.clone().with_full_path().to_toml()),
            what: options.what,
            grid,
            exact: [kappa_r, exact.map(|exact| exact.relative_area)],
            has_ghost: options.ghost.is_some(),
            highest_pressure: forecast.max_pressure,
            ends: Mutex::new(Ends::new(
                kappa_r.unwrap_or(KAPPA_R),
                DOUBT * forecast.relative_area,
                properties::reduced_pressure(scene.problem),
            )),
            instruments: Instruments::new(scene, &root, &options, picture.frame()),
            picture,
            spectrum: options.what.has(Part::Spectrum).then(|| SpectrumPicture::new(scene, palette, &root)),
            density: options.what.has(Part::Error).then(|| DensityPicture::new(scene, &root, &options)),
            below: StressPicture::new(scene, forecast, &root, &options),
            patches: None,
            measured: MeasuredPart::of(scene),
            window_height: options.window[1],
            root,
        }
    }

    /// The upper ends of axes of curves.
    pub fn ends(&self) -> Ends {
        *self.ends.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Fits the axes of curves to the end of a run, and returns whether that was necessary: the layout must then be sent again.
    pub fn fit_curves(&self, contact: &Contact) -> bool {
        let Resolved { kappa_r, relative_area, .. } = contact.resolved();
        let reduced_pressure = contact.counted().reduced_pressure;
        let ends = Ends::new(kappa_r, relative_area, Some(reduced_pressure));
        let is_known = kappa_r > 0.0 && kappa_r.is_finite();
        let is_needed = is_known && !ends.are_read_on(&self.ends());
        if is_needed {
            *self.ends.lock().unwrap_or_else(PoisonError::into_inner) = ends;
        }
        is_needed
    }

    /// Adds the map of contact patches of a line under `loads`, if contacts are recorded.
    pub fn map_patches(&mut self, loads: &LoadAxis) {
        let is_mapped = self.grid.is_line() && self.what.has(Part::Mask);
        self.patches = is_mapped
            .then(|| PatchMap::new(self.picture.frame(), self.palette, &self.root, loads.clone(), self.measured));
    }

    /// Gives each picture the proportions of its pane, whose size in points `pane` tells by the root of the picture; the pictures of
    /// the fields have the root of the scene.
    pub fn fit(&mut self, pane: impl Fn(&str) -> Option<[f64; 2]>) {
        if let Some(size) = pane(&self.root) {
            self.picture.fit(size);
        }
        if let Some(size) = self.picture.relief().and_then(|(root, _)| pane(root)) {
            self.picture.fit_relief(size);
        }
        if let Some(map) = &mut self.patches {
            map.fit(self.picture.frame());
        }
        if let Some(instruments) = &mut self.instruments {
            instruments.fit(&pane);
        }
        if let Some(spectrum) = &mut self.spectrum
            && let Some(size) = pane(spectrum.root())
        {
            spectrum.fit(size);
        }
        if let Some(density) = &mut self.density
            && let Some(size) = pane(density.root())
        {
            density.fit(size);
        }
        let below = self.below.as_ref().and_then(|below| below.images().find_map(|(_, image)| pane(&image.root)));
        if let (Some(below), Some(size)) = (&mut self.below, below) {
            below.fit(size);
        }
    }

    /// Records everything that stays; `place` is that of the scene among several.
    pub fn log_static(&self, to: &RecordingStream, place: Option<usize>) -> RecordingStreamResult<()> {
        let Self { root, title, .. } = self;
        if let Some(setup) = &self.setup {
            to.log_static(format!("{root}/{SETUP}"), &TextDocument::new(setup.as_str()))?;
        }
        properties::send(to, root, &self.properties)?;
        if self.what.has(Part::Mask) {
            to.log_static(root.as_str(), &self.palette.classes())?;
        }
        if self.what.has(Part::Traces) {
            traces::log_styles(to, root, self.exact, place.map(|place| (place, title.as_str())))?;
        }
        if let Some(instruments) = &self.instruments {
            instruments.log_static(to)?;
        }
        if let Some(spectrum) = &self.spectrum {
            spectrum.log_static(to)?;
        }
        if let Some(density) = &self.density {
            density.log_static(to)?;
        }
        if let Some(below) = &self.below {
            below.log_static(to)?;
        }
        if let Some(patches) = &self.patches {
            patches.log_static(to)?;
        }
        self.picture.log_static(to)
    }

    /// Records an earlier solve, as far as this one shows the same.
    pub fn log_ghost(&self, to: &RecordingStream, ghost: &Ghost) -> RecordingStreamResult<()> {
        if self.what.has(Part::Traces) {
            ghost.log(to, &self.root)?;
        }
        let pressure = ghost.pressure.as_deref().filter(|_| self.what.has(Part::Fields));
        pressure.map_or(Ok(()), |pressure| self.picture.log_ghost(to, pressure))
    }

    /// The end of a run and how good its grid is, in words.
    pub fn result(contact: &Contact) -> String {
        let Contact { status, certificate, work, .. } = contact;
        let how = if contact.is_converged() { status.to_string() } else { format!("not converged ({status})") };
        let Observables { kappa_r, kappa_r_error: error, .. } = Observables::of(contact);
        let grid = match error.is_nan() {
            true => String::new(),
            false => format!(". kappa_r is {kappa_r:.4}, within about {:.1} % on this grid", 100.0 * error),
        };
        format!(
            "{how} at a certificate of {:.2e}, after {} steps, {} transforms and {:.3} s{grid}",
            certificate.eta, work.iterations, work.transforms, work.seconds
        )
    }

    /// The description with a result, and further rows on the run.
    pub fn described(&self, result: &str, run: &str) -> TextDocument {
        let rows = &self.description;
        TextDocument::from_markdown(format!("**Result**: {result}\n\n{}{rows}{run}", description::HEAD))
    }

    pub fn description(&self) -> String {
        format!("{}/description", self.root)
    }

    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        if let Some(spectrum) = &self.spectrum {
            spectrum.log_frame(to, fields)?;
        }
        if let Some(density) = &self.density {
            density.log_frame(to, fields)?;
        }
        if let Some(below) = &self.below {
            below.log_frame(to, fields)?;
        }
        self.picture.log_frame(to, fields)
    }

    /// The reach of the fields of a state.
    pub fn extent(&self, fields: &Fields<'_>) -> Extent {
        let shear = self.below.as_ref().map_or(0.0, |below| below.extent(fields));
        Extent { shear, ..self.picture.extent(fields) }
    }

    /// Fits axes and scales to some states, for all times.
    pub fn settle(&self, to: &RecordingStream, extent: Extent) -> RecordingStreamResult<()> {
        if let Some(below) = &self.below {
            below.settle(to, extent.shear)?;
        }
        self.picture.settle(to, extent)
    }

    /// Records words above the pictures at the current time.
    pub fn log_caption(&self, to: &RecordingStream, words: &str) -> RecordingStreamResult<()> {
        to.log(self.caption_entity(), &canvas::caption(self.palette, self.picture.frame(), words))
    }

    pub fn caption_entity(&self) -> String {
        format!("{}/caption", self.root)
    }

    /// The place of the solver in its scheme, in words.
    pub fn caption(&self, phase: Phase, stride: [usize; 2]) -> String {
        let [ny, nx] = [0, 1].map(|axis| self.grid.shape()[axis] / stride[axis]);
        let points = if self.grid.is_line() { format!("{nx} points") } else { format!("{ny} x {nx}") };
        let Phase { outer, inner, .. } = phase;
        let inner = if inner > 0 { format!(", inner step {inner}") } else { String::new() };
        format!("{points}, outer step {outer}{inner}")
    }
}

/// The level of a grid with every `stride`-th node.
pub fn level(stride: [usize; 2]) -> usize {
    stride[0].max(stride[1]).ilog2() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_told_by_the_coarser_side() {
        assert_eq!([[1, 1], [4, 4], [1, 8]].map(level), [0, 2, 3]);
    }
}
