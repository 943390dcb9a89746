//! How far a pressure can be from the solution.

use crate::contact::{Problem, chunks};
use crate::elastic::HalfSpace;

/// A rigorous bound of the error of a feasible pressure `p >= 0`, with `<p>` as given if it is: a duality gap, or
/// Frank-Wolfe gap, over load and rms height.
///
/// **Under a mean pressure.** With `v = u(p) - h`, every feasible pressure obeys `f(p) - f* <= G`, `G = <p (v - min v)>`: the
/// solution cannot lie deeper than the load times the lowest point of the linearised energy. `G` vanishes only at the
/// solution. It is a mean over nodes here, as `f` is.
///
/// **At a mean gap** `D`, the energy is `F = f + D <p>` and its gradient `v + D`. With `d = -<p v>/<p>`, the mean gap at which
/// `<p g> = 0`, convexity says `F(p) - F* <= <(p - p*) (v + D)>`, and since `<p (v + D)> = <p> (D - d)` and
/// `<p* v> >= <p*> min v`,
///
/// ```text
/// F(p) - F* <= <p*> (-d - min v) + (<p> - <p*>) (D - d) <= max(<p>, <p*>) (|-d - min v| + |D - d|)
/// ```
///
/// where `-d - min v = G / <p>`. So `G / <p> + |D - d|` takes the place of `G / <p>`. Both vanish only at the solution.
///
/// All fields are dimensionless. Where there is no pressure at all, and where a value is negative or not finite, nothing is
/// bounded: the errors are infinite. At the head of the crate the pressure of somebody else is certified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// `eta = G / (<p> h_rms)`, the error in energy against load times rms height: what [`crate::contact::Stop`] asks for. At a
    /// mean gap `eta = (G / <p> + |D - d|) / h_rms`, the same against the larger of `<p>` and `<p*>`.
    pub eta: f64,
    /// `sqrt(2 eta <p> h_rms / <p u(p)>)`: a bound of the relative error of the pressure in the energy norm
    /// `|x|^2 = <x u(x)>`, since `f(p) - f* >= 1/2 |p - p*|^2`. At low loads, where `h_rms` is a coarse yardstick, this one
    /// tells the truth. At a mean gap it takes `<p>` for `<p*>`, whose ratio is 1 but for the error itself.
    /// A pressure that does not deform the solid, such as a uniform one, has no such bound: infinite, unless it is exact.
    pub pressure_error_bound: f64,
    /// How far what is prescribed is missed: `|<p> / mean_pressure - 1|`, or `|D - d| / h_rms` at a mean gap.
    pub load_error: f64,
    /// Smallest pressure over the mean pressure; never negative in a result.
    pub min_pressure: f64,
    /// Largest penetration (negative gap) over `h_rms`. With the datum of the gap where `<p g> = 0`, as under a mean pressure,
    /// the deepest node lies `G / <p>` below zero, so this **is** `eta`. At a mean gap the datum is `D`, and it is `eta` at the
    /// most.
    pub penetration: f64,
}

impl Certificate {
    /// The certificate of no pressure, or of one that is infeasible.
    const NONE: Self = Self {
        eta: f64::INFINITY,
        pressure_error_bound: f64::INFINITY,
        load_error: f64::INFINITY,
        min_pressure: 0.0,
        penetration: f64::INFINITY,
    };

    /// The certificate of `pressure`, row by row: by one transform pair of its own.
    ///
    /// # Panics
    /// If the length of `pressure` does not fit the grid.
    pub fn of(problem: &Problem, pressure: &[f64]) -> Self {
        let mut displacement = vec![0.0; pressure.len()];
        HalfSpace::new(problem.surface().grid(), problem.contact_modulus()).displacement(pressure, &mut displacement);
        Self::of_displaced(problem, pressure, &displacement)
    }

