//! One step in time of the elements of a generalised Kelvin solid.
//!
//! Letters of this file: `k = dt / tau`, `e = exp(-k)`, `p0` and `p1` the pressures at the beginning and the end, `|x|^2 = <x A x>`.

use crate::elastic::PronyTerm;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// Below this value of `k` sums of exponentials are computed as series.
const SHORT: f64 = 0.05;
/// Terms of these series; the next one is below rounding.
const SERIES: i32 = 14;

/// How the pressure varies within a step in time, see [`super::Creep::with_rule`].
///
/// ```
/// assert_eq!(asperity::history::CreepRule::default(), asperity::history::CreepRule::ConstantPressure);
/// ```
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, EnumString, IntoStaticStr,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum CreepRule {
    /// The pressure at the end of a step is taken for the whole step.
    ///
    /// First order in the step. Under a load that never falls, only the load in
    /// steps causes an error of the pressure, for steps of any length.
    #[default]
    ConstantPressure,
    /// The pressure varies linearly from the beginning to the end of a step.
    ///
    /// Second order in steps that are short compared with the shortest time
    /// of the solid. The first step after a jump of the load takes the pressure as constant, since a long linear one would need
    /// tension where the contact grows.
    LinearPressure,
}

/// How a term goes over a step: `eps <- keep eps + before p0 + after p1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct KelvinStep {
    ratio: f64,
    k: f64,
    is_linear: bool,
    pub keep: f64,
    pub before: f64,
    pub after: f64,
}

/// The products of the memory of a term with itself and with both pressures.
#[derive(Debug, Clone, Copy)]
pub(super) struct KelvinProducts {
    /// `|eps|^2`.
    pub square: f64,
    /// `<eps A p0>` and `<eps A p1>`.
    pub with: [f64; 2],
}

/// The products of both pressures: `|p0|^2`, `<p0 A p1>` and `|p1|^2`.
pub(super) type PressureProducts = [f64; 3];

impl KelvinStep {
    pub fn new(term: &PronyTerm, step: f64, rule: CreepRule) -> Self {
        let (ratio, k) = (term.ratio, step / term.time);
        let (keep, gone) = ((-k).exp(), -(-k).exp_m1());
        let is_linear = rule == CreepRule::LinearPressure;
        let [before, after] = match is_linear {
            // 1 - gone / k and gone - that
            true if k < SHORT => {
                let after = power_series(k, 1, |n, factorial| -sign(n) / (factorial * f64::from(n + 1)));
                [gone - after, after]
            }
            true => [gone - (1.0 - gone / k), 1.0 - gone / k],
            false => [0.0, gone],
        };
        Self { ratio, k, is_linear, keep, before: ratio * before, after: ratio * after }
    }

    /// The products of the memory at the end of the step with itself and with `p1`.
    pub fn next(&self, old: KelvinProducts, [p00, p01, p11]: PressureProducts) -> [f64; 2] {
        let Self { keep, before, after, .. } = *self;
        let KelvinProducts { square, with: [with0, with1] } = old;
        let itself = keep * keep * square
            + 2.0 * keep * (before * with0 + after * with1)
            + before * before * p00
            + 2.0 * before * after * p01
            + after * after * p11;
        [itself.max(0.0), keep * with1 + before * p01 + after * p11]
    }

