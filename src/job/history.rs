//! A run of a setup with a history: creep, slip, sliding or rolling.

use crate::adhesion::AdhesionScales;
use crate::contact::{Observer, Problem, Status};
use crate::error::{HistoryError, SetupError};
use crate::history::{AdhesionTotals, HISTORY_QUANTITIES, HistoryQuantity, HistoryState, cycle_losses};
use crate::setup::{ProcessKind, Setup};
use crate::warning::Warning;
use serde::Serialize;

/// A process zone of fewer spacings gets a warning.
const FEW_SPACINGS: f64 = 4.0;

/// An error of the grid above this part gets a warning.
const LARGE_GRID_ERROR: f64 = 0.02;

/// The states of a history, and what they add up to.
pub struct HistoryOutcome {
    /// The process.
    pub kind: ProcessKind,
    /// The attraction and what came of it, with adhesion.
    pub adhesion: Option<AdhesionOutcome>,
    /// The states, in their order.
    pub states: Vec<HistoryState>,
    /// Why the history ended before its path did, if it did: an observer that stopped it, such as Ctrl-C, or a failure.
    pub ended: Option<HistoryError>,
}

/// The attraction of a history with adhesion, and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdhesionOutcome {
    /// Work of adhesion, an energy per area.
    pub work: f64,
    /// Range of the attraction, a length.
    pub range: f64,
    /// How the attraction compares with surface and solid.
    #[serde(flatten)]
    pub scales: AdhesionScales,
    /// Pull-off, jumps and energies.
    #[serde(flatten)]
    pub totals: AdhesionTotals,
}

impl AdhesionOutcome {
    fn new(setup: &Setup, problem: &Problem, states: &[HistoryState]) -> Result<Option<Self>, SetupError> {
        let (Some(adhesion), Some(totals)) = (&setup.adhesion, AdhesionTotals::new(states)) else { return Ok(None) };
        let attraction = adhesion.attraction()?;
        let scales = AdhesionScales::new(problem, &attraction);
        Ok(Some(Self { work: attraction.work(), range: attraction.range(), scales, totals }))
    }
}

impl HistoryOutcome {
    /// Follows the history of a setup on its problem.
    ///
    /// # Errors
    /// The errors of [`Setup::history`], and those of the first state. A failure of a later one ends the history, and the states before it
    /// are kept.
    pub fn solve(setup: &Setup, problem: &Problem, observer: &mut dyn Observer) -> Result<Self, SetupError> {
        kind_of(setup)?;
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
            ended => Ok(Self { ended: ended.err(), ..Self::from_states(setup, problem, states)? }),
        }
    }

    /// The history of states that were found before, such as those of a file.
    ///
    /// # Errors
    /// For a setup without a history, and for an attraction that cannot be.
    pub fn from_states(setup: &Setup, problem: &Problem, states: Vec<HistoryState>) -> Result<Self, SetupError> {
        let adhesion = AdhesionOutcome::new(setup, problem, &states)?;
        Ok(Self { kind: kind_of(setup)?, adhesion, states, ended: None })
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
        let spacings = self.adhesion.as_ref().map(|it| it.scales.spacings);
        let coarse = spacings.filter(|spacings| *spacings < FEW_SPACINGS).map(|spacings| {
            Warning::new(
                format!(
                    "The process zone of the attraction is {spacings:.1} spacings long, and so the nodes hold the edges of the contact"
                ),
                "Use more points, or a longer range: the zone should be at least 4 spacings long",
            )
            .with_remedy("grid.points", None)
        });
        let error = self.adhesion.as_ref().and_then(|it| it.scales.grid_error);
        let snapping = error.filter(|error| *error > LARGE_GRID_ERROR && coarse.is_none()).map(|error| {
            Warning::new(
                format!(
                    "Forces at which contacts let go may be off by {:.0} %, as the traction jumps at the end of its range and the nodes hold the edges of the contact",
                    1e2 * error
                ),
                "Use more points: the error is proportional to their spacing",
            )
            .with_remedy("grid.points", None)
        });
        missed.into_iter().chain(coarse).chain(snapping).collect()
    }
}

/// The process of a setup with a history.
fn kind_of(setup: &Setup) -> Result<ProcessKind, SetupError> {
    setup.process()?.ok_or_else(|| SetupError::Path { reason: "the setup has no history".into() })
}
