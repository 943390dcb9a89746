//! A process that makes the next state of a contact from the last one.

use crate::contact::{Load, Observer, State, goes_on};
use crate::error::HistoryError;

/// A point of the path of a history. Between two points, loads change linearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// The time, for solids that creep.
    pub time: Option<f64>,
    /// The normal load. Its number may be zero: then nothing touches.
    pub load: Load,
    /// The tangential load, of the same kind as the normal one and of any sign, where there is friction.
    pub tangential: Option<f64>,
}

/// A process that makes the next state of a contact from the last one: loads one after the other, creep, slip, sliding, rolling, adhesion.
///
/// A process knows its path, and goes along it state by state; or it is moved by hand, to any point. Recordings, tables, archives and pictures know
/// states, and no process.
pub trait Process {
    /// The next state along the path; none at its end, and after an error. The observer sees the steps of all solves.
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>>;

    /// Moves the contact from its last state to a point, whatever the path is.
    ///
    /// # Errors
    /// For a point that the process cannot reach, and those of the solver.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError>;

    /// Goes along the path to its end, and gives each state to `each` as soon as it is solved.
    ///
    /// # Errors
    /// An error for a load that is impossible, [`HistoryError::Stopped`] for an observer that ends the history between two states, and those of the solver
    /// and of `each`. The history ends there.
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        while let Some(state) = self.next(observer) {
            each(state?)?;
            // a state without contact is found without a step of a solver
            if !goes_on(observer) {
                return Err(HistoryError::Stopped);
            }
        }
        Ok(())
    }
}

/// What receives the states of a history.
pub type EachState<'e> = dyn FnMut(State) -> Result<(), HistoryError> + 'e;

impl PathPoint {
    /// A point with a load alone.
    pub fn under(load: Load) -> Self {
        Self { time: None, load, tangential: None }
    }
}
