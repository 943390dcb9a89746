//! The problem that all solvers solve.

use crate::contact::chunks;
use crate::error::ProblemError;
use crate::surface::Surface;
use std::sync::OnceLock;

/// A rigid surface pressed on an elastic half-space by a given mean pressure, frictionless and without adhesion.
///
/// Find `p >= 0` with `<p> = mean_pressure` and a datum `d` such that the gap `g = u(p) - h + d >= 0` and `p g = 0`: the
/// minimiser of `f(p) = 1/2 <p, u(p)> - <p, h>`, with `u(p)` from [`crate::elastic::HalfSpace`].
///
/// | quantity          | symbol  | unit     |
/// |-------------------|---------|----------|
/// | heights           | `h`     | length   |
/// | `contact_modulus` | `E*`    | pressure |
/// | `mean_pressure`   | `<p>`   | pressure |
///
/// Any consistent set of units will do; tolerances are dimensionless.
#[derive(Debug, Clone)]
pub struct Problem {
    surface: Surface,
    contact_modulus: f64,
    mean_pressure: f64,
    rms_height: f64,
    rms_gradient: OnceLock<f64>,
}

impl Problem {
    /// Poses the problem.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] for a modulus or pressure that is not positive and finite, [`ProblemError::Flat`] if all
    /// heights are equal, [`ProblemError::OutOfRange`] for magnitudes whose squares leave the range of doubles.
    pub fn new(surface: Surface, contact_modulus: f64, mean_pressure: f64) -> Result<Self, ProblemError> {
        check_magnitude("contact modulus", contact_modulus)?;
        check_magnitude("mean pressure", mean_pressure)?;
        let height = surface.heights();
        if height.iter().all(|&h| h == height[0]) {
            return Err(ProblemError::Flat { height: height[0] + surface.mean_height() });
        }
        let rms_height = (chunks::sum(height.len(), |i| height[i].powi(2)) / height.len() as f64).sqrt();
        check_magnitude("rms height", rms_height)?;
        check_magnitude("length of the cell", surface.grid().longest_wavelength())?;
        Ok(Self { surface, contact_modulus, mean_pressure, rms_height, rms_gradient: OnceLock::new() })
    }

    /// Poses the problem at the reduced pressure `p* = <p> / (gbar E*)`, with `gbar` of this surface.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn at_reduced_pressure(
        surface: Surface,
        contact_modulus: f64,
        reduced_pressure: f64,
    ) -> Result<Self, ProblemError> {
        check_magnitude("reduced pressure", reduced_pressure)?;
        let unloaded = Self::new(surface, contact_modulus, contact_modulus)?;
        let mean_pressure = reduced_pressure * unloaded.rms_gradient() * contact_modulus;
        unloaded.with_mean_pressure(mean_pressure)
    }

    /// The same surface and solid at another load.
    ///
    /// # Errors
    /// [`ProblemError::NotPositive`] or [`ProblemError::OutOfRange`] for a pressure that cannot be.
    pub fn with_mean_pressure(self, mean_pressure: f64) -> Result<Self, ProblemError> {
        check_magnitude("mean pressure", mean_pressure)?;
        Ok(Self { mean_pressure, ..self })
    }

    /// The rigid surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Contact modulus `E*`.
    pub fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    /// The mean pressure `<p>` to be carried.
    pub fn mean_pressure(&self) -> f64 {
        self.mean_pressure
    }

    /// Heights about their mean, row by row: those of the surface.
    pub fn height(&self) -> &[f64] {
        self.surface.heights()
    }

    /// Root mean square of the heights about their mean.
    pub fn rms_height(&self) -> f64 {
        self.rms_height
    }

    /// Root-mean-square gradient `gbar` of the whole surface; computed when first asked for.
    pub fn rms_gradient(&self) -> f64 {
        *self.rms_gradient.get_or_init(|| self.surface.rms_gradient())
    }

    /// Number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.surface.grid().len()
    }
}

fn check_magnitude(name: &'static str, value: f64) -> Result<(), ProblemError> {
    if !(value.is_finite() && value > 0.0) {
        return Err(ProblemError::NotPositive { name, value });
    }
    if (1e-100..=1e100).contains(&value) { Ok(()) } else { Err(ProblemError::OutOfRange { name, value }) }
}