    /// The energy that the dashpot of the term takes up, per area: `tau/f int |d eps/dt|^2 dt`.
    ///
    /// `y = eps - f p` obeys `tau dy/dt = -y - f tau dp/dt`, and `tau d eps/dt = -y`. Under a constant pressure `y` fades as `exp(-t/tau)`, and the
    /// integral is `|y|^2 (1 - e^2) / 2f`. Under a linear one `y = y0 exp(-t/tau) - c (1 - exp(-t/tau))`, `c = f (p1 - p0) / k`.
    pub fn dissipated(&self, old: KelvinProducts, [p00, p01, p11]: PressureProducts) -> f64 {
        let (f, k) = (self.ratio, self.k);
        let KelvinProducts { square, with: [with0, with1] } = old;
        let fading = -0.5 * (-2.0 * k).exp_m1();
        if !self.is_linear {
            return (square - 2.0 * f * with1 + f * f * p11).max(0.0) / f * fading;
        }
        let gone = -(-k).exp_m1();
        let start = (square - 2.0 * f * with0 + f * f * p00).max(0.0);
        let (mixed, change) = (with1 - with0 - f * (p01 - p00), (p11 - 2.0 * p01 + p00).max(0.0));
        let slow = match k < SHORT {
            true => power_series(k, 3, |n, factorial| -sign(n) * (2f64.powi(n - 1) - 2.0) / factorial),
            false => k - 2.0 * gone + fading,
        };
        let per_k = if k > 0.0 { f / k } else { 0.0 };
        (start * fading - per_k * mixed * gone * gone + per_k * per_k * change * slow).max(0.0) / f
    }
}

fn sign(n: i32) -> f64 {
    if n % 2 == 0 { 1.0 } else { -1.0 }
}

/// `sum k^n coefficient(n, n!)` from `n = first` on.
fn power_series(k: f64, first: i32, coefficient: impl Fn(i32, f64) -> f64) -> f64 {
    let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
    (first..first + SERIES).map(|n| coefficient(n, factorial(n)) * k.powi(n)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A memory and pressures that are numbers, `A = 1`: the equation of the element, by many small steps of fourth order.
    fn integrated(term: &PronyTerm, step: f64, eps: f64, [p0, p1]: [f64; 2]) -> [f64; 2] {
        let count = 20_000;
        let h = step / count as f64;
        let slope = |t: f64, eps: f64| (term.ratio * (p0 + (p1 - p0) * t / step) - eps) / term.time;
        (0..count).fold([eps, 0.0], |[eps, lost], i| {
            let t = i as f64 * h;
            let a = slope(t, eps);
            let b = slope(t + 0.5 * h, eps + 0.5 * h * a);
            let c = slope(t + 0.5 * h, eps + 0.5 * h * b);
            let d = slope(t + h, eps + h * c);
            let power = (a * a + 4.0 * (0.5 * (b + c)).powi(2) + d * d) / 6.0;
            [eps + h * (a + 2.0 * b + 2.0 * c + d) / 6.0, lost + h * term.time / term.ratio * power]
        })
    }

    #[test]
    fn steps_are_those_of_the_differential_equation() {
        for k in [1e-3, 0.049, 0.051, 0.7, 8.0] {
            for (eps, p0, p1) in [(0.3, 1.0, 2.0), (5.0, 2.0, 0.1), (0.0, 0.0, 1.0), (1.0, 0.4, 0.4)] {
                let term = PronyTerm { ratio: 2.5, time: 0.8 };
                let products = KelvinProducts { square: eps * eps, with: [eps * p0, eps * p1] };
                let pressures = [p0 * p0, p0 * p1, p1 * p1];
                for rule in [CreepRule::ConstantPressure, CreepRule::LinearPressure] {
                    let step = KelvinStep::new(&term, k * term.time, rule);
                    let from = if rule == CreepRule::LinearPressure { p0 } else { p1 };
                    let [end, lost] = integrated(&term, k * term.time, eps, [from, p1]);
                    let found = step.keep * eps + step.before * p0 + step.after * p1;
                    assert!((found - end).abs() < 1e-10 * end.abs().max(k), "{found} against {end} at {k}");
                    let [square, with] = step.next(products, pressures);
                    assert!((square - end * end).abs() < 1e-9 * end * end && (with - end * p1).abs() < 1e-9 * with);
                    let found = step.dissipated(products, pressures);
                    assert!((found - lost).abs() < 1e-6 * lost.max(1e-9), "{found} against {lost} at {k} {rule:?}");
                }
            }
        }
    }
}
