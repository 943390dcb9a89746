//! `asperity solve` with a history: what it writes and prints of creep, slip, sliding, rolling, adhesion and yielding.

use super::adhesion;
use super::exit_status::ExitStatus;
use super::history_picture;
use super::imprint;
use super::output::write_rows;
use super::outputs::Outputs;
use super::problem_summary::ProblemSummary;
use super::report::{self, SolveReport};
use super::units::Units;
use super::warnings;
use anyhow::Result;
use asperity::contact::{Problem, Quantity, QuantityKind, ResultClaim, State, Status, Unit, archive_of_states};
use asperity::error::{HistoryError, SlipError};
use asperity::job::{AdhesionOutcome, HistoryOutcome, Solved};
use asperity::plot::Figure;
use asperity::quantity::number_in_words;
use asperity::setup::Setup;
use serde::Serialize;
use serde_json::{Map, Value};
use std::io::{self, Write};
use std::path::Path;

/// Columns of what flows, where it was asked for.
const OF_FLOW: [Quantity; 3] = [Quantity::HydraulicGapX, Quantity::HydraulicGapY, Quantity::ConductancePerArea];

/// Everything that a script may want to know about a history, and the setup that repeats it.
#[derive(Serialize)]
struct HistoryReport {
    #[serde(flatten)]
    subject: ProblemSummary,
    process: &'static str,
    /// The claim of all states, in words: what their certificates prove. With adhesion each state has its own.
    claim: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    adhesion: Option<AdhesionOutcome>,
    states: Vec<Map<String, Value>>,
    /// Energy lost in each closed cycle of the path, per area of the cell.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    energy_per_cycle: Vec<f64>,
    /// The estimated errors of these by the steps in time or of the path, one for each cycle; null where a cycle has none.
    #[serde(skip_serializing_if = "has_no_errors")]
    energy_per_cycle_error: Vec<Option<f64>>,
    /// Why the history ended before its path did, if it did.
    #[serde(skip_serializing_if = "Option::is_none")]
    ended: Option<String>,
    warnings: Vec<String>,
    #[serde(serialize_with = "Setup::serialize_saved")]
    setup: Setup,
    #[serde(skip)]
    outcome: HistoryOutcome,
    /// Whether the recording could not be written to its end.
    #[serde(skip)]
    has_lost_recording: bool,
    #[serde(skip)]
    units: Units,
    #[serde(skip)]
    is_verbose: bool,
}

/// Writes and prints the states of a history.
pub(crate) fn write(solved: Solved, problem: &Problem, (outputs, units): (&Outputs, Units)) -> Result<ExitStatus> {
    let mut all = warnings::in_flags(&solved.warnings());
    let (setup, Some(mut outcome)) = (solved.setup, solved.history) else { return Ok(ExitStatus::Done) };
    let is_stopped = matches!(outcome.ended, Some(HistoryError::Stopped));
    let failure = outcome.ended.as_ref().filter(|_| !is_stopped);
    // where everything slides, no state in equilibrium follows: the history ends there, and no solver has failed
    let has_failed = failure.is_some_and(|error| !matches!(error, HistoryError::Slip(SlipError::Sliding { .. })));
    let failed = failure.map(|error| format!("The history ended after {}: {error}", counted(outcome.states.len())));
    if is_stopped {
        warnings::print(&[format!("interrupted: {} solved and written", counted(outcome.states.len()))]);
    }
    let is_converged = outcome.states.iter().all(|state| state.contact.is_converged());
    all.extend(failed);
    warnings::refuse_if_strict(&all, outputs.strict)?;
    let unwritten = outcome.failure.take();
    let subject = ProblemSummary::new(&setup, problem)?;
    let report = HistoryReport {
        units,
        is_verbose: outputs.verbose,
        has_lost_recording: unwritten.is_some(),
        ..HistoryReport::new(subject, setup, outcome, all)
    };
    report::deliver(&report, outputs)?;
    if let Some(failure) = unwritten {
        return Err(failure.into());
    }
    Ok(match (is_stopped, is_converged && !has_failed) {
        (true, _) => ExitStatus::Interrupted,
        (false, true) => ExitStatus::Done,
        (false, false) => ExitStatus::NotConverged,
    })
}

