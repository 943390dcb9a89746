//! The gap with which a search for a state with adhesion begins.

use super::control::AdhesiveControl;
use super::gap_energy::{GapEnergy, GapState, mean};
use super::state::AdhesiveState;
use crate::contact::Problem;

/// The gap of a state, moved rigidly to another control. Nodes that touch stay in contact, unless all do.
pub(super) fn moved(problem: &Problem, state: &AdhesiveState, control: AdhesiveControl) -> Vec<f64> {
    let gap = state.contact.gap.as_slice().expect("results are made in standard layout");
    let by = match control {
        AdhesiveControl::MeanPressure(_) => 0.0,
        AdhesiveControl::MeanGap(goal) => goal - mean(gap),
        AdhesiveControl::Approach(approach) => problem.highest() - approach - state.datum,
    };
    let moves = movable(gap);
    gap.iter().zip(moves).map(|(g, moves)| if moves { (g + by).max(0.0) } else { 0.0 }).collect()
}

/// The state of a gap that is carried to the given mean by the nodes that do not touch, or, if all touch, by all of them.
pub(super) fn first_state(energy: &mut GapEnergy<'_>, mut gap: Vec<f64>) -> GapState {
    let moves = movable(&gap);
    energy.carry(&mut gap, |i| moves[i]);
    energy.state(gap)
}

/// Whether each node of a gap does not touch; all of them where all touch.
fn movable(gap: &[f64]) -> Vec<bool> {
    let all_touch = gap.iter().all(|g| *g <= 0.0);
    gap.iter().map(|g| all_touch || *g > 0.0).collect()
}
