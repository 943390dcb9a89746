//! The cycles of a path, and the energy that they lose.

use super::PathPoint;
use crate::contact::{Quantity, State, StateKind};
use std::borrow::Borrow;

/// The part of the energy lost by which the stored energy of a contact with adhesion may change in a closed cycle.
const CLOSED: f64 = 0.01;

/// The part of the largest stored energy, and of the rms height, up to which changes of the energy and of the gap are errors of the solves.
const SOLVED: f64 = 1e-6;
const SAME: f64 = 1e-3;

/// The energy that each closed cycle lost, per area of the cell: from a point of the path to the next one with the same loads, with
/// others between them. A cycle in which a contact with adhesion does not return to its stored energy and its gap is left out.
///
/// States name the point of the path that they have reached.
pub fn cycle_losses(path: &[PathPoint], states: &[impl Borrow<State>]) -> Vec<f64> {
    let states: &[&State] = &states.iter().map(Borrow::borrow).collect::<Vec<_>>();
    let closed = cycles(path, states).into_iter().filter(|ends| is_closed(*ends, states));
    closed.filter_map(|[from, to]| Some(to.get(Quantity::Dissipated)? - from.get(Quantity::Dissipated)?)).collect()
}

/// The number of cycles of a path after which a contact with adhesion has not returned to its state.
pub fn open_cycles(path: &[PathPoint], states: &[impl Borrow<State>]) -> usize {
    let states: &[&State] = &states.iter().map(Borrow::borrow).collect::<Vec<_>>();
    cycles(path, states).into_iter().filter(|ends| !is_closed(*ends, states)).count()
}

/// The first and the last state of each cycle of the loads.
fn cycles<'a>(path: &[PathPoint], states: &[&'a State]) -> Vec<[&'a State; 2]> {
    let is_same = |i: usize, j: usize| (path[i].load, path[i].tangential) == (path[j].load, path[j].tangential);
    let reached = |point: usize| states.iter().rev().copied().find(|state| state.point == Some(point));
    let mut cycles = Vec::new();
    let mut from = 0;
    while from < path.len() {
        let end = (from + 2..path.len()).find(|&to| is_same(from, to) && (from + 1..to).any(|i| !is_same(from, i)));
        match end {
            Some(to) => {
                cycles.extend(reached(from).zip(reached(to)).map(|(from, to)| [from, to]));
                from = to;
            }
            None => from += 1,
        }
    }
    cycles
}

/// Whether a contact with adhesion has the same stored energy and the same gap at both ends of a cycle. Other contacts are not compared.
fn is_closed([from, to]: [&State; 2], states: &[&State]) -> bool {
    if from.contact.values().kind != StateKind::Adhesion {
        return true;
    }
    let stored = |state: &State| state.get(Quantity::Stored).unwrap_or(0.0);
    let lost = [from, to].map(|state| state.get(Quantity::Dissipated).unwrap_or(0.0));
    let largest = states.iter().map(|state| stored(state).abs()).fold(0.0, f64::max);
    let moved = (&to.contact.gap - &from.contact.gap).iter().map(|by| by.abs()).fold(0.0, f64::max);
    (stored(to) - stored(from)).abs() <= (CLOSED * (lost[1] - lost[0]).abs()).max(SOLVED * largest)
        && moved <= SAME * from.contact.problem.rms_height()
}