/// A number of states in words.
fn counted(states: usize) -> String {
    if states == 1 { "1 state".into() } else { format!("{states} states") }
}

/// The numbers of a state, by their names.
fn object(number: usize, state: &State, has_claims: bool) -> Map<String, Value> {
    let first = [("state".to_owned(), Value::from(number + 1)), ("status".to_owned(), word(state.contact.status))];
    let claim: &str = state.claim.into();
    let claim = has_claims.then(|| ("claim".to_owned(), Value::from(claim)));
    let numbers =
        state.numbers().iter().map(|(quantity, value)| (quantity.name().to_owned(), number_of(*quantity, *value)));
    first.into_iter().chain(claim).chain(numbers).collect()
}

/// A number of a state as JSON.
fn number_of(quantity: Quantity, value: f64) -> Value {
    match quantity.row().kind {
        QuantityKind::Flag => Value::from(value == 1.0),
        QuantityKind::Whole => Value::from(value as u64),
        QuantityKind::Number | QuantityKind::Bound => Value::from(value),
    }
}

fn word(status: Status) -> Value {
    serde_json::to_value(status).unwrap_or_default()
}

impl HistoryReport {
    fn new(subject: ProblemSummary, setup: Setup, outcome: HistoryOutcome, warnings: Vec<String>) -> Self {
        let (cycles, has_claims) = (outcome.cycles(&setup), outcome.drive.has_claims);
        Self {
            process: outcome.drive.name,
            claim: match has_claims {
                true => "each state has a claim of its own",
                false => outcome.claim().map_or("", ResultClaim::words),
            },
            adhesion: outcome.adhesion.clone(),
            states: outcome.states.iter().enumerate().map(|(i, state)| object(i, state, has_claims)).collect(),
            energy_per_cycle: cycles.iter().map(|it| it.energy).collect(),
            energy_per_cycle_error: cycles.iter().map(|it| it.error).collect(),
            ended: outcome.ended.as_ref().map(HistoryError::to_string),
            warnings,
            setup,
            subject,
            outcome,
            has_lost_recording: false,
            units: Units::default(),
            is_verbose: false,
        }
    }

    /// The energies that the cycles lost, each with its error over the energy, where there is one.
    fn write_cycles(&self, units: Units, out: &mut dyn Write) -> io::Result<()> {
        if self.energy_per_cycle.is_empty() {
            return Ok(());
        }
        let mut energies = Vec::new();
        for (i, energy) in self.energy_per_cycle.iter().enumerate() {
            let error = self.energy_per_cycle_error[i].filter(|error| *error > 0.0);
            let relative = error.map_or_else(String::new, |error| format!(" (relative error {:.1e})", error / energy));
            energies.push(units.energy_per_area(*energy) + &relative);
        }
        writeln!(out, "\nenergy lost per cycle and area: {}", energies.join(", "))
    }
}

impl SolveReport for HistoryReport {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn warnings(&self) -> &[String] {
        &self.warnings
    }

    fn has_lost_recording(&self) -> bool {
        self.has_lost_recording
    }

    fn archive(&self) -> io::Result<Vec<u8>> {
        let text = self.setup.to_saved_toml();
        archive_of_states(&self.outcome.states, self.subject.rank, &text).map_err(io::Error::other)
    }

    fn write_table(&self, path: &Path) -> Result<()> {
        Ok(self.outcome.write_table(path)?)
    }

    fn figure(&self) -> Figure {
        history_picture::draw(&self.subject.title, &self.outcome, self.units)
    }

