//! A history as one row of a study.

use crate::contact::{Contact, Observer, Quantity, StateRow, Status};
use crate::error::{AdhesionError, HistoryError, SetupError, StudyError};
use crate::setup::Setup;

/// A history that was followed to its end, or as far as states were found: a row of a study.
pub(super) struct FollowedHistory {
    /// What the states add up to, and the numbers that the process gives for the last one.
    pub numbers: Vec<(Quantity, f64)>,
    pub status: Status,
    pub seconds: f64,
    /// The contact of the last state.
    pub last: Contact,
}

impl FollowedHistory {
    /// Follows the history of a setup.
    ///
    /// # Errors
    /// The errors of [`Setup::history`], and those of the first state. Where a later one is not found, the row has the states before it.
    pub(crate) fn follow(setup: &Setup, observer: &mut dyn Observer) -> Result<Self, StudyError> {
        let (mut rows, mut last, mut seconds) = (Vec::new(), None, 0.0);
        let mut process = setup.history(setup.problem()?)?.ok_or(StudyError::NoHistory)?;
        let ended = process.run(observer, &mut |state| {
            rows.push(StateRow::new(&state));
            seconds += state.contact.work.seconds;
            last = Some(state.contact);
            Ok(())
        });
        let status = match ended {
            Err(error) if rows.is_empty() => return Err(SetupError::from(error).into()),
            Err(HistoryError::Stopped) => Status::StoppedByObserver,
            Err(HistoryError::Adhesion(AdhesionError::NotFound { .. })) => Status::Stalled,
            Err(error) => return Err(SetupError::from(error).into()),
            Ok(()) => worst(&rows),
        };
        let drive = setup.drive()?.ok_or(StudyError::NoHistory)?;
        let mut numbers = drive.totals_of(&rows);
        let last = last.ok_or(StudyError::NoHistory)?;
        let own = last.values().numbers().iter().filter(|(it, _)| it.row().is_known_by_process);
        numbers.extend(own);
        numbers.extend(setup.flow.measure(&last).map_err(SetupError::from)?.numbers);
        Ok(Self { numbers, status, seconds, last })
    }
}

/// The status of a history whose path was followed: converged if each state is.
fn worst(states: &[StateRow]) -> Status {
    let missed = states.iter().find(|state| state.fault.is_some());
    missed.map_or(Status::Converged, |state| state.status)
}
