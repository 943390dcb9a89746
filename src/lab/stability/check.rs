//! The independent check: what a pressure is worth, from the pressure and the problem alone.
//!
//! It shares with the solvers the problem (heights, load and grid) and the definition of the half-space, `u_q = 2 p_q / (E* |q|)`.
//! Below a hardness the lowest nodes are filled one after the other, lowest first. Displacement, yardsticks and certificate are computed here by plain sums of their own; [`super::Kernel`] holds the
//! displacement against a sum over images, in which nothing is periodic and nothing a wave.

use super::kernel::displacement;
use crate::contact::Problem;
use std::f64::consts::PI;

/// The worth of a pressure; dimensionless.
pub struct Check {
    /// Certificate, `sum p (v - min v) / (sum p h_rms)` with `v = u - h`; at a mean gap `D`, `|D - d| / h_rms` more.
    pub eta: f64,
    /// The same divided by the remaining gap, `min(D, max h - D)`, instead of `h_rms`; 0 under a mean pressure.
    pub eta_gap: f64,
    /// `sqrt(eta h_rms <p> / <p u>)`: the bound of the relative error of the pressure.
    pub pressure_error: f64,
    /// Deepest point below the gap's zero over `h_rms`.
    pub penetration: f64,
    /// Smallest pressure over the mean.
    pub min_pressure: f64,
    /// Largest pressure over the hardness; 0 where there is none.
    pub over_hardness: f64,
    /// How far the mean pressure is off the prescribed one; 0 where none is.
    pub load_error: f64,
    /// Energy, `(<p u> / 2 - <p h> + D <p>) / (<p> h_rms)`, with no `D` under a mean pressure, less that of the uniform pressure, which is 0
    /// but where the uniform pressure displaces, or at a mean gap or approach of none. So the smallest one is not above 0.
    pub energy: f64,
    /// Rounding that may add to any of these lengths, over `h_rms`: 64 roundings of the largest displacement, of the
    /// largest height, and of the displacement `2 max |p - <p>| / (E* q)` of the longest wave under a rounded pressure. Where a uniform
    /// pressure displaces, the mean of the displacement counts as well, which a transform rounds by 16 for each doubling of its length.
    pub rounding: f64,
    /// The same over what is left of the gap.
    pub gap_rounding: f64,
}

/// The energy of a uniform pressure over that pressure, a length.
fn energy_of_uniform(problem: &Problem, pressure: f64) -> f64 {
    if !problem.compliance().has_uniform() {
        return 0.0;
    }
    let n = problem.nodes();
    0.5 * displaced(problem, &vec![pressure; n]).iter().sum::<f64>() / n as f64
}

/// The displacement, with what the uniform pressure displaces where it counts.
fn displaced(problem: &Problem, pressure: &[f64]) -> Vec<f64> {
    let (grid, solid) = (problem.surface().grid(), problem.solid());
    let uniform = solid.uniform_compliance().filter(|_| problem.compliance().has_uniform()).unwrap_or(0.0);
    let sinking = uniform * pressure.iter().sum::<f64>() / pressure.len() as f64;
    displacement(grid, solid.as_ref(), pressure).into_iter().map(|u| u + sinking).collect()
}

