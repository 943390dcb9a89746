//! Numbers of every step, sent column by column.

use super::observable_traces::{
    COMPARED, ObservableTraces, Trace, drawn, is_logarithmic, recorded, times, title, traced,
};
use crate::contact::{Contact, Energy, Phase, Quantity, Work};
use crate::plot::Colour;
use crate::record::draw::drawing::{Drawing, Place, RunDrawing, RunStep, Subject};
use crate::record::draw::ink::palette::{self, SERIES};
use crate::record::draw::ink::pane::Pane;
use rerun::{RecordingStream, RecordingStreamResult, Scalars, SeriesLines, SeriesPoints};

/// Observables that count nodes, drawn faintly beside those whose edges are resolved.
const COUNTED: [Quantity; 2] = [Quantity::KappaRCounted, Quantity::RelativeAreaCounted];

/// Widths of curves: on coarse grids, whose values may leave the axis, and on the finest one.
const COARSE_WIDTH: f32 = 0.7;
const FINE_WIDTH: f32 = 1.8;
/// The width of what stands in the background.
const FAINT_WIDTH: f32 = 1.0;
/// The size of the dots of the certificate.
const CERTIFICATE_DOT: f32 = 2.5;

/// Entities under `trace` besides those of the observables, and the names of their curves. Those of exact values come after the
/// computed ones in the alphabet, as the viewer draws in its order.
const BESIDES: [(&str, &str); 4] = [
    ("kappa_r_theory", "exact kappa_r"),
    ("relative_area_theory", "exact relative area"),
    ("complementary_energy", "complementary energy / (p_mean h_rms)"),
    ("potential_energy", "potential energy / (p_mean h_rms)"),
];

/// The entity under `trace` of the numbers of the phase, which are drawn together, and the names of their curves.
pub(crate) const PHASE: &str = "phase";
const OF_PHASE: [&str; 3] = ["grid level, 0 the finest", "outer step", "inner step"];

/// The curves of a scene.
struct Traces {
    root: String,
    exact: ExactValues,
    /// The place of the scene among several, and its title.
    among: Option<(usize, String)>,
}

/// The drawing of the curves of a scene.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let exact = subject.scene.exact.as_ref();
    Some(Box::new(Traces {
        root: subject.root.into(),
        exact: [exact.and_then(|exact| exact.kappa_r), exact.map(|exact| exact.relative_area)],
        among: subject.place.map(|place| (place, subject.scene.title.clone())),
    }))
}

impl Drawing for Traces {
    /// None: curves stand beside the pictures in every layout, and those of several scenes together.
    fn panes(&self) -> Vec<(Place, Pane)> {
        Vec::new()
    }

    fn fit(&mut self, _: &dyn Fn(&str) -> Option<[f64; 2]>) {}

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let among = self.among.as_ref().map(|(place, title)| (*place, title.as_str()));
        log_styles(to, &self.root, self.exact, among)
    }

    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        Some(Box::new(TracesOfRun::new(&self.root, self.exact)))
    }
}

/// The curves of one run, collected until they are flushed.
struct TracesOfRun {
    root: String,
    observables: ObservableTraces,
    besides: [Trace; BESIDES.len()],
    exact: ExactValues,
    phases: Vec<(Work, [f64; OF_PHASE.len()])>,
    /// The width of the curves from the last change on.
    width: f32,
    /// Changes of the width.
    widths: Vec<(Work, f32)>,
}

/// Exact values that stand beside computed ones: of `kappa_r` and of the relative area.
pub(crate) type ExactValues = [Option<f64>; 2];

impl TracesOfRun {
    /// Empty curves under `root`.
    fn new(root: &str, exact: ExactValues) -> Self {
        Self {
            root: root.into(),
            observables: ObservableTraces::new(recorded()),
            besides: Default::default(),
            exact,
            phases: Vec::new(),
            width: 0.0,
            widths: Vec::new(),
        }
    }

    fn flush_phases(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let phases = std::mem::take(&mut self.phases);
        if phases.is_empty() {
            return Ok(());
        }
        let numbers = Scalars::new(phases.iter().flat_map(|(_, numbers)| *numbers));
        let numbers = numbers.columns(phases.iter().map(|(_, numbers)| numbers.len()))?;
        to.send_columns(format!("{}/trace/{PHASE}", self.root), times(&phases), numbers)
    }

    /// Sends the changes of the line width: curves are thin on coarse grids, and thick on the finest grid.
    fn flush_widths(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let widths = std::mem::take(&mut self.widths);
        for observable in traced().filter(|it| !widths.is_empty() && has_levels(*it)) {
            let style = SeriesLines::update_fields().with_widths(widths.iter().map(|(_, width)| *width));
            let entity = format!("{}/trace/{}", self.root, drawn(observable));
            to.send_columns(entity, times(&widths), style.columns_of_unit_batches()?)?;
        }
        Ok(())
    }
}

