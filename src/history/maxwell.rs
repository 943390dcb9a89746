//! One step in time of the elements of a generalised Maxwell solid.
//!
//! Letters of this file: `rho` the relaxation time, `e = exp(-dt/rho)`, `p_e` the effective pressure, `D` its change over the step,
//! `psi` what the element holds of it, `|x|^2 = <x A x>`.

use super::profile::StepProfile;
use crate::elastic::PronyTerm;
use crate::theory::integral;

/// Panels of an integral over a step grow by this factor.
const GROWTH: f64 = 8.0;

/// How an element goes over a step: `y <- keep y + share D`, from `rho dy/dt + y = g rho d p_e/dt`.
#[derive(Debug, Clone, Copy)]
pub(super) struct MaxwellStep {
    /// `g`.
    pub ratio: f64,
    /// `e`.
    pub keep: f64,
    /// `psi` at the end of the step.
    pub held: f64,
    /// `int exp(-2s/rho) ds/rho`.
    fading: f64,
    /// `int exp(-s/rho) psi(s) ds/rho`.
    mixed: f64,
    /// `int psi(s)^2 ds/rho`.
    brought: f64,
}

impl MaxwellStep {
    /// The step of a term in relaxation form.
    pub(crate) fn new(term: &PronyTerm, profile: &StepProfile) -> Self {
        let (rho, k) = (term.time, profile.dt() / term.time);
        let [mixed, brought] = if k > 0.0 {
            let held = |s: f64| profile.held(s, rho);
            [over_step(profile, rho, |s| (-s / rho).exp() * held(s)), over_step(profile, rho, |s| held(s).powi(2))]
        } else {
            [0.0; 2]
        };
        Self {
            ratio: term.ratio,
            keep: (-k).exp(),
            held: profile.held(profile.dt(), rho),
            fading: -0.5 * (-2.0 * k).exp_m1(),
            mixed,
            brought,
        }
    }

    /// `g psi`, the part of the change `D` that the element holds at the end.
    pub(crate) fn share(&self) -> f64 {
        self.ratio * self.held
    }

    /// The energy that the dashpot takes up, per area: `1/(g rho) int |y|^2 ds` with `y(s) = y_0 exp(-s/rho) + g psi(s) D`, from
    /// `|y_0|^2`, `<y_0 A D>` and `|D|^2`.
    pub(crate) fn dissipated(&self, [square, with_change, change]: [f64; 3]) -> f64 {
        let Self { ratio, fading, mixed, brought, .. } = *self;
        (square / ratio * fading + 2.0 * mixed * with_change + ratio * brought * change).max(0.0)
    }

    /// `int y(s) phi'(s) ds` of numbers: what the element adds to the mean pressure, weighted by the progress of the step. By parts,
    /// `int psi phi' = psi^2/2 + int psi^2 ds/rho`.
    pub(crate) fn weighted(&self, held_before: f64, change: f64) -> f64 {
        let Self { ratio, keep, held, mixed, brought, .. } = *self;
        held_before * (keep * held + 2.0 * mixed) + ratio * change * (0.5 * held * held + brought)
    }
}

/// `int_0^dt f(s) ds/rho`, on panels that grow from the shortest time on which `f` changes.
fn over_step(profile: &StepProfile, rho: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (dt, mut from, mut sum) = (profile.dt(), 0.0, 0.0);
    let mut to = GROWTH * rho.min(profile.shortest_time());
    loop {
        sum += integral(from, to.min(dt), &f);
        if to >= dt {
            return sum / rho;
        }
        (from, to) = (to, GROWTH * to);
    }
}

#[cfg(test)]
mod tests {
    use super::super::profile::MeanStrain;
    use super::*;

    /// The element by many small steps of fourth order, with numbers for fields and `A = 1`: its end, the energy lost, and
    /// `int y dphi`.
    fn integrated(term: &PronyTerm, dt: f64, before: f64, slope_at: impl Fn(f64) -> f64) -> [f64; 3] {
        let count = 40_000;
        let h = dt / f64::from(count);
        let slope = |s: f64, y: f64| term.ratio * slope_at(s) - y / term.time;
        (0..count).fold([before, 0.0, 0.0], |[y, lost, work], i| {
            let s = f64::from(i) * h;
            let a = slope(s, y);
            let middle = y + 0.5 * h * a;
            let b = slope(s + 0.5 * h, middle);
            let c = slope(s + 0.5 * h, y + 0.5 * h * b);
            let end = y + h * (a + 2.0 * (b + c) + slope(s + h, y + h * c)) / 6.0;
            let middle = y + 0.25 * h * (a + b);
            let square = (y * y + 4.0 * middle * middle + end * end) / 6.0;
            let power = (y * slope_at(s) + 4.0 * middle * slope_at(s + 0.5 * h) + end * slope_at(s + h)) / 6.0;
            [end, lost + h * square / (term.ratio * term.time), work + h * power]
        })
    }

    #[test]
    fn steps_are_those_of_the_differential_equation() {
        let strain = MeanStrain { ratio: 9.0, time: 0.7, strain: 0.2 };
        for k in [1e-3, 0.7, 30.0] {
            let term = PronyTerm { ratio: 0.6, time: 0.8 };
            let dt = k * term.time;
            // a straight profile, and one under a held load of 1
            let held_load = |s: f64| (-s / strain.time).exp() / (-strain.time * (-dt / strain.time).exp_m1());
            for (profile, slope) in [
                (StepProfile::straight(dt), Box::new(|_| 1.0 / dt) as Box<dyn Fn(f64) -> f64>),
                (StepProfile::of_load(dt, [1.0; 2], &[strain]).unwrap(), Box::new(held_load)),
            ] {
                for (before, change) in [(0.3, 1.0), (-0.5, 0.1), (0.0, -1.0), (0.7, 0.0)] {
                    let step = MaxwellStep::new(&term, &profile);
                    let [end, lost, work] = integrated(&term, dt, before, |s| change * slope(s));
                    let close = |found: f64, known: f64, size: f64| {
                        assert!((found - known).abs() < 1e-7 * size, "{found} {known} {k}")
                    };
                    close(step.keep * before + step.share() * change, end, before.abs() + change.abs());
                    let products = [before * before, before * change, change * change];
                    close(step.dissipated(products), lost, (before.abs() + change.abs()).powi(2));
                    close(change * step.weighted(before, change), work, (before.abs() + change.abs()).powi(2));
                }
            }
        }
    }

    /// A slow step loses `g rho D^2 / dt`, however small that is.
    #[test]
    fn small_losses_of_slow_steps_keep_their_digits() {
        let term = PronyTerm { ratio: 0.9, time: 1e-7 };
        let step = MaxwellStep::new(&term, &StepProfile::straight(1.0));
        let lost = step.dissipated([(term.ratio * term.time).powi(2), term.ratio * term.time, 1.0]);
        assert!((lost / (term.ratio * term.time) - 1.0).abs() < 1e-10, "{lost:e}");
    }
}
