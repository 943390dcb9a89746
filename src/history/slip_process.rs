//! The process of partial slip along a path of loads.

use super::process::{EachState, PathPoint, Process};
use super::slip::SlipHistory;
use crate::contact::Observer;
use crate::error::HistoryError;

/// The process of partial slip: a number of equal steps from one point of its path to the next.
pub struct SlipProcess<'s> {
    history: SlipHistory<'s>,
    path: Vec<PathPoint>,
    steps: usize,
}

impl<'s> SlipProcess<'s> {
    /// The process of a history that has not begun, with at least one step between two points. The normal load of the first point
    /// is applied first, and then its tangential load.
    pub fn new(history: SlipHistory<'s>, path: Vec<PathPoint>, steps: usize) -> Self {
        Self { history, path, steps: steps.max(1) }
    }
}

impl Process for SlipProcess<'_> {
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        let ends = |point: &PathPoint| [point.load.value(), point.tangential.unwrap_or(0.0)];
        let mut from = self.path.first().map_or([0.0; 2], |first| [first.load.value(), 0.0]);
        let [mut shift, mut dissipated] = [0.0; 2];
        for (number, point) in self.path.iter().enumerate() {
            let to = ends(point);
            let steps = if from == to { 1 } else { self.steps };
            for step in 1..=steps {
                let share = step as f64 / steps as f64;
                let at = |i: usize| if step == steps { to[i] } else { from[i] + share * (to[i] - from[i]) };
                let state = self.history.step(point.load.with_value(at(0)), at(1), observer)?;
                (shift, dissipated) = (shift + state.shift, dissipated + state.dissipated);
                each(state.into_state((step == steps).then_some(number), [shift, dissipated]))?;
            }
            from = to;
        }
        Ok(())
    }
}
