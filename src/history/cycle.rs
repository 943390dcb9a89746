//! The cycles of a path, and the energy that they lose.

use super::PathPoint;
use super::time_errors::rms;
use crate::contact::{FieldKind, Quantity, State};
use crate::surface::Field;
use std::borrow::Borrow;

/// Largest difference of a field or of the shift between the ends of a closed cycle, over its largest difference within the cycle: an energy lost
/// per cycle is off by about this part, if the next cycle begins where this one ends.
const CLOSED: f64 = 0.01;

/// The part of the size of a field or of the largest stored energy up to which changes are errors of the solves.
const SOLVED: f64 = 1e-6;

/// The further fields that a state carries on to the next one. Slip belongs to a step, and says nothing of the state at its end.
const CARRIED: [FieldKind; 4] =
    [FieldKind::Traction, FieldKind::TractionAcross, FieldKind::StoredStrain, FieldKind::Attraction];

/// The energy that each closed cycle lost, per area of the cell: from a point of the path to the next one with the same loads, gone through in the
/// same direction, at which the contact has returned to its state, with other loads between them. The next cycle begins where one ends.
///
/// A state has returned where pressure, gap, traction, memory, attraction, shift and stored energy have, to 1 % of their changes within the cycle.
/// Half a cycle does not, and neither does a solid that still creeps from its first load.
///
/// States name the point of the path that they have reached.
pub fn cycle_losses(path: &[PathPoint], states: &[impl Borrow<State>]) -> Vec<CycleLoss> {
    Cycles::new(path, states).closed.into_iter().filter_map(CycleLoss::between).collect()
}

/// The energy that a closed cycle lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleLoss {
    /// The energy, per area of the cell.
    pub energy: f64,
    /// Its estimated error by the steps in time or by the steps of the path, per area. None where the states have no such error.
    pub error: Option<f64>,
}

impl CycleLoss {
    /// The loss between the first and the last state of a cycle. Errors of a lost energy add up from state to state, so the cycle has what they
    /// grew by.
    fn between([from, to]: [&State; 2]) -> Option<Self> {
        let added = |of: Quantity| Some(to.get(of)? - from.get(of)?);
        let error = added(Quantity::DissipatedTimeError).or_else(|| added(Quantity::DissipatedPathError));
        Some(Self { energy: added(Quantity::Dissipated)?, error })
    }
}

/// The number of cycles of a path after which a contact with adhesion has not returned to its state. Other contacts are not counted: they return
/// to it after several cycles, or never.
pub fn open_cycles(path: &[PathPoint], states: &[impl Borrow<State>]) -> usize {
    Cycles::new(path, states).open
}

/// The cycles of a path.
#[derive(Default)]
struct Cycles<'a> {
    /// First and last state of each closed cycle.
    closed: Vec<[&'a State; 2]>,
    /// Points with adhesion from which the loads return, and the contact does not.
    open: usize,
}

impl<'a> Cycles<'a> {
    fn new(path: &[PathPoint], states: &'a [impl Borrow<State>]) -> Self {
        let states: Vec<&State> = states.iter().map(Borrow::borrow).collect();
        let reached = |point: usize| states.iter().rposition(|state| state.point == Some(point));
        let mut cycles = Self::default();
        let mut from = 0;
        while from < path.len() {
            let knows_loss = |begin: &usize| states[*begin].get(Quantity::Dissipated).is_some();
            let Some(begin) = reached(from).filter(knows_loss) else {
                from += 1;
                continue;
            };
            let ends: Vec<(usize, usize)> = ends(path, from).filter_map(|to| Some((to, reached(to)?))).collect();
            match ends.iter().find(|(_, end)| is_closed(&states[begin..=*end])) {
                Some(&(to, end)) => {
                    cycles.closed.push([states[begin], states[end]]);
                    from = to;
                }
                None => {
                    let is_open = !ends.is_empty() && states[begin].contact.values().feels.attraction;
                    cycles.open += usize::from(is_open);
                    from += 1;
                }
            }
        }
        cycles
    }
}

/// The points at which a cycle of the loads from a point ends: the first one, and those up to which its loads are held. A later return would end several
/// cycles.
fn ends(path: &[PathPoint], from: usize) -> impl Iterator<Item = usize> {
    let first = (from + 2..path.len()).find(|&to| is_cycle(path, from, to)).unwrap_or(path.len());
    (first..path.len()).take_while(move |&to| loads(&path[to]) == loads(&path[from]))
}

/// Whether a path has the same loads at two points, in the same direction, and others between them.
fn is_cycle(path: &[PathPoint], from: usize, to: usize) -> bool {
    let is_same = |i: usize, j: usize| loads(&path[i]) == loads(&path[j]);
    is_same(from, to) && (from + 1..to).any(|i| !is_same(from, i)) && is_in_same_direction(path, from, to)
}