    /// The imprint of the last state, of a body that yields.
    fn write_further_files(&self, outputs: &Outputs) -> Result<()> {
        match (&outputs.imprint, self.outcome.states.last()) {
            (Some(path), Some(last)) => imprint::write(path, last),
            _ => Ok(()),
        }
    }

    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { outcome, units, is_verbose, .. } = self;
        let (units, is_verbose) = (*units, *is_verbose);
        let (states, process) = (counted(outcome.states.len()), self.process);
        writeln!(out, "{}: {process}, {states}", self.subject.line())?;
        let claim = self.adhesion.is_none().then(|| ("claim".to_owned(), self.claim.to_owned()));
        let of_adhesion = self.adhesion.iter().flat_map(|it| adhesion::rows(it, units));
        write_rows(self.subject.rows(units, is_verbose).into_iter().chain(claim).chain(of_adhesion), out)?;
        // errors of the path are shown where there are any: exact steps have none
        let has = |it: &Quantity| match it {
            Quantity::ShiftPathError | Quantity::DissipatedPathError => {
                outcome.states.iter().any(|state| state.get(*it).is_some_and(|error| error > 0.0))
            }
            _ => outcome.states.iter().any(|state| state.get(*it).is_some()),
        };
        let columns: Vec<Quantity> = outcome.drive.columns.iter().chain(&OF_FLOW).copied().filter(has).collect();
        writeln!(out)?;
        columns.iter().try_for_each(|it| write!(out, " {:>15}", it.row().short))?;
        let is_claimed = outcome.drive.has_claims;
        writeln!(out, "{}", if is_claimed { "  claim" } else { "" })?;
        for state in &outcome.states {
            columns.iter().try_for_each(|it| write!(out, " {:>15}", cell(*it, state, units)))?;
            let claim: &str = if is_claimed { state.claim.into() } else { "" };
            writeln!(out, "{}{claim}", if is_claimed { "  " } else { "" })?;
        }
        let has_path = |it: &&AdhesionOutcome| outcome.states.len() > 1 || it.totals.separated;
        if let Some(it) = self.adhesion.as_ref().filter(has_path) {
            adhesion::write_totals(it, units, out)?;
        }
        write_errors(outcome, units, out)?;
        self.write_cycles(units, out)
    }
}

/// Whether no cycle has an estimated error.
fn has_no_errors(errors: &[Option<f64>]) -> bool {
    errors.iter().all(Option::is_none)
}

/// Writes the largest errors of all states by their sources, where they were estimated.
fn write_errors(outcome: &HistoryOutcome, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let largest = |error: &Quantity| {
        let known = outcome.states.iter().filter_map(|state| Some((state.get(*error)?, state)));
        known.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, state)| cell(*error, state, units))
    };
    let told = |quantity: Quantity| {
        let errors = quantity.row().errors.iter().filter_map(|name| Quantity::find(name));
        let known: Vec<String> =
            errors.filter_map(|error| Some(format!("{} by {}", largest(&error)?, error.row().cause()?))).collect();
        let name = quantity.row().short;
        (!known.is_empty()).then(|| format!("largest estimated error of the {name}: {}", known.join(", ")))
    };
    let mut lines = Vec::new();
    let errors = outcome.states.iter().filter_map(|state| state.get(Quantity::PressureInContactError));
    if let Some(error) = errors.reduce(f64::max) {
        lines.push(format!("largest estimated error of p_m / Y by the grid: {:.1} %", 1e2 * error));
    }
    lines.extend(Quantity::all().filter_map(told));
    if lines.is_empty() { Ok(()) } else { writeln!(out, "\n{}", lines.join("\n")) }
}

/// A number of a state with its unit, where that is known; a dash where there is none.
fn cell(quantity: Quantity, state: &State, units: Units) -> String {
    let Some(value) = state.get(quantity) else { return "-".into() };
    let row = quantity.row();
    match row.unit {
        Unit::Length => units.length(value),
        Unit::Pressure => units.pressure(value),
        Unit::EnergyPerArea => units.energy_per_area(value),
        _ if row.kind == QuantityKind::Bound => format!("{value:.1e}"),
        _ => number_in_words(value),
    }
}
