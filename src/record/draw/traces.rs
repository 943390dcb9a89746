//! Numbers of every step, sent column by column.

use super::palette::{self, colour};
use crate::contact::{Energy, OBSERVABLES, Observable, Phase, State, Step, Work};
use crate::plot::Colour;
use crate::theory::Exact;
use rerun::{EntityPath, RecordingStream, RecordingStreamResult, Scalars, SeriesLines, TimeColumn};

/// Timeline of relaxation steps.
pub const STEP: &str = "step";
/// Timeline of seconds spent by the solver.
pub const SECONDS: &str = "seconds";
/// Timeline of transforms made by the solver.
pub const TRANSFORMS: &str = "transforms";

/// Observables that are compared between scenes and with an earlier solve.
pub const COMPARED: [&str; 3] = ["kappa_r", "relative_area", "certificate"];

/// Entities under `trace` besides those of the observables, and the names of their curves.
const BESIDES: [(&str, &str); 7] = [
    ("exact_kappa_r", "exact kappa_r"),
    ("exact_relative_area", "exact relative area"),
    ("complementary_energy", "complementary energy / (p_mean h_rms)"),
    ("potential_energy", "potential energy / (p_mean h_rms)"),
    ("level", "grid level"),
    ("outer", "outer step"),
    ("inner", "inner step"),
];

/// The observables that are drawn step by step; the certificate as its logarithm.
pub fn traced() -> impl Iterator<Item = &'static Observable> {
    OBSERVABLES.iter().filter(|observable| observable.is_traced)
}

/// The name of the curve of an observable.
pub fn title(observable: &Observable) -> String {
    let name = observable.name.replace('_', " ").replace("kappa r", "kappa_r");
    if is_logarithmic(observable) { format!("log10 {name} {}", observable.symbol) } else { name }
}

/// The value of an observable as it is drawn.
pub fn drawn(observable: &Observable, state: &State<'_>) -> f64 {
    let value = (observable.value)(state);
    if is_logarithmic(observable) { value.log10() } else { value }
}

fn is_logarithmic(observable: &Observable) -> bool {
    observable.name == "certificate"
}

/// The curves of one scene, collected until they are flushed.
pub struct Traces {
    root: String,
    /// Curves of the observables, in their order.
    observables: Vec<Series>,
    besides: [Series; BESIDES.len()],
    reference: Reference,
}

/// A number of every step.
#[derive(Debug, Clone, Default)]
pub struct Series {
    steps: Vec<i64>,
    seconds: Vec<f64>,
    transforms: Vec<i64>,
    values: Vec<f64>,
}

/// Exact values that stand beside computed ones.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reference {
    /// Exact `kappa_r`.
    pub kappa_r: Option<f64>,
    /// Exact relative area.
    pub relative_area: Option<f64>,
}

impl Reference {
    /// The values of `exact`.
    pub fn of(exact: Option<&Exact>) -> Self {
        Self { kappa_r: exact.and_then(|e| e.kappa_r), relative_area: exact.map(|e| e.relative_area) }
    }
}

impl Traces {
    /// Empty curves under `root`.
    pub fn new(root: &str, reference: Reference) -> Self {
        let observables = traced().map(|_| Series::default()).collect();
        Self { root: root.into(), observables, besides: Default::default(), reference }
    }

    /// Adds the numbers of a step, in a `phase` if its solver has any.
    pub fn add(&mut self, step: &Step<'_>, phase: Option<Phase>) {
        let state = State::from(step);
        for (series, observable) in self.observables.iter_mut().zip(traced()) {
            series.add(step.work(), Some(drawn(observable, &state)));
        }
        let (complementary, potential) = match step.energy() {
            Energy::Complementary(energy) => (Some(energy), None),
            Energy::Potential(energy) => (None, Some(energy)),
        };
        let of_phase = |number: fn(Phase) -> usize| phase.map(|phase| number(phase) as f64);
        let values = [
            self.reference.kappa_r,
            self.reference.relative_area,
            complementary,
            potential,
            of_phase(|phase| phase.level),
            of_phase(|phase| phase.outer),
            of_phase(|phase| phase.inner),
        ];
        for (series, value) in self.besides.iter_mut().zip(values) {
            series.add(step.work(), value);
        }
    }

