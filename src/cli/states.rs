//! `asperity solve` with several states: how a run of them ends, and what becomes of it.

use super::exit_status::{ExitStatus, Interrupted};
use super::outputs::Outputs;
use super::report;
use super::states_report::StatesReport;
use super::units::Units;
use super::warnings;
use anyhow::Result;
use asperity::contact::{Problem, Status};
use asperity::error::{HistoryError, SlipError, StudyError, is_input};
use asperity::job::{HistoryOutcome, Solved};

/// Writes and prints the states of a run.
pub(crate) fn write(mut solved: Solved, problem: &Problem, outputs: &Outputs, units: Units) -> Result<ExitStatus> {
    solved.history.iter_mut().for_each(leave_out_interrupted);
    let mut warnings = warnings::in_flags(&solved.warnings());
    let (mut setup, Some(mut outcome)) = (solved.setup, solved.history) else { return Ok(ExitStatus::Done) };
    if let Some(error) = outcome.ended.take_if(|error| outcome.drive.is_list && is_input(error)) {
        return Err(StudyError::from(error).into());
    }
    let solved = outcome.rows.len();
    if solved == 0 {
        return Err(Interrupted.into());
    }
    let is_list = outcome.drive.is_list;
    let counted = counted(solved, setup.loads.len());
    // the setup that is saved repeats what was solved
    setup.loads.truncate(solved);
    let is_stopped = matches!(outcome.ended, Some(HistoryError::Stopped));
    let failure = outcome.ended.as_ref().filter(|_| !is_stopped);
    // where everything slides, no state in equilibrium follows: the history ends there, and no solver has failed
    let has_failed = failure.is_some_and(|error| !matches!(error, HistoryError::Slip(SlipError::Sliding { .. })));
    warnings.extend(failure.map(|error| format!("The history ended after {counted}: {error}")));
    warnings::refuse_if_strict(&warnings, outputs.strict)?;
    let is_converged = outcome.rows.iter().all(|row| row.fault.is_none());
    // of a history one warning says how many states missed their goal
    if is_list {
        for (number, row) in outcome.rows.iter().enumerate() {
            warnings.extend(row.fault.as_ref().map(|fault| format!("{fault} (load {})", number + 1)));
        }
    }
    let mut report = StatesReport::new(setup, problem, outcome, warnings, units)?;
    report::deliver(&report, outputs)?;
    if is_stopped {
        let loads = if is_list { "; the saved setup has these loads" } else { "" };
        warnings::print(&[format!("interrupted: {counted} solved and written{loads}")]);
    }
    if let Some(failure) = report.outcome.failure.take() {
        return Err(failure.into());
    }
    Ok(match (is_stopped, is_converged && !has_failed) {
        (true, _) => ExitStatus::Interrupted,
        (false, true) => ExitStatus::Done,
        (false, false) => ExitStatus::NotConverged,
    })
}

/// Leaves out the contact whose solve was interrupted: it is no result, so that nothing is said of it.
fn leave_out_interrupted(outcome: &mut HistoryOutcome) {
    outcome.rows.retain(|row| row.status != Status::StoppedByObserver);
    outcome.states.retain(|state| state.contact.status != Status::StoppedByObserver);
    outcome.totals = outcome.drive.totals_of(&outcome.rows);
}

/// How many states were solved, in words: of a list also how many loads there are.
fn counted(solved: usize, loads: usize) -> String {
    match (solved, loads) {
        (1, 0) => "1 state".into(),
        (_, 0) => format!("{solved} states"),
        _ => format!("{solved} of {loads} loads"),
    }
}
