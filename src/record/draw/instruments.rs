//! Pictures of a whole run, step by step.

use super::flip_map::FlipMap;
use super::lanes::{LaneRows, Lanes};
use super::palette::Palette;
use super::raster::{Raster, RasterRows};
use super::reduce::Blocks;
use super::ritz::RitzCurves;
use super::ruler::Ruler;
use super::step_image::StepImage;
use super::waterfall::Waterfall;
use crate::contact::{Contact, Observer, Problem, Solver, Step, Stop, Work};
use crate::diagnosis::{Bands, ContactHistory, Diagnosis, Findings, Reference};
use crate::grid::Grid;
use crate::plot::{Axis, Frame};
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};
use std::sync::Arc;

/// Images are recorded anew whenever so many times as many steps have come.
const GROWTH: usize = 2;
/// Steps after which they are recorded first.
const FIRST: usize = 16;

/// The pictures of a run of one scene; none are there that are not asked for.
pub struct Instruments {
    root: String,
    what: Parts,
    grid: Grid,
    contact_modulus: f64,
    reference: Option<Arc<Reference>>,
    /// The raster of a line, or those along a row and a column of a surface, with their titles.
    pub rasters: Vec<(String, Raster)>,
    pub flips: Option<FlipMap>,
    /// Waterfalls with their titles.
    pub waterfalls: Vec<(&'static str, Waterfall)>,
    pub lanes: Option<Lanes>,
}

impl Instruments {
    /// The instruments that `options` ask for, beside pictures of a surface in a frame.
    pub fn new(scene: &Scene<'_>, root: &str, options: &Options, frame: &Frame) -> Option<Self> {
        let Options { what, theme, .. } = options;
        if !what.has_instruments() {
            return None;
        }
        let (problem, palette) = (scene.problem, Palette::of(*theme));
        let grid = *problem.surface().grid();
        let is_mapped = what.has(Part::Raster) && !grid.is_line();
        let map = || FlipMap::new(format!("{root}/flips"), palette, frame.clone(), Blocks::image(&grid));
        Some(Self {
            rasters: if what.has(Part::Raster) { rasters(problem, root, options) } else { Vec::new() },
            flips: is_mapped.then(map),
            waterfalls: waterfalls(scene, root, options),
            lanes: what.has(Part::Decisions).then(|| Lanes::new(root, palette)),
            reference: scene.reference.clone().filter(|_| what.has(Part::Waterfall)),
            contact_modulus: problem.contact_modulus(),
            root: root.into(),
            what: *what,
            grid,
        })
    }

    /// The entity of the curves of Ritz values, if they are recorded.
    pub fn ritz(&self) -> Option<String> {
        self.what.has(Part::Ritz).then(|| format!("{}/ritz", self.root))
    }

    /// The images whose columns are steps.
    fn images(&self) -> impl Iterator<Item = &StepImage> {
        let rasters = self.rasters.iter().map(|(_, raster)| &raster.image);
        let waterfalls = self.waterfalls.iter().map(|(_, waterfall)| &waterfall.image);
        rasters.chain(waterfalls).chain(self.lanes.iter().map(|lanes| &lanes.image))
    }

    /// Gives each picture the proportions of its pane, whose size in points `pane` tells by the root of the picture.
    pub fn fit(&mut self, pane: impl Fn(&str) -> Option<[f64; 2]>) {
        let rasters = self.rasters.iter_mut().map(|(_, raster)| &mut raster.image);
        let waterfalls = self.waterfalls.iter_mut().map(|(_, waterfall)| &mut waterfall.image);
        for image in rasters.chain(waterfalls).chain(self.lanes.iter_mut().map(|lanes| &mut lanes.image)) {
            if let Some(size) = pane(&image.root) {
                image.fit(size);
            }
        }
        if let Some(map) = &mut self.flips
            && let Some(size) = pane(&map.root)
        {
            map.fit(size);
        }
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.rasters.iter().try_for_each(|(_, raster)| raster.log_static(to))?;
        self.lanes.as_ref().map_or(Ok(()), |lanes| lanes.log_static(to))?;
        self.ritz().map_or(Ok(()), |entity| RitzCurves::new(entity).log_static(to))?;
        self.images().try_for_each(|image| image.log_cursor_style(to))
    }

    /// What a run of the scene collects for them.
    pub fn readings(&self) -> Readings {
        let diagnosis = Diagnosis::on(&self.grid, self.contact_modulus, self.reference.clone());
        Readings {
            diagnosis: if self.what.has(Part::Energy) { diagnosis.with_energies() } else { diagnosis },
            rasters: self.rasters.iter().map(|(_, raster)| raster.rows()).collect(),
            lanes: self.lanes.as_ref().map(Lanes::rows),
            ritz: self.ritz().map(RitzCurves::new),
            passed: Vec::new(),
            steps: 0,
            shown: FIRST,
        }
    }
}

/// What a run has shown so far.
pub struct Readings {
    diagnosis: Diagnosis,
    rasters: Vec<RasterRows>,
    lanes: Option<LaneRows>,
    ritz: Option<RitzCurves>,
    /// The steps since the last flush, for the lines at the current step.
    passed: Vec<(Work, f32)>,
    steps: usize,
    /// Steps at which images are recorded next.
    shown: usize,
}

impl Readings {
    /// Adds a step on a grid level.
    pub fn add(
        &mut self,
        to: &RecordingStream,
        instruments: &Instruments,
        step: &Step<'_>,
        level: usize,
    ) -> RecordingStreamResult<()> {
        self.diagnosis.step(step).ok(); // it neither fails nor ends a run
        let contact = self.diagnosis.contact();
        instruments.rasters.iter().zip(&mut self.rasters).for_each(|((_, raster), rows)| raster.add(contact, rows));
        if let Some(lanes) = &mut self.lanes {
            lanes.add(step, level, self.diagnosis.change());
        }
        if let (Some(curves), Some(values)) = (&mut self.ritz, self.diagnosis.ritz()) {
            curves.add(step.work(), values);
        }
        self.passed.push((step.work(), step.work().iterations as f32 + 0.5));
        self.steps += 1;
        if self.steps < self.shown {
            return Ok(());
        }
        self.shown *= GROWTH;
        self.show(to, instruments)
    }

