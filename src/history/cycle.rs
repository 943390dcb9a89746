//! The energy that closed cycles of a path lose.

use super::{HistoryState, PathPoint};

/// The energy that each closed cycle lost, per area of the cell: from a point of the path to the next one with the same loads, with
/// others between them.
///
/// States name the point of the path that they have reached.
pub fn cycle_losses(path: &[PathPoint], states: &[HistoryState]) -> Vec<f64> {
    let is_same = |i: usize, j: usize| (path[i].load, path[i].tangential) == (path[j].load, path[j].tangential);
    let dissipated = |point: usize| {
        states.iter().rev().find(|state| state.point == Some(point)).and_then(|state| state.numbers.dissipated)
    };
    let mut losses = Vec::new();
    let mut from = 0;
    while from < path.len() {
        let end = (from + 2..path.len()).find(|&to| is_same(from, to) && (from + 1..to).any(|i| !is_same(from, i)));
        match end {
            Some(to) => {
                losses.extend(dissipated(from).zip(dissipated(to)).map(|(before, after)| after - before));
                from = to;
            }
            None => from += 1,
        }
    }
    losses
}
