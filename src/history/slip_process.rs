//! The process of partial slip along a path of loads.

use super::process::{PathPoint, Process};
use super::slip::SlipHistory;
use super::slip_steps::{SlipPace, SlipSteps};
use crate::contact::{Observer, State};
use crate::error::HistoryError;

/// The process of partial slip: equal steps from one point of its path to the next with a state after each of them, or as many as a tolerance
/// needs with a state at each point.
pub struct SlipProcess<'s> {
    steps: SlipSteps<'s>,
    path: Vec<PathPoint>,
    /// The next point of the path, and the next step on the way to it, from 1.
    at: (usize, usize),
    /// The normal and the tangential load at the point before.
    begin: [f64; 2],
    /// Those of the last state.
    last: [f64; 2],
}

impl<'s> SlipProcess<'s> {
    /// The process of a history that has not begun. The normal load of the first point is applied first, and then its tangential load. Between two
    /// points there is at least one step.
    pub fn new(history: SlipHistory<'s>, path: Vec<PathPoint>, pace: SlipPace) -> Self {
        let begin = path.first().map_or([0.0; 2], |first| [first.load.value(), 0.0]);
        Self { steps: SlipSteps::new(history, pace), path, at: (0, 1), begin, last: begin }
    }

    fn go(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let to = [point.load.value(), point.tangential.unwrap_or(0.0)];
        if !self.steps.has_begun() {
            self.last = [to[0], 0.0];
        }
        let state = self.steps.go(point.load, [self.last, to], observer)?;
        self.last = to;
        Ok(state.into_state(None, self.steps.totals()))
    }
}

impl Process for SlipProcess<'_> {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let ((number, step), point) = (self.at, *self.path.get(self.at.0)?);
        let (from, to) = (self.begin, [point.load.value(), point.tangential.unwrap_or(0.0)]);
        let steps = match self.steps.pace() {
            SlipPace::Count(count) if from != to => count.max(1),
            _ => 1,
        };
        let (share, is_there) = (step as f64 / steps as f64, step >= steps);
        let at = |i: usize| if is_there { to[i] } else { from[i] + share * (to[i] - from[i]) };
        self.at = if is_there { (number + 1, 1) } else { (number, step + 1) };
        if is_there {
            self.begin = to;
        }
        let there = PathPoint { load: point.load.with_value(at(0)), tangential: Some(at(1)), ..point };
        let state = self.go(there, observer);
        if state.is_err() {
            self.at = (self.path.len(), 1);
        }
        Some(state.map(|state| state.at(is_there.then_some(number))))
    }

    /// Goes on to a point, in as many steps as the tolerance needs or in one. The first point is reached as that of a path is: under its
    /// normal load first.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        self.go(point, observer)
    }
}
