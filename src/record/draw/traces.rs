//! Numbers of every step, sent column by column.

use super::palette::{self, colour};
use crate::contact::{Energy, Phase, Step, Work};
use crate::plot::Colour;
use crate::theory::Exact;
use rerun::{EntityPath, RecordingStream, RecordingStreamResult, Scalars, SeriesLines, TimeColumn};

/// Timeline of relaxation steps.
pub const STEP: &str = "step";
/// Timeline of seconds spent by the solver.
pub const SECONDS: &str = "seconds";
/// Timeline of transforms made by the solver.
pub const TRANSFORMS: &str = "transforms";

/// Entity under `trace` of `kappa_r`, and the name of its curve.
pub const KAPPA_R: (&str, &str) = ("kappa_r", "kappa_r");
/// Entity under `trace` of the relative area, and the name of its curve.
pub const RELATIVE_AREA: (&str, &str) = ("relative_area", "relative area");
/// Entity under `trace` of the certificate, and the name of its curve.
pub const CERTIFICATE: (&str, &str) = ("certificate", "log10 certificate eta");

/// Entities under `trace` and the names of their curves.
const SERIES: [(&str, &str); 13] = [
    KAPPA_R,
    ("kappa", "kappa"),
    ("exact_kappa_r", "exact kappa_r"),
    RELATIVE_AREA,
    ("exact_relative_area", "exact relative area"),
    CERTIFICATE,
    ("mean_gap", "mean gap / h_rms"),
    ("complementary_energy", "complementary energy / (p_mean h_rms)"),
    ("potential_energy", "potential energy / (p_mean h_rms)"),
    ("patches", "contact patches"),
    ("level", "grid level"),
    ("outer", "outer step"),
    ("inner", "inner step"),
];

/// Place of the certificate among the series.
const CERTIFICATE_PLACE: usize = 5;

/// The curves of one scene, collected until they are flushed.
pub struct Traces {
    series: Vec<(EntityPath, Series)>,
    exact_kappa_r: Option<f64>,
    exact_area: Option<f64>,
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
        let series = |(name, _): &(&str, &str)| (format!("{root}/trace/{name}").into(), Series::default());
        Self {
            series: SERIES.iter().map(series).collect(),
            exact_kappa_r: reference.kappa_r,
            exact_area: reference.relative_area,
        }
    }

    /// Adds the numbers of a step, in a `phase` if its solver has any.
    pub fn add(&mut self, step: &Step<'_>, phase: Option<Phase>) {
        let of_phase = |number: fn(Phase) -> usize| phase.map(|phase| number(phase) as f64);
        let measures = step.measures();
        let (complementary, potential) = match step.energy() {
            Energy::Complementary(energy) => (Some(energy), None),
            Energy::Potential(energy) => (None, Some(energy)),
        };
        let values = [
            Some(measures.kappa_r),
            Some(measures.kappa),
            self.exact_kappa_r,
            Some(measures.relative_area),
            self.exact_area,
            step.certificate().map(f64::log10),
            Some(step.mean_gap() / step.problem().rms_height()),
            complementary,
            potential,
            Some(step.patches().count() as f64),
            of_phase(|phase| phase.level),
            of_phase(|phase| phase.outer),
            of_phase(|phase| phase.inner),
        ];
        for ((_, series), value) in self.series.iter_mut().zip(values) {
            series.add(step.work(), value);
        }
    }

    /// Adds the certificate of the final state.
    pub fn add_certificate(&mut self, work: Work, eta: f64) {
        self.series[CERTIFICATE_PLACE].1.add(work, Some(eta.log10()));
    }

    /// Sends the numbers collected so far.
    pub fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        for (entity, series) in self.series.iter_mut().filter(|(_, series)| !series.values.is_empty()) {
            std::mem::take(series).log(to, entity)?;
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
    for (i, (entity, name)) in SERIES.iter().enumerate().filter(|(_, (entity, _))| is_drawn(entity)) {
        let exact = entity.starts_with("exact");
        let rgb = if exact { palette::EXACT } else { series_colour(entity, i, scene) };
        let name = scene.map_or_else(|| (*name).to_owned(), |(_, title)| format!("{name}, {title}"));
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
        ("kappa_r" | "certificate" | "relative_area", Some((scene, _))) => {
            palette::SERIES[scene % palette::SERIES.len()]
        }
        ("kappa", Some(_)) => palette::FAINT,
        ("kappa_r", None) => first,
        ("kappa", None) => second,
        _ => rest[i % rest.len()],
    }
}