impl Check {
    /// Checks `pressure`, row by row.
    pub fn new(problem: &Problem, pressure: &[f64]) -> Self {
        let (h, n) = (problem.height(), pressure.len() as f64);
        let u = displaced(problem, pressure);
        let v: Vec<f64> = u.iter().zip(h).map(|(u, h)| u - h).collect();
        let lowest = v.iter().copied().fold(f64::INFINITY, f64::min);
        let load: f64 = pressure.iter().sum();
        let weighted = |value: &dyn Fn(usize) -> f64| (0..v.len()).map(|i| pressure[i] / load * value(i)).sum::<f64>();
        let above = weighted(&|i| v[i] - lowest);
        let rms = (h.iter().map(|h| h * h).sum::<f64>() / n).sqrt();
        let swing = pressure.iter().fold(0.0, |most: f64, p| most.max((p - load / n).abs()));
        let longest = swing * problem.surface().grid().longest_wavelength() / (PI * problem.contact_modulus());
        let load_error = problem.mean_pressure().map_or(0.0, |mean| (load / n / mean - 1.0).abs());
        let gap = problem.datum();
        let missed = gap.map_or(0.0, |gap| (gap + lowest + above).abs());
        let penetration = gap.map_or(above, |gap| -(lowest + gap));
        let most = largest(pressure);
        let over_hardness = problem.law().hardness().map_or(0.0, |hardness| most / hardness);
        // nodes that yield lie below zero, and others by more than the error in energy
        let [excess, penetration] = match problem.law().hardness().filter(|hardness| most >= hardness * (1.0 - 1e-14)) {
            Some(hardness) => [below_hardness(&v, pressure, hardness, gap).min(above + missed), 0.0],
            None => [above + missed, penetration],
        };
        let highest = h.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let over_gap = |length: f64| {
            gap.map_or(0.0, |gap| {
                length / if problem.mean_gap().is_some() { gap.min(highest - gap) } else { highest - gap }
            })
        };
        let uniform = gap.map_or_else(|| energy_of_uniform(problem, load / n), |_| 0.0);
        let sinking =
            if problem.compliance().has_uniform() { 16.0 * n.log2() * f64::EPSILON * largest(&u) } else { 0.0 };
        let rounding = sinking + 64.0 * f64::EPSILON * (largest(&u) + largest(h) + longest);
        Self {
            eta: excess / rms,
            eta_gap: over_gap(excess),
            pressure_error: (excess / weighted(&|i| u[i]).max(0.0)).sqrt(),
            penetration: penetration / rms,
            min_pressure: pressure.iter().copied().fold(f64::INFINITY, f64::min) / (load / n),
            over_hardness,
            load_error,
            energy: (weighted(&|i| 0.5 * u[i] - h[i] + gap.unwrap_or(0.0)) - uniform) / rms,
            rounding: rounding / rms,
            gap_rounding: over_gap(rounding),
        }
    }

    /// The fault that no returned pressure may have, whether it has converged or not.
    pub fn fault(&self) -> Option<String> {
        let values = [self.eta, self.eta_gap, self.penetration, self.min_pressure, self.load_error, self.energy];
        if values.iter().any(|value| !value.is_finite()) {
            return Some("the pressure or its displacement is not finite".into());
        }
        if self.min_pressure < 0.0 {
            return Some(format!("tension of {:.1e} times the mean pressure", -self.min_pressure));
        }
        if self.over_hardness > 1.0 + 1e-14 {
            return Some(format!("a pressure of {} times the hardness", self.over_hardness));
        }
        (self.load_error > 1e-12).then(|| format!("the relative error of the load is {:.1e}", self.load_error))
    }

    /// The reason why a pressure that is said to have the certificate `tolerance`, and the `pressure_tolerance` if there is one, does
    /// not have it.
    pub fn doubt(&self, tolerance: f64, pressure_tolerance: Option<f64>) -> Option<String> {
        let lengths = [("eta", self.eta), ("the penetration", self.penetration), ("the energy", self.energy)]
            .map(|(name, value)| (name, value, tolerance, self.rounding));
        let gap = ("eta divided by the remaining gap", self.eta_gap, tolerance.sqrt(), self.gap_rounding);
        let pressure =
            pressure_tolerance.map(|tolerance| ("the error of the pressure", self.pressure_error, tolerance, 0.0));
        let worst = lengths.into_iter().chain([gap]).chain(pressure);
        let mut doubts = worst.filter(|&(_, value, limit, rounding)| value.is_nan() || value > 2.0 * limit + rounding);
        doubts.next().map(|(name, value, limit, _)| format!("{name} is {value:.1e}, not {limit:.0e}"))
    }
}

/// The mean of `v` weighted by a pressure less that weighted by the best one below a hardness: of all that carry the same load, or
/// at a mean gap of all. A length.
fn below_hardness(v: &[f64], pressure: &[f64], hardness: f64, gap: Option<f64>) -> f64 {
    let load: f64 = pressure.iter().sum();
    let mut order: Vec<usize> = (0..v.len()).collect();
    order.sort_by(|&i, &j| v[i].total_cmp(&v[j]));
    let zero = gap.map_or_else(|| v[order[((load / hardness) as usize).min(v.len() - 1)]], |gap| -gap);
    let mut left = load;
    let best = order.iter().map(|&i| {
        let p = if gap.is_some() { if v[i] < zero { hardness } else { 0.0 } } else { left.min(hardness) };
        left -= p;
        (pressure[i] - p) * (v[i] - zero)
    });
    best.sum::<f64>() / load
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}
