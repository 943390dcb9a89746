//! What a row of a study has with adhesion.

use crate::contact::{Contact, Observer, ResultClaim, Status};
use crate::error::{AdhesionError, HistoryError, SetupError, StudyError};
use crate::history::{AdhesionTotals, HistoryState};
use crate::setup::Setup;
use serde::{Deserialize, Serialize};

/// What a row of a study has with adhesion: the totals of the history of its setup. Without adhesion all are none.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct AdhesionRow {
    /// The lowest mean pressure of all states; negative if the surfaces stick, and the pull-off pressure if they parted.
    pub lowest_pressure: Option<f64>,
    /// Whether the surfaces parted under the load.
    pub separated: Option<bool>,
    /// The largest share of nodes that touched.
    pub largest_area: Option<f64>,
    /// The number of jumps.
    pub jumps: Option<u64>,
    /// Energy lost in all jumps but parting under the load, per area of the cell.
    pub lost_in_jumps: Option<f64>,
    /// Estimated error of the energy lost in jumps, per area of the cell; none on a free boundary.
    pub lost_error: Option<f64>,
    /// Whether each state with contact was stable, or the solution.
    pub stable: Option<bool>,
    /// The number of states, without the frames of motions.
    pub states: Option<u64>,
    /// Fourier transforms of the history.
    pub history_transforms: Option<u64>,
}

/// A column of a table with adhesion: its name, and its value in a row.
pub(super) enum AdhesionColumn {
    Number(&'static str, fn(&AdhesionRow) -> Option<f64>),
    Whole(&'static str, fn(&AdhesionRow) -> Option<u64>),
    Text(&'static str, fn(&AdhesionRow) -> Option<bool>),
}

/// The columns of a table with adhesion, by the names of their fields.
pub(super) const ADHESION_COLUMNS: &[AdhesionColumn] = &[
    AdhesionColumn::Number("lowest_pressure", |it| it.lowest_pressure),
    AdhesionColumn::Text("separated", |it| it.separated),
    AdhesionColumn::Number("largest_area", |it| it.largest_area),
    AdhesionColumn::Whole("jumps", |it| it.jumps),
    AdhesionColumn::Number("lost_in_jumps", |it| it.lost_in_jumps),
    AdhesionColumn::Number("lost_error", |it| it.lost_error),
    AdhesionColumn::Text("stable", |it| it.stable),
    AdhesionColumn::Whole("states", |it| it.states),
    AdhesionColumn::Whole("history_transforms", |it| it.history_transforms),
];

/// A history with adhesion that was followed to its end, or as far as states were found.
pub(super) struct FollowedHistory {
    pub row: AdhesionRow,
    pub status: Status,
    pub seconds: f64,
    /// The contact of the last state.
    pub last: Contact,
}

impl AdhesionRow {
    /// The pull-off pressure: minus the lowest pressure, where the surfaces stuck.
    pub fn pull_off(&self) -> Option<f64> {
        self.lowest_pressure.map(|lowest| (-lowest).max(0.0))
    }

    /// Energy lost in all jumps; none where the surfaces parted under the load, since that jump has no end.
    pub fn lost(&self) -> Option<f64> {
        self.lost_in_jumps.filter(|_| self.separated == Some(false))
    }

    /// Follows the history of a setup with adhesion.
    ///
    /// # Errors
    /// The errors of [`Setup::history`], and those of the first state. Where a later one is not found, the row has the states before it.
    pub(super) fn follow(setup: &Setup, observer: &mut dyn Observer) -> Result<FollowedHistory, StudyError> {
        let mut states: Vec<HistoryState> = Vec::new();
        let mut process = setup.history(setup.problem()?)?.ok_or(StudyError::History)?;
        let ended = process.run(observer, &mut |state| {
            states.push(state);
            Ok(())
        });
        let status = match ended {
            Err(error) if states.is_empty() => return Err(SetupError::from(error).into()),
            Err(HistoryError::Stopped) => Status::StoppedByObserver,
            Err(HistoryError::Adhesion(AdhesionError::NotFound { .. })) => Status::Stalled,
            Err(error) => return Err(SetupError::from(error).into()),
            Ok(()) => Status::Converged,
        };
        let seconds = states.iter().map(|state| state.work.seconds).sum();
        let row = Self::from_states(&states);
        let last = states.pop().ok_or(StudyError::History)?.contact;
        Ok(FollowedHistory { row, status, seconds, last })
    }

    /// The totals of some states.
    fn from_states(states: &[HistoryState]) -> Self {
        let Some(totals) = AdhesionTotals::new(states) else { return Self::default() };
        let is_state = |it: &&HistoryState| it.claim != ResultClaim::Moving;
        let is_certain = |state: &HistoryState| {
            matches!(state.claim, ResultClaim::Stable | ResultClaim::Solution | ResultClaim::Separated)
        };
        Self {
            lowest_pressure: totals.lowest_pressure,
            separated: Some(totals.separated),
            largest_area: states.iter().filter(is_state).map(HistoryState::relative_area).reduce(f64::max),
            jumps: Some(totals.jumps.len() as u64),
            lost_in_jumps: Some(totals.lost_in_jumps),
            lost_error: totals.lost_error,
            stable: Some(states.iter().filter(is_state).all(is_certain)),
            states: Some(states.iter().filter(is_state).count() as u64),
            history_transforms: Some(states.iter().map(|state| state.work.transforms).sum()),
        }
    }
}
