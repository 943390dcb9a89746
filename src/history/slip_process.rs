//! The process of partial slip along a path of loads.

use super::process::{PathPoint, Process};
use super::slip::SlipHistory;
use crate::contact::{Observer, State};
use crate::error::HistoryError;

/// The process of partial slip: a number of equal steps from one point of its path to the next.
pub struct SlipProcess<'s> {
    history: SlipHistory<'s>,
    path: Vec<PathPoint>,
    steps: usize,
    /// The next point of the path, and the next step on the way to it, from 1.
    at: (usize, usize),
    /// The normal and the tangential load at the point before.
    from: [f64; 2],
    /// The shift and the dissipated energy so far.
    sums: [f64; 2],
}

impl<'s> SlipProcess<'s> {
    /// The process of a history that has not begun, with at least one step between two points. The normal load of the first point
    /// is applied first, and then its tangential load.
    pub fn new(history: SlipHistory<'s>, path: Vec<PathPoint>, steps: usize) -> Self {
        let from = path.first().map_or([0.0; 2], |first| [first.load.value(), 0.0]);
        Self { history, path, steps: steps.max(1), at: (0, 1), from, sums: [0.0; 2] }
    }
}

impl Process for SlipProcess<'_> {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let ((number, step), point) = (self.at, *self.path.get(self.at.0)?);
        let (from, to) = (self.from, [point.load.value(), point.tangential.unwrap_or(0.0)]);
        let steps = if from == to { 1 } else { self.steps };
        let (share, is_there) = (step as f64 / steps as f64, step == steps);
        let at = |i: usize| if is_there { to[i] } else { from[i] + share * (to[i] - from[i]) };
        self.at = if is_there { (number + 1, 1) } else { (number, step + 1) };
        if is_there {
            self.from = to;
        }
        let there = PathPoint { load: point.load.with_value(at(0)), tangential: Some(at(1)), ..point };
        let state = self.move_to(there, observer);
        if state.is_err() {
            self.at = (self.path.len(), 1);
        }
        Some(state.map(|state| state.at(is_there.then_some(number))))
    }

    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let state = self.history.step(point.load, point.tangential.unwrap_or(0.0), observer)?;
        self.sums = [self.sums[0] + state.shift, self.sums[1] + state.dissipated];
        Ok(state.into_state(None, self.sums))
    }
}
