//! The same history in steps and in steps of twice the length.

use super::CreepState;
use super::time_errors::{TimeErrors, rms};
use crate::contact::Load;
use crate::surface::{Field, largest};

/// The least part of the root mean square of a difference that its mean is taken to be: means that cross zero say nothing.
const LEAST_MEAN: f64 = 0.25;
/// The area of a node that comes into contact, in areas of its cell: of a patch that begins with it.
const NODE: f64 = 0.5;
/// The error of the area that is stated at least where the pressures have one, in areas of the cell of a node: edges are interpolated between nodes.
const LEAST_EDGE_ERROR: f64 = 5e-3;
/// The relative error of the pressures from which they have one.
const SMALL: f64 = 1e-9;
/// The part of what has flowed in nodes that came into contact in the last step which is stated as an error: it depends on when they came.
const NEW: f64 = 0.1;
/// The part of an error that the next step still states.
const FADING: f64 = 0.5;
/// The part of what is missing in the balance of the energies that is stated as an error of the loss at least: where a contact recedes, the difference of
/// the losses may be small by chance. True errors were up to a fiftieth of what was missing there.
const OF_BALANCE: f64 = 0.05;
/// Rounding of sums and transforms, relative.
const ROUNDING: f64 = 1e-13;

/// How far a state in doubled steps is from the same one: what steps are chosen by.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Difference {
    /// Of the contact pressures, root mean square over the nodes.
    pub pressure: f64,
    /// Of the mean gaps; 0 where the load prescribes it.
    pub mean_gap: f64,
    /// Of the lost energies.
    pub lost: f64,
}

impl Difference {
    /// Of two states at one time.
    pub(crate) fn new(coarse: &CreepState, fine: &CreepState) -> Self {
        let gap = &coarse.contact.gap - &fine.contact.gap;
        Self {
            pressure: rms(&(&coarse.contact.pressure - &fine.contact.pressure)),
            mean_gap: if is_at_gap(fine) { 0.0 } else { mean(&gap) },
            lost: (coarse.energy.lost - fine.energy.lost).abs(),
        }
    }
}

/// The errors of a state that came from `earlier`, from the same one in doubled steps, with what is left of the errors of the state `before`. Both
/// histories may have left out a part of the energy lost since then. Doubled steps led from `coarse_before` to `coarse`.
pub(super) fn errors_in_time(
    [coarse, coarse_before]: [&CreepState; 2],
    [fine, earlier, before]: [&CreepState; 3],
    left_out: f64,
) -> TimeErrors {
    let told = before.time_errors.unwrap_or_default();
    let pressure = &coarse.contact.pressure - &fine.contact.pressure;
    let gap = &coarse.contact.gap - &fine.contact.gap;
    let size = rms(&fine.contact.pressure);
    let off = rms(&pressure).max(late_pressure(coarse, fine)).max(NEW * new_pressure(fine, earlier));
    let relative = if size > 0.0 { (off / size).min(1.0) } else { 0.0 };
    let edge = if relative > SMALL { LEAST_EDGE_ERROR / fine.contact.pressure.len() as f64 } else { 0.0 };
    let area = (coarse.relative_area() - fine.relative_area()).abs().max(edge);
    let [other, energy] = [coarse.energy, fine.energy];
    let turnover = energy.work.abs().max(energy.stored).max(energy.lost);
    let balance = (energy.work - energy.stored - energy.lost).abs();
    let work = (other.work - energy.work).abs().max((other.stored - energy.stored).abs()).max(balance);
    let since = energy.lost - before.energy.lost;
    // by how much the histories moved apart: differences of other signs before and after must not hide what a cycle between them is off by
    let moved = (other.lost - coarse_before.energy.lost - since).abs();
    let lost = (other.lost - energy.lost).abs().max(ROUNDING * energy.lost).max(OF_BALANCE * balance);
    let with = |now: f64, before: f64| now.max(FADING * before);
    let is_pressure = fine.load.as_ref().is_some_and(Load::is_pressure);
    TimeErrors {
        pressure: with(off.max(ROUNDING * size), told.pressure),
        mean_pressure: match is_pressure {
            true => 0.0,
            false => with(mean(&pressure).max(LEAST_MEAN * off), told.mean_pressure),
        },
        mean_gap: match is_at_gap(fine) {
            true => 0.0,
            false => with(mean(&gap).max(ROUNDING * fine.contact.problem.rms_height()), told.mean_gap),
        },
        relative_area: with(area.max(undecided(fine, [&pressure, &gap].map(largest))), told.relative_area),
        // energies add up
        lost: lost.max(told.lost + moved.max(relative.max(left_out) * since)),
        work: work.max(ROUNDING * turnover).max(told.work + left_out * since),
    }
}

/// The mean of a difference, and no less than a part of its root mean square.
fn mean(field: &Field) -> f64 {
    field.mean().unwrap_or(0.0).abs().max(LEAST_MEAN * rms(field))
}

/// Whether the load of a state prescribes its mean gap.
fn is_at_gap(state: &CreepState) -> bool {
    matches!(state.load, Some(Load::MeanGap(_)))
}

/// The part of the area whose nodes may be in contact or not, since their pressure or gap is below the largest errors of these.
fn undecided(state: &CreepState, [pressure, gap]: [f64; 2]) -> f64 {
    let contact = &state.contact;
    let is_undecided = |(p, g): &(&f64, &f64)| if **p > 0.0 { **p < pressure } else { **g < gap };
    let count = contact.pressure.iter().zip(&contact.gap).filter(is_undecided).count();
    NODE * count as f64 / contact.pressure.len() as f64
}

/// The pressure of nodes that come into contact late or early, root mean square over all nodes: those that are open in one of the histories and
/// whose gap is not above its error. A node that comes alone carries its gap times the largest stiffness.
fn late_pressure(coarse: &CreepState, fine: &CreepState) -> f64 {
    let [_, stiffest] = fine.contact.problem.compliance().stiffness_range();
    let pressures = coarse.contact.pressure.iter().zip(&fine.contact.pressure);
    let gaps = coarse.contact.gap.iter().zip(&fine.contact.gap);
    let late = pressures.zip(gaps).map(|((coarse_p, p), (coarse_gap, gap))| {
        let error = (coarse_gap - gap).abs();
        if (*p > 0.0 && *coarse_p > 0.0) || *gap > error { 0.0 } else { error * error }
    });
    stiffest * (late.sum::<f64>() / fine.contact.gap.len() as f64).sqrt()
}

/// The root mean square over all nodes of what the elements let flow of the pressure of those that were not in contact earlier.
fn new_pressure(state: &CreepState, earlier: &CreepState) -> f64 {
    let pairs = state.contact.pressure.iter().zip(&earlier.contact.pressure).zip(state.effective_pressure());
    let new = pairs.filter(|((now, before), _)| **before == 0.0 && **now > 0.0);
    let sum: f64 = new.map(|(_, effective)| effective * effective).sum();
    state.carried.flowed * (sum / state.contact.pressure.len() as f64).sqrt()
}
