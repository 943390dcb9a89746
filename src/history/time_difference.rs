//! The same history in steps and in steps of twice the length.

use super::CreepState;
use super::time_errors::{TimeErrors, rms};
use crate::contact::Load;
use crate::surface::Field;

/// The least part of the root mean square of a difference that its mean is taken to be: means that cross zero say nothing.
const LEAST_MEAN: f64 = 0.25;
/// The area of a node that comes into contact, in areas of its cell: of a patch that begins with it.
const NODE: f64 = 0.5;
/// The part of what has flowed in nodes that came into contact in the last step which is stated as an error: it depends on when they came.
const NEW: f64 = 0.1;
/// The part of an error that the next step still states.
const FADING: f64 = 0.5;
/// Rounding of sums and transforms, relative.
const ROUNDING: f64 = 1e-13;

/// A state in doubled steps against the same one.
pub(super) struct Difference {
    pressure: f64,
    lost: f64,
    /// The error of the pressure over the pressure, 1 at most.
    relative: f64,
    energy_lost: f64,
    errors: TimeErrors,
}

impl Difference {
    /// Of states at one time, the second of which came from `earlier`.
    pub fn new(coarse: &CreepState, fine: &CreepState, earlier: &CreepState) -> Self {
        let pressure = &coarse.contact.pressure - &fine.contact.pressure;
        let gap = &coarse.contact.gap - &fine.contact.gap;
        let undecided = undecided(fine, [&pressure, &gap].map(largest));
        let off = rms(&pressure).max(late_pressure(coarse, fine)).max(NEW * new_pressure(fine, earlier));
        let mean = |field: &Field| field.mean().unwrap_or(0.0).abs().max(LEAST_MEAN * rms(field));
        let [is_pressure, is_gap] = [Load::is_pressure, |load: &Load| matches!(load, Load::MeanGap(_))]
            .map(|is| fine.load.as_ref().is_some_and(is));
        let area = (coarse.relative_area() - fine.relative_area()).abs();
        let [coarse_energy, energy] = [coarse.energy, fine.energy];
        let stored = (coarse_energy.stored - energy.stored).abs();
        let balance = (energy.work - energy.stored - energy.lost).abs();
        let size = rms(&fine.contact.pressure);
        let relative = if size > 0.0 { (off / size).min(1.0) } else { 0.0 };
        let turnover = energy.work.abs().max(energy.stored).max(energy.lost);
        let errors = TimeErrors {
            pressure: off.max(ROUNDING * size),
            mean_pressure: if is_pressure { 0.0 } else { mean(&pressure).max(LEAST_MEAN * off) },
            mean_gap: if is_gap { 0.0 } else { mean(&gap).max(ROUNDING * fine.contact.problem.rms_height()) },
            relative_area: area.max(undecided),
            lost: (coarse_energy.lost - energy.lost).abs().max(ROUNDING * energy.lost),
            work: (coarse_energy.work - energy.work).abs().max(stored).max(balance).max(ROUNDING * turnover),
        };
        let lost = (coarse_energy.lost - energy.lost).abs();
        Self { pressure: rms(&pressure), lost, relative, energy_lost: energy.lost, errors }
    }

    /// The errors of the state, with what is left of those of the state before, which had lost an energy.
    pub fn errors(&self, before: &TimeErrors, lost_before: f64) -> TimeErrors {
        let now = self.errors;
        let with = |now: f64, before: f64| now.max(FADING * before);
        TimeErrors {
            pressure: with(now.pressure, before.pressure),
            mean_pressure: if now.mean_pressure == 0.0 { 0.0 } else { with(now.mean_pressure, before.mean_pressure) },
            mean_gap: if now.mean_gap == 0.0 { 0.0 } else { with(now.mean_gap, before.mean_gap) },
            relative_area: with(now.relative_area, before.relative_area),
            // energies add up
            lost: now.lost.max(before.lost + self.relative * (self.energy_lost - lost_before)),
            work: now.work.max(before.work),
        }
    }

    /// The difference of the contact pressures, root mean square.
    pub fn pressure(&self) -> f64 {
        self.pressure
    }

    /// The difference of the lost energies, without regard to its sign.
    pub fn lost(&self) -> f64 {
        self.lost
    }

    /// The difference of the mean gaps.
    pub fn mean_gap(&self) -> f64 {
        self.errors.mean_gap
    }
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
    let nodes =
        |it: &CreepState| it.contact.pressure.iter().copied().zip(it.contact.gap.iter().copied()).collect::<Vec<_>>();
    let late = nodes(coarse).into_iter().zip(nodes(fine)).map(|((coarse_p, coarse_gap), (p, gap))| {
        let error = (coarse_gap - gap).abs();
        if (p > 0.0 && coarse_p > 0.0) || gap > error { 0.0 } else { error }
    });
    let (sum, count) = late.fold((0.0, 0), |(sum, count), error| (sum + error * error, count + 1));
    stiffest * (sum / f64::from(count.max(1))).sqrt()
}

/// The root mean square over all nodes of what the elements let flow of the pressure of those that were not in contact earlier.
fn new_pressure(state: &CreepState, earlier: &CreepState) -> f64 {
    let pairs = state.contact.pressure.iter().zip(&earlier.contact.pressure).zip(state.effective_pressure());
    let new = pairs.filter(|((now, before), _)| **before == 0.0 && **now > 0.0);
    let sum: f64 = new.map(|(_, effective)| effective * effective).sum();
    state.carried.flowed * (sum / state.contact.pressure.len() as f64).sqrt()
}

fn largest(field: &Field) -> f64 {
    field.iter().fold(0.0, |most, value| value.abs().max(most))
}