    /// Adds the certificate of the final state.
    pub fn add_certificate(&mut self, work: Work, eta: f64) {
        let certificate = self.observables.iter_mut().zip(traced()).find(|(_, observable)| is_logarithmic(observable));
        if let Some((series, _)) = certificate {
            series.add(work, Some(eta.log10()));
        }
    }

    /// Sends the numbers collected so far.
    pub fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let observables = self.observables.iter_mut().zip(traced().map(|observable| observable.name));
        let besides = self.besides.iter_mut().zip(BESIDES.map(|(entity, _)| entity));
        for (series, name) in observables.chain(besides).filter(|(series, _)| !series.values.is_empty()) {
            std::mem::take(series).log(to, &format!("{}/trace/{name}", self.root).into())?;
        }
        Ok(())
    }
}

impl Series {
    /// Adds a value; one that cannot be drawn is left out.
    pub fn add(&mut self, work: Work, value: Option<f64>) {
        let Some(value) = value.filter(|v| v.is_finite()) else { return };
        self.steps.push(work.iterations as i64);
        self.seconds.push(work.seconds);
        self.transforms.push(work.transforms as i64);
        self.values.push(value);
    }

    /// Sends its values under `entity`, each at the time at which it was added.
    pub fn log(&self, to: &RecordingStream, entity: &EntityPath) -> RecordingStreamResult<()> {
        let times = [
            TimeColumn::new_sequence(STEP, self.steps.iter().copied()),
            TimeColumn::new_duration_secs(SECONDS, self.seconds.iter().copied()),
            TimeColumn::new_sequence(TRANSFORMS, self.transforms.iter().copied()),
        ];
        to.send_columns(entity.clone(), times, Scalars::new(self.values.iter().copied()).columns_of_unit_batches()?)
    }
}

/// Records names and colours of the curves under `root`, those of exact values where `reference` has them. Beside other
/// scenes, `scene` tells them apart.
pub fn log_styles(
    to: &RecordingStream,
    root: &str,
    reference: Reference,
    scene: Option<(usize, &str)>,
) -> RecordingStreamResult<()> {
    let is_drawn = |entity: &str| match entity {
        "exact_kappa_r" => reference.kappa_r.is_some(),
        "exact_relative_area" => reference.relative_area.is_some(),
        _ => true,
    };
    let observables = traced().map(|observable| (observable.name, title(observable)));
    let besides = BESIDES.iter().map(|&(entity, name)| (entity, name.to_owned()));
    for (i, (entity, name)) in observables.chain(besides).enumerate().filter(|(_, (entity, _))| is_drawn(entity)) {
        let exact = entity.starts_with("exact");
        let rgb = if exact { palette::EXACT } else { series_colour(entity, i, scene) };
        let name = scene.map_or_else(|| name.clone(), |(_, title)| format!("{name}, {title}"));
        let style = SeriesLines::new().with_names([name]).with_colors([colour(rgb)]);
        let width = if exact { 1.0 } else { 1.8 };
        to.log_static(format!("{root}/trace/{entity}"), &style.with_widths([width]))?;
    }
    Ok(())
}

/// Curves that are compared between scenes take the colour of their scene.
fn series_colour(entity: &str, i: usize, scene: Option<(usize, &str)>) -> Colour {
    let [first, second, rest @ ..] = palette::SERIES;
    match (entity, scene) {
        (_, Some((scene, _))) if COMPARED.contains(&entity) => palette::SERIES[scene % palette::SERIES.len()],
        ("kappa", Some(_)) => palette::FAINT,
        ("kappa_r", None) => first,
        ("kappa", None) => second,
        _ => rest[i % rest.len()],
    }
}
