//! The states of a run, one after the other.

use super::history::HistoryOutcome;
use super::run::JobRun;
use super::watch::{Pass, ShowSteps, Watcher};
use crate::contact::{Observer, Problem, State, StateRow, Status, goes_on};
use crate::error::{ConflictRule, FileError, HistoryError, SetupError};
use crate::setup::{Flow, Posed, Setup, StateSink};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is kept of the states of a run.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StateKeeping {
    /// Whether the fields of what flows are kept.
    pub has_fields: bool,
    /// Whether only the last state is kept.
    pub is_last_only: bool,
}

impl JobRun<'_> {
    /// The run with its problem, under its number in the job.
    ///
    /// # Errors
    /// For a setup of one contact.
    pub(super) fn posed<'p>(&'p self, run: usize, problem: &'p Problem) -> Result<Posed<'p>, SetupError> {
        let drive = self.drive()?.ok_or(ConflictRule::NoHistory)?;
        Ok(Posed { run, setup: &self.setup, problem, drive })
    }

    /// Follows the run to its end, or until an observer stops it, and gives each state to the sinks. States have the fields of what flows through them
    /// where these are asked for. A failure of a sink is kept, and the run goes on.
    ///
    /// # Errors
    /// Those of the first state. A failure of a later one ends the history, and the states before it are kept.
    pub(super) fn follow(
        &self,
        number: usize,
        problem: &Problem,
        sinks: &mut Vec<Box<dyn StateSink + '_>>,
        keeping: StateKeeping,
        watch: &mut dyn Watcher,
    ) -> Result<HistoryOutcome, SetupError> {
        let posed = self.posed(number, problem)?;
        let mut process = self.setup.history(problem.clone())?.ok_or(ConflictRule::NoHistory)?;
        let (mut rows, mut states, mut failure) = (Vec::new(), Vec::<Arc<State>>::new(), None);
        let is_ended = watch.ended().unwrap_or_default();
        let ended = loop {
            let count = rows.len();
            let mut observer = watch.observer(Pass::State(self, number, count));
            // a state without contact is found without a step of a solver, which would ask
            if count > 0 && !goes_on(&mut *observer) {
                break Some(HistoryError::Stopped);
            }
            let next = process.next(&mut *observer);
            drop(observer);
            let solved = match next {
                None => break None,
                Some(Ok(state)) if state.contact.status == Status::StoppedByObserver => {
                    // a contact under a load is what it is; a state of a history has to be solved
                    if posed.drive.is_list {
                        rows.push(StateRow::new(&state));
                        states.push(Arc::new(state));
                    }
                    break Some(HistoryError::Stopped);
                }
                Some(solved) => solved,
            };
            let solved = solved.and_then(|state| with_flow(state, &self.setup.flow, keeping.has_fields, &is_ended));
            let state = match solved {
                Ok(_) if is_ended.load(Ordering::Relaxed) && !self.setup.flow.is_none() => {
                    break Some(HistoryError::Stopped);
                }
                Ok(state) => state,
                Err(error) if count == 0 => return Err(error.into()),
                Err(error) => break Some(error),
            };
            watch.state(number, &state);
            give(sinks, &mut failure, |sink| sink.state(&posed, count, &state));
            rows.push(StateRow::new(&state));
            if keeping.is_last_only {
                states.clear();
            }
            states.push(Arc::new(state));
        };
        if states.is_empty() {
            return Err(HistoryError::Stopped.into());
        }
        let mut outcome = HistoryOutcome::from_posed(&posed, rows, states)?;
        outcome.ended = ended;
        outcome.failure = failure;
        Ok(outcome)
    }
}

impl HistoryOutcome {
    /// Follows the history of a setup on its problem.
    ///
    /// # Errors
    /// The errors of [`Setup::history`], and those of the first state. A failure of a later one ends the history, and the states before it
    /// are kept.
    pub fn solve(setup: &Setup, problem: &Problem, observer: &mut dyn Observer) -> Result<Self, SetupError> {
        let (run, keeping) = (JobRun::new(setup.clone()), StateKeeping::default());
        run.follow(0, problem, &mut Vec::new(), keeping, &mut ShowSteps(observer))
    }
}

/// Gives something to each sink. A sink that fails gets nothing more.
pub(super) fn give(
    sinks: &mut Vec<Box<dyn StateSink + '_>>,
    failure: &mut Option<FileError>,
    mut to: impl FnMut(&mut dyn StateSink) -> Result<(), FileError>,
) {
    sinks.retain_mut(|sink| match to(&mut **sink) {
        Ok(()) => true,
        Err(error) => {
            failure.get_or_insert(error);
            false
        }
    });
}

/// The state with what flows through it.
fn with_flow(state: State, asked: &Flow, has_fields: bool, is_ended: &AtomicBool) -> Result<State, HistoryError> {
    if asked.is_none() {
        return Ok(state);
    }
    let found = asked.measure_until(&state.contact, is_ended)?;
    let mut state = state.with_numbers(&found.numbers);
    if has_fields {
        state.fields.extend(found.leakages.into_iter().flat_map(|it| it.into_fields()));
    }
    Ok(state)
}