    /// Begins with what the solver says of itself.
    pub fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) {
        self.diagnosis.begin(solver, problem, stop).ok(); // it does not fail
    }

    /// The contact so far.
    pub fn contact(&self) -> &ContactHistory {
        self.diagnosis.contact()
    }

    /// Records the images of the steps so far.
    fn show(&mut self, to: &RecordingStream, instruments: &Instruments) -> RecordingStreamResult<()> {
        for ((_, raster), rows) in instruments.rasters.iter().zip(&self.rasters) {
            raster.log(to, rows)?;
        }
        if let (Some(lanes), Some(rows)) = (&instruments.lanes, &self.lanes) {
            lanes.log(to, rows)?;
        }
        let history = self.diagnosis.spectrogram().history();
        for (_, waterfall) in &instruments.waterfalls {
            waterfall.log(to, history)?;
        }
        instruments.flips.as_ref().map_or(Ok(()), |map| map.log(to, self.diagnosis.contact().flips()))
    }

    /// Sends lanes and curves so far.
    pub fn flush(&mut self, to: &RecordingStream, instruments: &Instruments) -> RecordingStreamResult<()> {
        if !self.passed.is_empty() {
            instruments.images().try_for_each(|image| image.send_cursor(to, &self.passed))?;
            self.passed.clear();
        }
        if let (Some(lanes), Some(rows)) = (&instruments.lanes, &mut self.lanes) {
            lanes.flush(to, rows)?;
        }
        self.ritz.as_mut().map_or(Ok(()), |curves| curves.flush(to))
    }

    /// Ends with the contact that came out, and returns what held the run up.
    pub fn end(
        &mut self,
        to: &RecordingStream,
        instruments: &Instruments,
        contact: &Contact,
    ) -> RecordingStreamResult<Findings> {
        self.diagnosis.end(contact).ok(); // it does not fail
        if let Some(lanes) = &mut self.lanes {
            lanes.end(contact);
        }
        self.show(to, instruments)?;
        self.flush(to, instruments)?;
        Ok(self.diagnosis.findings())
    }
}

/// The raster of a line, or those along a row and a column.
fn rasters(problem: &Problem, root: &str, options: &Options) -> Vec<(String, Raster)> {
    let (grid, palette) = (problem.surface().grid(), Palette::of(options.theme));
    let [ny, nx] = grid.shape();
    let axis = |i: usize| Ruler::new(["y", "x"][i], &options.length_unit, [0.0, grid.size()[i]]).axis;
    if grid.is_line() {
        let raster = Raster::new(format!("{root}/raster"), palette, axis(1), (0..nx).collect());
        return vec![("Contact by step (yellow: entered, blue: left)".into(), raster)];
    }
    let height = problem.height();
    let highest = (0..height.len()).fold(0, |best, node| if height[node] > height[best] { node } else { best });
    let [row, column] = options.raster_at.unwrap_or([highest / nx, highest % nx]);
    let along = |name: &str, at: usize, axis: Axis, nodes: Vec<usize>| {
        let raster = Raster::new(format!("{root}/raster_{name}"), palette, axis, nodes);
        (format!("Contact by step along {name} {at} (yellow: entered, blue: left)"), raster)
    };
    vec![
        along("row", row, axis(1), (0..nx).map(|x| row * nx + x).collect()),
        along("column", column, axis(0), (0..ny).map(|y| y * nx + column).collect()),
    ]
}

/// The waterfalls of errors, if there is a state to hold them against, and of energies.
fn waterfalls(scene: &Scene<'_>, root: &str, options: &Options) -> Vec<(&'static str, Waterfall)> {
    let (problem, palette) = (scene.problem, Palette::of(options.theme));
    let bands = Bands::of(problem.surface().grid());
    let longest = problem.surface().grid().longest_wavelength();
    let shortest = longest * 0.5f64.powf(0.5 * bands.half_octaves().len() as f64);
    let unit = Ruler::new("wavelength", &options.length_unit, [0.0, longest]);
    let axis = || Axis::log(unit.axis.name.as_str(), [shortest, longest].map(|length| length / unit.unit));
    let energy = problem.expected_mean_pressure() * problem.rms_height();
    let mut waterfalls = Vec::new();
    if options.what.has(Part::Waterfall) && scene.reference.is_some() {
        let new = |name: &str, of| {
            Waterfall::new(format!("{root}/error_{name}"), palette, ("log10 error", 1.0), &bands, axis(), of)
        };
        waterfalls.push(("Error of the pressure by wavelength", new("pressure", |row| &row.pressure)));
        waterfalls.push(("Error of the displacement by wavelength", new("displacement", |row| &row.displacement)));
    }
    if options.what.has(Part::Energy) {
        let name = ("log10 energy / (p_mean h_rms)", energy);
        let energy = Waterfall::new(format!("{root}/energy"), palette, name, &bands, axis(), |row| &row.energy);
        waterfalls.push(("Elastic energy by wavelength", energy));
    }
    waterfalls
}
