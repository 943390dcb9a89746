//! What a history with adhesion adds up to.

use crate::contact::{Quantity, ResultClaim, State, StateRow};
use serde::Serialize;
use std::borrow::Borrow;

/// What a history with adhesion adds up to. The frames of a motion do not count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AdhesionTotals {
    /// The lowest mean pressure on the way, also between the states that are shown; negative if the surfaces stick: the pull-off pressure, if they
    /// parted. None if they were apart from the first.
    pub lowest_pressure: Option<f64>,
    /// Whether the surfaces parted under the load.
    pub separated: bool,
    /// The jumps.
    pub jumps: Vec<AdhesionJump>,
    /// Energy lost in all jumps, per area of the cell; until the surfaces part, if they part under the load.
    pub lost_in_jumps: f64,
    /// Estimated error of `lost_in_jumps`, per area of the cell: what the places of the jumps leave open, and what the integral of the pressure over the
    /// datum misses on the branches between them, where nothing is lost. None on free boundaries, where the stability of states is not known.
    pub lost_error: Option<f64>,
}

/// A jump: from one state to another one, under the same load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AdhesionJump {
    /// The number of the state after the jump, from 1.
    pub state: usize,
    /// Mean gap before and after, a length.
    pub mean_gap: [f64; 2],
    /// Mean pressure before and after.
    pub mean_pressure: [f64; 2],
    /// Share of nodes that touch before and after.
    pub relative_area: [f64; 2],
    /// Energy lost, per area of the cell.
    pub energy: f64,
}

impl AdhesionTotals {
    /// The totals of the states of a history with adhesion; none where there are no states. The state before a jump is the last one that is not a frame of the
    /// motion.
    pub fn new(states: &[impl Borrow<State>]) -> Option<Self> {
        let rows: Vec<StateRow> = states.iter().map(|state| StateRow::new(state.borrow())).collect();
        Self::from_rows(&rows)
    }

    /// The same, of states whose numbers alone were kept.
    pub fn from_rows(states: &[StateRow]) -> Option<Self> {
        let first = states.first()?;
        let separated = states.iter().any(|state| state.claim == ResultClaim::Separated);
        let pressure = |state: &StateRow| state.value(Quantity::MeanPressure);
        let is_frame = |state: &StateRow| state.claim == ResultClaim::Moving;
        let held = states.iter().filter(|state| state.claim != ResultClaim::Separated && !is_frame(state));
        let jump = |i: usize| {
            let energy = states[i].get(Quantity::Jump)?;
            let before = states[..i].iter().rfind(|state| !is_frame(state))?;
            let pair = |of: &dyn Fn(&StateRow) -> f64| [of(before), of(&states[i])];
            Some(AdhesionJump {
                state: i + 1,
                mean_gap: pair(&|state| state.value(Quantity::MeanGap)),
                mean_pressure: pair(&pressure),
                relative_area: pair(&|state| state.value(Quantity::RelativeArea)),
                energy,
            })
        };
        let known = |quantity: Quantity| states.iter().rev().find_map(|state| state.get(quantity));
        Some(Self {
            // states that were saved by an earlier version do not know what was between them
            lowest_pressure: known(Quantity::LowestPressure).or(held.map(pressure).reduce(f64::min)),
            separated,
            jumps: (1..states.len()).filter_map(jump).collect(),
            lost_in_jumps: known(Quantity::Dissipated).unwrap_or(0.0) - first.get(Quantity::Dissipated).unwrap_or(0.0),
            lost_error: known(Quantity::DissipatedError),
        })
    }
}