impl RunDrawing for TracesOfRun {
    fn add(&mut self, RunStep { step, phase, .. }: &RunStep<'_, '_>) {
        self.observables.add(step);
        let (complementary, potential) = match step.energy() {
            Energy::Complementary(energy) => (Some(energy), None),
            Energy::Potential(energy) => (None, Some(energy)),
        };
        let [kappa_r, area] = self.exact;
        let numbers = phase.map(|Phase { level, outer, inner }| [level, outer, inner].map(|number| number as f64));
        self.phases.extend(numbers.map(|numbers| (step.work(), numbers)));
        let width = if phase.is_some_and(|phase| phase.level > 0) { COARSE_WIDTH } else { FINE_WIDTH };
        if width != self.width {
            self.width = width;
            self.widths.push((step.work(), width));
        }
        let values = [kappa_r, area, complementary, potential];
        self.besides.iter_mut().zip(values).for_each(|(trace, value)| trace.add(step.work(), value));
    }

    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { root, observables, besides, .. } = self;
        for &(observable, ref trace) in &observables.0 {
            trace.log(to, format!("{root}/trace/{}", observable.name()))?;
            if is_logarithmic(observable) {
                trace.drawn(observable).log(to, format!("{root}/trace/{}", drawn(observable)))?;
            }
        }
        for ((entity, _), trace) in BESIDES.iter().zip(&*besides) {
            trace.log(to, format!("{root}/trace/{entity}"))?;
        }
        observables.0.iter_mut().map(|(_, trace)| trace).chain(besides).for_each(|trace| trace.0.clear());
        self.flush_phases(to)?;
        self.flush_widths(to)
    }

    fn end(&mut self, contact: &Contact) {
        self.observables.end(contact);
    }
}

/// Whether the line width of its curve shows if the grid is coarse.
fn has_levels(quantity: Quantity) -> bool {
    !COUNTED.contains(&quantity)
}

/// Records names and colours of the curves under `root`, those of exact values where there are any. Beside other
/// scenes, `scene` distinguishes them.
fn log_styles(
    to: &RecordingStream,
    root: &str,
    [kappa_r, area]: ExactValues,
    scene: Option<(usize, &str)>,
) -> RecordingStreamResult<()> {
    let is_drawn = |entity: &str| match entity {
        "kappa_r_theory" => kappa_r.is_some(),
        "relative_area_theory" => area.is_some(),
        _ => true,
    };
    let observables = traced().map(|it| {
        let width = if has_levels(it) { None } else { Some(FAINT_WIDTH) };
        (it.name(), drawn(it), title(it), width)
    });
    let besides = BESIDES.iter().map(|&(entity, name)| {
        let width = if is_exact(entity) { FAINT_WIDTH } else { FINE_WIDTH };
        (entity, entity.to_owned(), name.to_owned(), Some(width))
    });
    for (i, (of, entity, name, width)) in observables.chain(besides).enumerate().filter(|(_, (of, ..))| is_drawn(of)) {
        let rgb = if is_exact(of) { palette::EXACT } else { series_colour(of, i, scene) };
        let name = scene.map_or_else(|| name.clone(), |(_, title)| format!("{name}, {title}"));
        let style = SeriesLines::new().with_names([name.as_str()]).with_colors([palette::colour(rgb)]);
        let style = if let Some(width) = width { style.with_widths([width]) } else { style };
        to.log_static(format!("{root}/trace/{entity}"), &style)?;
        if of == "certificate" {
            // it is computed at some steps only, at times at a single one, where a line alone would show nothing
            let points = SeriesPoints::new()
                .with_names([name.as_str()])
                .with_colors([palette::colour(rgb)])
                .with_marker_sizes([CERTIFICATE_DOT]);
            to.log_static(format!("{root}/trace/{entity}"), &points)?;
        }
    }
    let style =
        SeriesLines::new().with_names(OF_PHASE).with_colors(SERIES.map(palette::colour)[..OF_PHASE.len()].to_vec());
    to.log_static(format!("{root}/trace/{PHASE}"), &style.with_widths([FINE_WIDTH; OF_PHASE.len()]))
}

/// Whether an entity beside the observables holds an exact value.
fn is_exact(entity: &str) -> bool {
    entity.ends_with("_theory")
}

/// Records name and colour of the curve of a run among others, or of exact values if it has no number.
pub(crate) fn log_run_style(
    to: &RecordingStream,
    entity: &str,
    name: &str,
    number: Option<usize>,
) -> RecordingStreamResult<()> {
    let rgb = number.map_or(palette::EXACT, |number| SERIES[number % SERIES.len()]);
    let style = SeriesLines::new().with_names([name]).with_colors([palette::colour(rgb)]);
    // the widths of runs came with their values
    to.log_static(entity, &if number.is_some() { style } else { style.with_widths([FAINT_WIDTH]) })
}

/// Curves that are compared between scenes take the colour of their scene.
fn series_colour(entity: &str, i: usize, scene: Option<(usize, &str)>) -> Colour {
    let [first, second, rest @ ..] = SERIES;
    let quantity = Quantity::find(entity);
    let is_among = |all: &[Quantity]| quantity.is_some_and(|it| all.contains(&it));
    match (quantity, scene) {
        (_, Some((scene, _))) if is_among(&COMPARED) => SERIES[scene % SERIES.len()],
        (Some(Quantity::Kappa), Some(_)) => palette::FAINT,
        _ if is_among(&COUNTED) => palette::FAINT,
        (Some(Quantity::KappaR), None) => first,
        (Some(Quantity::Kappa), None) => second,
        _ => rest[i % rest.len()],
    }
}
