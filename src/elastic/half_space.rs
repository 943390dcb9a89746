//! The half-space in Fourier space.

use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use rayon::prelude::*;

/// Coefficients per task: below it a second core costs more than it gives.
const TASK: usize = 1 << 15;

/// A flat, frictionless, linearly elastic half-space, periodic over a grid.
///
/// Compliance and stiffness are diagonal in Fourier space, in one and in two dimensions alike:
///
/// `u_q = 2 p_q / (E* |q|)` and `p_q = E* |q| u_q / 2` for `q != 0`,
///
/// with the pressure `p >= 0` in compression, the displacement `u` of the surface positive into the solid, and the contact
/// modulus `E* = E / (1 - nu^2)`. The mean of `u` is a free datum and is returned as zero; a uniform pressure displaces
/// nothing.
///
/// Memory: one half spectrum and half a field, besides those of [`Fourier`].
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 13.2; Stanley & Kato, J. Tribol. 119, 481 (1997).
///
/// ```
/// use asperity::{Grid, elastic::HalfSpace};
/// use std::f64::consts::TAU;
/// let grid = Grid::line(16, TAU)?; // wavenumbers 0, 1, 2, ...
/// let pressure: Vec<f64> = grid.x().map(|x| 1.0 + (3.0 * x).cos()).collect();
/// let mut displacement = vec![0.0; grid.len()];
/// HalfSpace::new(&grid, 4.0).displacement(&pressure, &mut displacement);
/// assert!((displacement[0] - 2.0 / (4.0 * 3.0)).abs() < 1e-15);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
pub struct HalfSpace {
    fourier: Fourier,
    stiffness: Vec<f64>,
    spectrum: Vec<Complex>,
}

impl HalfSpace {
    /// Plans the response of a solid of contact modulus `E*` over `grid`.
    pub fn new(grid: &Grid, contact_modulus: f64) -> Self {
        Self {
            fourier: Fourier::new(grid),
            stiffness: grid.wavenumbers().map(|q| 0.5 * contact_modulus * q).collect(),
            spectrum: vec![Complex::default(); grid.modes()],
        }
    }

    /// Stiffness `E* |q| / 2` of each mode, in the order of [`Grid::wavenumbers`]; zero for the mean.
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Transforms made so far, see [`Fourier::transforms`].
    pub fn transforms(&self) -> u64 {
        self.fourier.transforms()
    }

    /// Writes the displacement under `pressure`, with zero mean: one transform pair.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.respond(pressure, displacement, |k| if k > 0.0 { 1.0 / k } else { 0.0 });
    }

    /// Writes the pressure that makes `displacement`, with zero mean: one transform pair.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn pressure(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.respond(displacement, pressure, |k| k);
    }

    /// [`HalfSpace::displacement`] in place.
    pub(crate) fn comply(&mut self, field: &mut [f64]) {
        self.respond_in_place(field, |k| if k > 0.0 { 1.0 / k } else { 0.0 });
    }

    /// [`HalfSpace::pressure`] in place.
    pub(crate) fn stiffen(&mut self, field: &mut [f64]) {
        self.respond_in_place(field, |k| k);
    }

    fn respond_in_place(&mut self, field: &mut [f64], factor: impl Fn(f64) -> f64 + Sync) {
        self.fourier.forward(field, &mut self.spectrum);
        self.scale_modes(factor);
        self.fourier.inverse(&mut self.spectrum, field);
    }

    /// Multiplies each mode of `cause` by `factor(stiffness)`.
    pub(crate) fn respond(&mut self, cause: &[f64], effect: &mut [f64], factor: impl Fn(f64) -> f64 + Sync) {
        self.fourier.forward(cause, &mut self.spectrum);
        self.scale_modes(factor);
        self.fourier.inverse(&mut self.spectrum, effect);
    }

    fn scale_modes(&mut self, factor: impl Fn(f64) -> f64 + Sync) {
        let scale = |(modes, stiffness): (&mut [Complex], &[f64])| {
            for (mode, &k) in modes.iter_mut().zip(stiffness) {
                *mode *= factor(k);
            }
        };
        if self.spectrum.len() <= TASK {
            scale((&mut self.spectrum, &self.stiffness));
        } else {
            self.spectrum.par_chunks_mut(TASK).zip(self.stiffness.par_chunks(TASK)).for_each(scale);
        }
    }
}
