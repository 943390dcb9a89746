//! The state of a session, as the page gets it.

use super::knobs::Knobs;
use super::refusal::KnownFault;
use super::scale::MODULUS;
use super::section::Section;
use crate::adhesion::AdhesionScales;
use crate::contact::{Contact, Failure, Observables, Problem, Quantity, Reading, State, Step, Work};
use crate::error::{FileError, HistoryError, PlasticError, ProblemError, SetupError, SolveError};
use crate::sentence::{Sentence, Worded};
use crate::setup::{Drive, Setup, StateChart};
use crate::theory::{Exact, PullOff};
use crate::warning::Warning;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// The state of a session.
#[derive(Clone, Default, Serialize)]
pub struct Report {
    /// Grows with every change.
    pub revision: u64,
    /// Whether something is being solved.
    pub busy: bool,
    /// The latest solve.
    pub run: Option<RunReport>,
    /// The latest sweep over the load.
    pub sweep: Option<SweepReport>,
    /// Name of the recording whose curves stand beside those of new ones.
    pub pinned: Option<String>,
    /// Why the last request failed, in one sentence.
    pub fault: Option<Sentence>,
    /// The same as data, if the page has a text for it.
    pub known_fault: Option<KnownFault>,
}

impl KnownFault {
    /// Id of a mean pressure above the hardness, which the page tells in its own terms: both over the contact modulus.
    pub const ABOVE_HARDNESS: &str = "above-hardness";
    /// Id of a mean pressure under which a solid yields at all depths, told in the same terms.
    pub const YIELDS_EVERYWHERE: &str = "yields-everywhere";

    /// The fault behind a failure, if the page has a text for it.
    pub fn from_failure(failure: &Failure) -> Option<Self> {
        match failure.downcast_ref::<SetupError>()? {
            SetupError::Problem(ProblemError::AboveHardness { mean_pressure, hardness }) => {
                let [pressure, hardness] = [mean_pressure, hardness].map(|it| rounded(it / MODULUS));
                let places = [("pressure", pressure.into()), ("hardness", hardness.into())].into();
                Some(Self { key: Self::ABOVE_HARDNESS, places })
            }
            SetupError::History(HistoryError::Plastic(PlasticError::YieldsEverywhere { mean_pressure, limit })) => {
                let [pressure, limit] = [mean_pressure, limit].map(|it| rounded(it / MODULUS));
                let places = [("pressure", pressure.into()), ("limit", limit.into())].into();
                Some(Self { key: Self::YIELDS_EVERYWHERE, places })
            }
            other => Self::from_setup(other),
        }
    }
}

/// What a failure says, with its values where it is an error with which a run of the page ends. Errors of studies and of other codes are not among
/// them, which keeps the module small.
pub(super) fn sentence_of_failure(failure: &Failure) -> Sentence {
    fn said<E: Worded + 'static>(failure: &Failure) -> Option<Sentence> {
        failure.downcast_ref::<E>().map(Worded::sentence)
    }
    let known = [said::<SetupError>, said::<HistoryError>, said::<SolveError>, said::<FileError>];
    known.iter().find_map(|said| said(failure)).unwrap_or_else(|| failure.to_string().into())
}

/// A number in three significant digits, as a script writes it.
fn rounded(value: f64) -> String {
    let rounded = format!("{value:.2e}").parse::<f64>().unwrap_or(value);
    if rounded.abs() < 1e-6 { format!("{rounded:e}") } else { rounded.to_string() }
}

/// The latest solve, running or ended.
#[derive(Clone, Serialize)]
pub struct RunReport {
    /// Name of its recording.
    pub id: String,
    /// Name, without ending, of the files that it is saved as.
    pub file_stem: String,
    /// Surface and load in words.
    pub title: String,
    /// Command that repeats the solve.
    pub command: String,
    /// Setup that repeats the solve, in TOML.
    pub setup: String,
    /// The effect of each preparation step of the heights of a file.
    pub prepared: Vec<Sentence>,
    /// Reasons to doubt the numbers, first of the surface, then of the surface beside.
    pub warnings: Vec<RunWarning>,
    /// The state of the knobs.
    pub knobs: Knobs,
    /// The process of which its steps are states; none of a single contact.
    pub process: Option<ProcessReport>,
    /// Whether solver and recording have ended.
    pub ended: bool,
    /// Numbers of its latest state.
    pub numbers: Option<Numbers>,
    /// Exact values, if there is an exact solution.
    pub exact: Option<ExactNumbers>,
    /// The pull-off in theory, of a smooth round surface that adheres.
    pub pull_off: Option<PullOffReport>,
    /// The surface beside, under the same mean pressure.
    pub beside: Option<Beside>,
    /// The section of its latest step, while it runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
}

