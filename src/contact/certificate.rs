//! How far a pressure can be from the solution.

use crate::contact::Problem;
use crate::contact::chunks;

/// A rigorous measure of the error of a feasible pressure `p` (`p >= 0`, `<p>` as given).
///
/// With `v = u(p) - h`, every feasible pressure obeys `f(p) - f* <= G`, `G = <p (v - min v)>`: the solution cannot lie deeper
/// than the load times the lowest point of the linearised energy. `G` vanishes only at the solution. It is a mean over
/// nodes here, as `f` is.
///
/// All fields are dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// `eta = G / (<p> h_rms)`, the error in energy against load times rms height: what [`crate::contact::Stop`] asks for.
    pub eta: f64,
    /// `sqrt(2 G / <p u(p)>)`: a bound of the relative error of the pressure in the energy norm `|x|^2 = <x u(x)>`, since
    /// `f(p) - f* >= 1/2 |p - p*|^2`. At low loads, where `h_rms` is a coarse yardstick, this one tells the truth.
    pub pressure_error_bound: f64,
    /// `|<p> / mean_pressure - 1|`.
    pub load_error: f64,
    /// Smallest pressure over the mean pressure; never negative in a result.
    pub min_pressure: f64,
}

impl Certificate {
    /// Largest penetration (negative gap) over `h_rms`. With the datum of the gap where `<p g> = 0`, as in every result, the
    /// deepest node lies `G / <p>` below zero: the penetration **is** `eta`.
    pub fn penetration(&self) -> f64 {
        self.eta
    }

    /// The certificate of `pressure`, whose displacement `u(pressure)` with zero mean is given, both row by row.
    pub(super) fn of(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let sums = Sums::of(problem, pressure, displacement);
        let mean_v = sums.pressure_v / sums.pressure;
        let excess = (mean_v - sums.lowest_v).max(0.0);
        let doubled_energy = sums.elastic / sums.pressure;
        Self {
            eta: excess / problem.rms_height(),
            pressure_error_bound: if doubled_energy > 0.0 { (2.0 * excess / doubled_energy).sqrt() } else { 0.0 },
            load_error: (sums.pressure / (problem.nodes() as f64 * problem.mean_pressure()) - 1.0).abs(),
            min_pressure: sums.lowest_pressure / problem.mean_pressure(),
        }
    }
}

/// The datum `d` of the gap `g = u - h + d`: minus the mean of `u - h` weighted by the pressure, so that `<p g> = 0`.
pub(super) fn datum(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> f64 {
    let height = problem.height();
    let load = chunks::sum(pressure.len(), |i| pressure[i]);
    -chunks::sum(pressure.len(), |i| pressure[i] / load * (displacement[i] - height[i]))
}

/// What one pass over pressure, displacement and heights collects. `v` is taken relative to its value at the first node
/// in contact, so that the differences near the solution keep their digits.
#[derive(Clone, Copy)]
struct Sums {
    pressure: f64,
    pressure_v: f64,
    elastic: f64,
    lowest_v: f64,
    lowest_pressure: f64,
}

impl Sums {
    fn of(problem: &Problem, pressure: &[f64], displacement: &[f64]) -> Self {
        let height = problem.height();
        let reference = pressure.iter().position(|&p| p > 0.0).map_or(0.0, |i| displacement[i] - height[i]);
        let none = Self {
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
                let v = u - height[i] - reference;
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
            pressure: self.pressure + other.pressure,
            pressure_v: self.pressure_v + other.pressure_v,
            elastic: self.elastic + other.elastic,
            lowest_v: self.lowest_v.min(other.lowest_v),
            lowest_pressure: self.lowest_pressure.min(other.lowest_pressure),
        }
    }
}
