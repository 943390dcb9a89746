//! The independent check: what a pressure is worth, from the pressure and the problem alone.
//!
//! Plain loops that share nothing with the solvers and their certificate. Small grids are displaced by the direct sum,
//! larger ones by a transform of their own.

use crate::contact::Problem;
use crate::elastic::direct;
use crate::fourier::{Complex, Fourier};
use std::f64::consts::PI;

/// Grids of up to so many nodes are summed directly.
const DIRECT: usize = 4096;

/// The worth of a pressure; dimensionless.
pub struct Check {
    /// Certificate, `sum p (v - min v) / (sum p h_rms)` with `v = u - h`; at a mean gap `D`, `|D - d| / h_rms` more.
    pub eta: f64,
    /// Deepest point below the gap's zero over `h_rms`.
    pub penetration: f64,
    /// Smallest pressure over the mean.
    pub min_pressure: f64,
    /// How far the mean pressure is off the prescribed one; 0 where none is.
    pub load_error: f64,
    /// Energy, `(<p u> / 2 - <p h> + D <p>) / (<p> h_rms)`, with no `D` under a mean pressure. It is 0 for the uniform
    /// pressure, or at a mean gap for none, so the smallest one is not above 0.
    pub energy: f64,
    /// Rounding that may add to any of these lengths, over `h_rms`: 64 roundings of the largest displacement, of the
    /// largest height, and of the displacement `2 max |p - <p>| / (E* q)` of the longest wave under a rounded pressure.
    pub rounding: f64,
}

impl Check {
    /// Checks `pressure`, row by row.
    pub fn of(problem: &Problem, pressure: &[f64]) -> Self {
        let (h, n) = (problem.height(), pressure.len() as f64);
        let u = displacement(problem, pressure);
        let v: Vec<f64> = u.iter().zip(h).map(|(u, h)| u - h).collect();
        let lowest = v.iter().copied().fold(f64::INFINITY, f64::min);
        let load: f64 = pressure.iter().sum();
        let weighted = |value: &dyn Fn(usize) -> f64| (0..v.len()).map(|i| pressure[i] / load * value(i)).sum::<f64>();
        let above = weighted(&|i| v[i] - lowest);
        let rms = problem.rms_height();
        let swing = pressure.iter().fold(0.0, |most: f64, p| most.max((p - load / n).abs()));
        let longest = swing * problem.surface().grid().longest_wavelength() / (PI * problem.contact_modulus());
        let load_error = problem.mean_pressure().map_or(0.0, |mean| (load / n / mean - 1.0).abs());
        let gap = problem.mean_gap();
        let missed = gap.map_or(0.0, |gap| (gap + lowest + above).abs());
        let penetration = gap.map_or(above, |gap| -(lowest + gap));
        Self {
            eta: (above + missed) / rms,
            penetration: penetration / rms,
            min_pressure: pressure.iter().copied().fold(f64::INFINITY, f64::min) / (load / n),
            load_error,
            energy: weighted(&|i| 0.5 * u[i] - h[i] + gap.unwrap_or(0.0)) / rms,
            rounding: 64.0 * f64::EPSILON * (largest(&u) + largest(h) + longest) / rms,
        }
    }

    /// The fault that no returned pressure may have, whether it has converged or not.
    pub fn fault(&self) -> Option<String> {
        let values = [self.eta, self.penetration, self.min_pressure, self.load_error, self.energy];
        if values.iter().any(|value| !value.is_finite()) {
            return Some("the pressure or its displacement is not finite".into());
        }
        if self.min_pressure < 0.0 {
            return Some(format!("a tension of {:.1e} of the mean pressure", -self.min_pressure));
        }
        (self.load_error > 1e-12).then(|| format!("the load is missed by {:.1e}", self.load_error))
    }

    /// The reason why a pressure that is said to have the certificate `tolerance` does not have it.
    pub fn doubt(&self, tolerance: f64) -> Option<String> {
        let limit = 2.0 * tolerance + self.rounding;
        [("eta", self.eta), ("the penetration", self.penetration), ("the energy", self.energy)]
            .into_iter()
            .find(|&(_, value)| value.is_nan() || value > limit)
            .map(|(name, value)| format!("{name} is {value:.1e}, not {tolerance:.0e}"))
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

/// The displacement under `pressure`, of which the mean is taken off first: it displaces nothing, but would be rounded.
fn displacement(problem: &Problem, pressure: &[f64]) -> Vec<f64> {
    let (grid, modulus) = (problem.surface().grid(), problem.contact_modulus());
    let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
    let pressure: Vec<f64> = pressure.iter().map(|p| p - mean).collect();
    if grid.len() <= DIRECT {
        return direct::displacement(grid, modulus, &pressure);
    }
    let mut fourier = Fourier::new(grid);
    let mut modes = vec![Complex::default(); grid.modes()];
    let mut displacement = vec![0.0; grid.len()];
    fourier.forward(&pressure, &mut modes);
    for (mode, q) in modes.iter_mut().zip(grid.wavenumbers()) {
        *mode *= if q > 0.0 { 2.0 / (modulus * q) } else { 0.0 };
    }
    fourier.inverse(&mut modes, &mut displacement);
    displacement
}