    /// The certificate of `pressure`, whose displacement `u(pressure)` with zero mean is at hand, both row by row.
    pub fn of_displaced(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let sums = Sums::of(problem, pressure, displacement);
        if !(sums.pressure > 0.0 && sums.pressure.is_finite()) {
            return Self::NONE;
        }
        let mean_v = sums.pressure_v / sums.pressure;
        let mean_pressure = sums.pressure / problem.nodes() as f64;
        let min_pressure = sums.lowest_pressure / mean_pressure;
        if min_pressure < 0.0 {
            return Self { min_pressure, ..Self::NONE };
        }
        // how far the mean of `v` weighted by the pressure lies above minus the mean gap that is prescribed
        let above_gap = problem.mean_gap().map_or(0.0, |gap| mean_v + (sums.reference_v + gap));
        let load_error = match problem.mean_pressure() {
            Some(prescribed) => (mean_pressure / prescribed - 1.0).abs(),
            None => above_gap.abs() / problem.rms_height(),
        };
        let excess = excess(mean_v - sums.lowest_v, above_gap);
        let doubled_energy = sums.elastic / sums.pressure;
        let unbounded = if excess > 0.0 { f64::INFINITY } else { 0.0 };
        Self {
            eta: excess / problem.rms_height(),
            pressure_error_bound: if doubled_energy > 0.0 { (2.0 * excess / doubled_energy).sqrt() } else { unbounded },
            load_error,
            min_pressure,
            penetration: (mean_v - sums.lowest_v - above_gap).max(0.0) / problem.rms_height(),
        }
    }
}

/// `eta h_rms`: the depth of the lowest point of the gap below the datum where `<p g> = 0`, and the distance of that datum from
/// the mean gap, if it is prescribed.
pub(super) fn excess(depth: f64, above_gap: f64) -> f64 {
    depth.max(0.0) + above_gap.abs()
}

/// The datum `d` of the gap `g = u - h + d`: the prescribed mean gap, or else minus the mean of `u - h` weighted by the
/// pressure, so that `<p g> = 0`.
pub(super) fn datum(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    if let Some(gap) = problem.mean_gap() {
        return gap;
    }
    let height = problem.height();
    let load = chunks::sum(pressure.len(), |i| pressure[i]);
    -chunks::sum(pressure.len(), |i| pressure[i] / load * (displacement[i] - height[i]))
}

/// Sums of one pass over pressure, displacement and heights. `v` is taken relative to its value at the first node
/// in contact, so that the differences near the solution keep their digits.
#[derive(Clone, Copy)]
struct Sums {
    reference_v: f64,
    pressure: f64,
    pressure_v: f64,
    elastic: f64,
    lowest_v: f64,
    lowest_pressure: f64,
}

impl Sums {
    fn of(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let height = problem.height();
        let reference_v = pressure.iter().position(|&p| p > 0.0).map_or(0.0, |i| displacement[i] - height[i]);
        let none = Self {
            reference_v,
            pressure: 0.0,
            pressure_v: 0.0,
            elastic: 0.0,
            lowest_v: f64::INFINITY,
            lowest_pressure: f64::INFINITY,
        };
        let parts = chunks::visit(pressure.len(), |range| {
            let mut sums = none;
            for i in range {
                let (p, u) = (pressure[i], displacement[i]);
                let v = u - height[i] - reference_v;
                sums.pressure += p;
                sums.pressure_v += p * v;
                sums.elastic += p * u;
                sums.lowest_v = sums.lowest_v.min(v);
                sums.lowest_pressure = sums.lowest_pressure.min(p);
            }
            sums
        });
        parts.into_iter().fold(none, Self::plus)
    }

    fn plus(self, other: Self) -> Self {
        Self {
            reference_v: self.reference_v,
            pressure: self.pressure + other.pressure,
            pressure_v: self.pressure_v + other.pressure_v,
            elastic: self.elastic + other.elastic,
            lowest_v: self.lowest_v.min(other.lowest_v),
            lowest_pressure: self.lowest_pressure.min(other.lowest_pressure),
        }
    }
}
