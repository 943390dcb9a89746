//! A process that makes the next state of a contact from the last one.

use crate::contact::{Load, Observer, State};
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

/// A process that makes the next state of a contact from the last one: creep, slip, sliding, rolling. It knows its path.
///
/// Tables, recordings and pictures know states, and no process.
pub trait Process {
    /// Goes along the path, and gives each state to `each` as soon as it is solved. The observer sees the steps of all solves.
    ///
    /// # Errors
    /// An error for a load that is impossible, and those of the solver and of `each`. The history ends there.
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError>;
}

/// What receives the states of a history.
pub type EachState<'e> = dyn FnMut(State) -> Result<(), HistoryError> + 'e;
