//! A history as one row of a study.

use crate::contact::{Contact, Observer, Quantity, ResultClaim, State, Status};
use crate::error::{AdhesionError, HistoryError, SetupError, StudyError};
use crate::history::AdhesionTotals;
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
        let mut states: Vec<State> = Vec::new();
        let mut process = setup.history(setup.problem()?)?.ok_or(StudyError::NoHistory)?;
        let ended = process.run(observer, &mut |state| {
            states.push(state);
            Ok(())
        });
        let status = match ended {
            Err(error) if states.is_empty() => return Err(SetupError::from(error).into()),
            Err(HistoryError::Stopped) => Status::StoppedByObserver,
            Err(HistoryError::Adhesion(AdhesionError::NotFound { .. })) => Status::Stalled,
            Err(error) => return Err(SetupError::from(error).into()),
            Ok(()) => worst(&states),
        };
        let seconds = states.iter().map(|state| state.contact.work.seconds).sum();
        let mut numbers = totals(&states);
        let last = states.pop().ok_or(StudyError::NoHistory)?.contact;
        let own = last.values().numbers().iter().filter(|(it, _)| it.row().is_known_by_process);
        numbers.extend(own);
        numbers.extend(setup.flow.measure(&last).map_err(SetupError::from)?.numbers);
        Ok(Self { numbers, status, seconds, last })
    }
}

/// The status of a history whose path was followed: converged if each state is.
fn worst(states: &[State]) -> Status {
    let missed = states.iter().find(|state| !state.contact.is_converged());
    missed.map_or(Status::Converged, |state| state.contact.status)
}

/// What some states add up to.
fn totals(states: &[State]) -> Vec<(Quantity, f64)> {
    let flag = |is_true: bool| Some(f64::from(u8::from(is_true)));
    let is_state = |it: &&State| it.claim != ResultClaim::Moving;
    let is_certain =
        |state: &State| matches!(state.claim, ResultClaim::Stable | ResultClaim::Solution | ResultClaim::Separated);
    let held = || states.iter().filter(is_state);
    let area = held().filter_map(|state| state.get(Quantity::RelativeArea)).reduce(f64::max);
    let transforms: u64 = states.iter().map(|state| state.contact.work.transforms).sum();
    let of_all = [
        (Quantity::LargestArea, area),
        (Quantity::States, Some(held().count() as f64)),
        (Quantity::HistoryTransforms, Some(transforms as f64)),
    ];
    let of_adhesion = AdhesionTotals::new(states).map(|it| {
        [
            (Quantity::LowestPressure, it.lowest_pressure),
            (Quantity::Separated, flag(it.separated)),
            (Quantity::Jumps, Some(it.jumps.len() as f64)),
            (Quantity::LostInJumps, Some(it.lost_in_jumps)),
            (Quantity::LostError, it.lost_error),
            (Quantity::Stable, flag(held().all(is_certain))),
        ]
    });
    let all = of_all.into_iter().chain(of_adhesion.into_iter().flatten());
    all.filter_map(|(quantity, value)| Some((quantity, value?))).collect()
}