/// Whether loads come to two points from the same side, and leave them to the same side, as far as there are loads before and after both of them.
/// From 0 to Q and back to 0 is half a cycle of a path that goes on to -Q.
fn is_in_same_direction(path: &[PathPoint], from: usize, to: usize) -> bool {
    let before = |point: usize| (0..point).rev().find_map(|i| direction(&path[i], &path[point]));
    let after = |point: usize| (point + 1..path.len()).find_map(|i| direction(&path[point], &path[i]));
    let agree = |one: Option<[f64; 2]>, other: Option<[f64; 2]>| one.zip(other).is_none_or(|(one, other)| one == other);
    agree(before(from), before(to)) && agree(after(from), after(to))
}

/// The signs of the changes of both loads from one point to another; none where neither changes.
fn direction(from: &PathPoint, to: &PathPoint) -> Option<[f64; 2]> {
    let [from, to] = [loads(from), loads(to)];
    let sign = |change: f64| if change == 0.0 { 0.0 } else { change.signum() };
    (from != to).then(|| [0, 1].map(|i| sign(to[i] - from[i])))
}

/// The normal and the tangential load of a point.
fn loads(point: &PathPoint) -> [f64; 2] {
    [point.load.value(), point.tangential.unwrap_or(0.0)]
}

/// Whether the last of some states, which follow each other, is the first one again.
fn is_closed(states: &[&State]) -> bool {
    let [Some(first), Some(last)] = [states.first(), states.last()] else { return false };
    let told = |of: Quantity| [first, last].iter().filter_map(|state| state.get(of)).sum::<f64>();
    // what the steps in time may have changed is no reason to call a cycle open
    let [in_pressure, in_gap] = [Quantity::TimeError, Quantity::MeanGapTimeError].map(told);
    let pressure = rms(&first.contact.pressure);
    // where all nodes touch, gaps are nothing but rounding
    let in_gap = in_gap + SOLVED * first.contact.problem.rms_height();
    // numbers first: most open cycles differ in them, and fields are long
    has_shift_returned(states)
        && has_energy_returned(states, told(Quantity::WorkTimeError))
        && has_returned(states, |state| Some(&state.contact.pressure), in_pressure * pressure)
        && has_returned(states, |state| Some(&state.contact.gap), in_gap)
        && CARRIED.iter().all(|&kind| {
            let memory = first.field(kind).map_or(0.0, rms);
            has_returned(states, |state| state.field(kind), in_pressure * memory)
        })
}

/// Whether a field of the last of some states is that of the first one, but for what it changes between them and for a known error. A field that the
/// states do not have returns.
fn has_returned<'a>(states: &[&'a State], field: impl Fn(&'a State) -> Option<&'a Field>, error: f64) -> bool {
    let Some(first) = field(states[0]) else { return true };
    let Some(last) = field(states[states.len() - 1]) else { return false };
    let others = || states.iter().filter_map(|state| field(state));
    let change = others().map(|other| rms(&(other - first))).fold(0.0, f64::max);
    let size = others().map(rms).fold(0.0, f64::max);
    rms(&(last - first)) <= CLOSED * change + SOLVED * size + error
}

/// Whether the rigid surface is back where it was along x, where friction holds it.
fn has_shift_returned(states: &[&State]) -> bool {
    let shifts: Vec<f64> = states.iter().filter_map(|state| state.get(Quantity::Shift)).collect();
    let [Some(first), Some(last)] = [shifts.first(), shifts.last()] else { return true };
    let change = shifts.iter().map(|shift| (shift - first).abs()).fold(0.0, f64::max);
    (last - first).abs() <= (CLOSED + SOLVED) * change
}

/// Whether the stored energy is the same but for a part of what was lost. It sees what the sum of several memories, or few of many contacts that stick,
/// do not show. Of friction the traction is the whole memory.
fn has_energy_returned(states: &[&State], error: f64) -> bool {
    let [first, last] = [states[0], states[states.len() - 1]];
    let feels = first.contact.values().feels;
    if !(feels.attraction || feels.memory) {
        return true;
    }
    let stored = |state: &State| state.get(Quantity::Stored).unwrap_or(0.0);
    let [before, after] = [first, last].map(|state| state.get(Quantity::Dissipated).unwrap_or(0.0));
    let largest = states.iter().map(|state| stored(state).abs()).fold(0.0, f64::max);
    (stored(last) - stored(first)).abs() <= CLOSED * (after - before).abs() + SOLVED * largest + error
}
