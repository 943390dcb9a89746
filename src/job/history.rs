//! A run of a setup with a history: creep, slip, sliding or rolling.

use crate::contact::{Observer, Problem, Status};
use crate::error::{HistoryError, SetupError};
use crate::history::{HISTORY_QUANTITIES, HistoryQuantity, HistoryState, cycle_losses};
use crate::setup::{ProcessKind, Setup};
use crate::warning::Warning;

/// The states of a history, and what they add up to.
pub struct HistoryOutcome {
    /// The process.
    pub kind: ProcessKind,
    /// The states, in their order.
    pub states: Vec<HistoryState>,
    /// Why the history ended before its path did, if it did: an observer that stopped it, such as Ctrl-C, or a failure.
    pub ended: Option<HistoryError>,
}

impl HistoryOutcome {
    /// Follows the history of a setup on its problem.
    ///
    /// # Errors
    /// The errors of [`Setup::history`], and those of the first state. A failure of a later one ends the history, and the states before it
    /// are kept.
    pub fn solve(setup: &Setup, problem: &Problem, observer: &mut dyn Observer) -> Result<Self, SetupError> {
        let kind = setup.process()?.ok_or_else(|| SetupError::Path { reason: "the setup has no history".into() })?;
        let mut states: Vec<HistoryState> = Vec::new();
        let Some(mut process) = setup.history(problem.clone())? else { unreachable!("a kind of process has one") };
        let ended = process.run(observer, &mut |state| {
            if state.contact.status == Status::StoppedByObserver {
                return Err(HistoryError::Stopped);
            }
            states.push(state);
            Ok(())
        });
        match ended {
            Err(error) if states.is_empty() => Err(error.into()),
            ended => Ok(Self { kind, states, ended: ended.err() }),
        }
    }

    /// The quantities that the states have, in the order of their table.
    pub fn quantities(&self) -> Vec<&'static HistoryQuantity> {
        let has = |it: &&HistoryQuantity| self.states.iter().any(|state| (it.value)(state).is_some());
        HISTORY_QUANTITIES.iter().filter(has).collect()
    }

    /// The values of a quantity in all states; NaN where a state has none.
    pub fn values(&self, name: &str) -> Vec<f64> {
        let found = HISTORY_QUANTITIES.iter().find(|it| it.name == name);
        let value = |state: &HistoryState| found.and_then(|it| (it.value)(state)).unwrap_or(f64::NAN);
        self.states.iter().map(value).collect()
    }

    /// The energy that each closed cycle of the path lost, per area of the cell.
    pub fn cycles(&self, setup: &Setup) -> Vec<f64> {
        cycle_losses(&setup.path_points(), &self.states)
    }

    /// Reasons to doubt the states.
    pub fn warnings(&self) -> Vec<Warning> {
        let missed = self.states.iter().filter(|state| !state.contact.is_converged()).count();
        let missed = (missed > 0).then(|| {
            Warning::new(
                format!("{missed} of {} states did not reach their certificate", self.states.len()),
                "Use a larger tolerance, or more iterations",
            )
            .with_remedy("stop.tolerance", None)
        });
        missed.into_iter().collect()
    }
}