/// The process of a run with several states, and what the page shows of them.
#[derive(Clone, Serialize)]
pub struct ProcessReport {
    /// The drive that leads from one state to the next; its name in JSON.
    #[serde(rename = "kind", serialize_with = "name_of")]
    pub drive: &'static Drive,
    /// Two charts: the quantities on both axes, or none for the number of the state.
    pub charts: [[Option<&'static str>; 2]; 2],
    /// The numbers of a state that its process knows.
    pub numbers: Vec<&'static str>,
}

impl From<&'static Drive> for ProcessReport {
    fn from(drive: &'static Drive) -> Self {
        let Drive { charts, columns, .. } = drive;
        let chart = |it: &StateChart| [it.x.map(Quantity::name), Some(it.y.name())];
        let known = columns.iter().filter(|it| it.row().is_known_by_process);
        Self { drive, charts: [chart(&charts[0]), chart(&charts[1])], numbers: known.map(|it| it.name()).collect() }
    }
}

/// The name of a drive.
fn name_of<S: Serializer>(drive: &Drive, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(drive.name)
}

/// A warning about one of the surfaces of a run.
#[derive(Clone, Serialize)]
pub struct RunWarning {
    /// Whether the warning is about the surface that is pressed beside the first one.
    pub is_beside: bool,
    /// The warning.
    #[serde(flatten)]
    pub warning: Warning,
}

/// What is reported for the surface beside.
#[derive(Clone, Serialize)]
pub struct Beside {
    /// Surface in words.
    pub title: String,
    /// Numbers of its contact, once it is solved.
    pub numbers: Option<Numbers>,
}

/// Name, without ending, of the files of a run: surface, load or `sweep`, and solver, as in `rough-line_p0.1_multilevel`.
pub(crate) fn file_stem(surface: &str, load: &str, solver: &str) -> String {
    let surface: String =
        surface.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    format!("{surface}_{load}_{solver}")
}

/// Exact values of a contact.
#[derive(Clone, Serialize)]
pub struct ExactNumbers {
    /// Name of the exact solution.
    pub name: &'static str,
    /// Relative contact area.
    pub relative_area: f64,
    /// Area-load factor `kappa_r`, where it is known.
    pub kappa_r: Option<f64>,
}

/// The pull-off in theory: mean pressures, and Tabor's number, which says which of them holds.
#[derive(Clone, Copy, Serialize)]
pub struct PullOffReport {
    /// For an attraction of short range.
    jkr: f64,
    /// For an attraction of long range; none for a cylinder.
    dmt: Option<f64>,
    /// Tabor's number: large for a short range.
    tabor: f64,
}

impl PullOffReport {
    /// The pull-off of a setup; none without adhesion, and where the theory is of another contact.
    pub fn new(setup: &Setup, problem: &Problem) -> Option<Self> {
        let attraction = setup.adhesion.as_ref()?.attraction().ok()?;
        let solid = setup.elastic().ok().filter(|solid| solid.is_half_space())?;
        let (indenter, grid) = (setup.surface.smooth()?, problem.surface().grid());
        let PullOff { jkr, dmt } = PullOff::new(&indenter, grid, solid.contact_modulus(), attraction.work())?;
        Some(Self { jkr, dmt, tabor: AdhesionScales::new(problem, &attraction).tabor? })
    }
}

/// The numbers of a state; those that are infinite or not known are null in JSON.
#[derive(Clone, Serialize)]
pub struct Numbers {
    /// Status in words: `running`, or how the solve ended.
    pub status: String,
    /// Grid level of a running solve.
    pub level: usize,
    /// Seconds of the solver, recording left out.
    pub seconds: f64,
    /// All other numbers.
    #[serde(flatten)]
    pub observables: Observables,
    /// Those that only its process knows.
    #[serde(flatten)]
    pub process: BTreeMap<&'static str, f64>,
}

/// The latest sweep over the load.
#[derive(Clone, Serialize)]
pub struct SweepReport {
    /// Name of its recording.
    pub id: String,
    /// Name, without ending, of the files that it is saved as.
    pub file_stem: String,
    /// Surface in words.
    pub title: String,
    /// The state of the knobs; the load does not count.
    pub knobs: Knobs,
    /// Whether solver and recording have ended.
    pub ended: bool,
    /// Contacts, from the smallest load on.
    pub points: Vec<SweepPoint>,
}

/// A contact of a sweep, and what theories say.
#[derive(Clone, Serialize)]
pub struct SweepPoint {
    /// The number of its load in the recording, from 1 on.
    pub number: usize,
    /// The load as the knob has it: over the rms gradient and the modulus at once. The reduced pressure of a contact that slides is over its
    /// effective modulus.
    pub load: f64,
    /// All other numbers.
    #[serde(flatten)]
    pub observables: Observables,
    /// Persson's relative area, of a rough flat on an elastic half-space.
    pub persson: Option<f64>,
    /// Exact values, if there is an exact solution.
    pub exact: Option<ExactNumbers>,
}

impl From<&Exact> for ExactNumbers {
    fn from(exact: &Exact) -> Self {
        Self { name: exact.name, relative_area: exact.relative_area, kappa_r: exact.kappa_r }
    }
}

impl Numbers {
    /// The numbers of a step.
    pub fn from_step(step: &Step<'_>) -> Self {
        let (level, seconds) = (step.phase().level, step.work().seconds);
        let process = BTreeMap::new();
        Self { status: "running".into(), level, seconds, observables: Observables::new(step), process }
    }

    /// The numbers of a state of a history that goes on, with its work so far.
    pub fn from_state(state: &State, work: Work) -> Self {
        let observables = Observables::new(Reading::from(&state.contact).with_work(work));
        let process = known_by_process(&state.contact);
        Self { status: "running".into(), level: 0, seconds: work.seconds, observables, process }
    }

    /// The numbers of a contact.
    pub fn from_contact(contact: &Contact) -> Self {
        let (status, seconds) = (contact.status.to_string(), contact.work.seconds);
        let process = known_by_process(contact);
        Self { status, level: 0, seconds, observables: Observables::new(contact), process }
    }
}

/// The numbers of a contact that only the process knows of which it is a state.
fn known_by_process(contact: &Contact) -> BTreeMap<&'static str, f64> {
    let known = contact.values().numbers().iter().filter(|(quantity, _)| quantity.row().is_known_by_process);
    known.map(|(quantity, value)| (quantity.name(), *value)).collect()
}
