//! The power spectrum of self-affine roughness.

use super::check_positive;
use crate::error::SurfaceError;
use crate::grid::Grid;
use crate::quantity;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Relative slack within which a wavelength counts as equal to a limit.
const SLACK: f64 = 1e-12;

/// The power spectrum of self-affine roughness with a roll-off and a short cut-off (Eq. 10).
///
/// With `q_r = 2 pi / rolloff_wavelength` and `q_sH = 2 pi / short_cutoff`,
///
/// ```text
/// C(q) / C(q_r) = 1                    for 0 < q < q_r
///                 (q/q_r)^-(1+2H)      for q_r <= q < q_sH, lines
///                 (q/q_r)^-2(1+H)      for q_r <= q < q_sH, surfaces
///                 0                    otherwise
/// ```
///
/// Source: Eq. 10 of the paper; Section 4 for the exponent of surfaces.
///
/// ```
/// use asperity::surface::Spectrum;
/// let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 1.0, short_cutoff: 0.1, rms_gradient: 0.01 };
/// let rolloff = std::f64::consts::TAU;
/// assert_eq!(spectrum.density(0.5 * rolloff, true), 1.0);
/// assert_eq!(spectrum.density(2.0 * rolloff, true), 0.25);
/// assert_eq!(spectrum.density(2.0 * rolloff, false), 0.125);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Spectrum {
    /// Hurst exponent `H`, above 0 and at most 1; the fractal dimension is `2 - H` or `3 - H`.
    pub hurst: f64,
    /// Roll-off wavelength `lambda_r`, above which the spectrum is flat; a length.
    #[serde(deserialize_with = "quantity::length")]
    pub rolloff_wavelength: f64,
    /// Short cut-off wavelength `lambda_sH`, at and below which there is no roughness; a length.
    #[serde(deserialize_with = "quantity::length")]
    pub short_cutoff: f64,
    /// Root-mean-square gradient `gbar` (Eq. 8) that each realisation is scaled to, which sets `C(q_r)`.
    pub rms_gradient: f64,
}

impl Spectrum {
    /// `C(q) / C(q_r)` at the wavenumber `q` (1/length), of a line or else a surface.
    ///
    /// A wavelength that equals the short cut-off except for rounding (1e-11) is cut off.
    pub fn density(&self, q: f64, is_line: bool) -> f64 {
        if !(q > 0.0 && q < self.largest_wavenumber()) {
            return 0.0;
        }
        let ratio = q * self.rolloff_wavelength / TAU;
        let exponent = if is_line { 1.0 + 2.0 * self.hurst } else { 2.0 * (1.0 + self.hurst) };
        ratio.max(1.0).powf(-exponent)
    }

    /// The end of the band: `2 pi / short_cutoff`, less a hair so that rounding admits no mode at the limit itself.
    pub(super) fn largest_wavenumber(&self) -> f64 {
        TAU / self.short_cutoff * (1.0 - 10.0 * SLACK)
    }

    /// Checks that the spectrum makes sense and that `grid` can carry it.
    ///
    /// # Errors
    /// - [`SurfaceError::NotPositive`] for a wavelength or gradient that is not positive and finite;
    /// - [`SurfaceError::Hurst`] for an exponent outside `(0, 1]`;
    /// - [`SurfaceError::CutoffOrder`] unless the short cut-off is shorter than the roll-off;
    /// - [`SurfaceError::RolloffTooLong`] for a roll-off longer than the longest period;
    /// - [`SurfaceError::CutoffTooFine`] for a short cut-off below two spacings;
    /// - [`SurfaceError::EmptySpectrum`] if no wave of the cell lies in the band.
    pub fn validate(&self, grid: &Grid) -> Result<(), SurfaceError> {
        self.check_values()?;
        let Self { rolloff_wavelength: rolloff, short_cutoff, .. } = *self;
        let (period, shortest) = (grid.longest_wavelength(), grid.shortest_wavelength());
        if rolloff > period * (1.0 + SLACK) {
            return Err(SurfaceError::RolloffTooLong { rolloff, period });
        }
        if short_cutoff < shortest * (1.0 - SLACK) {
            return Err(SurfaceError::CutoffTooFine { short_cutoff, shortest });
        }
        if self.density(TAU / period, grid.is_line()) == 0.0 {
            return Err(SurfaceError::EmptySpectrum { period, short_cutoff });
        }
        Ok(())
    }

    fn check_values(&self) -> Result<(), SurfaceError> {
        let Self { hurst, rolloff_wavelength: rolloff, short_cutoff, rms_gradient } = *self;
        check_positive(&[
            ("rolloff_wavelength", rolloff),
            ("short_cutoff", short_cutoff),
            ("rms_gradient", rms_gradient),
        ])?;
        if !(hurst > 0.0 && hurst <= 1.0) {
            return Err(SurfaceError::Hurst { value: hurst });
        }
        if short_cutoff >= rolloff {
            return Err(SurfaceError::CutoffOrder { rolloff, short_cutoff });
        }
        Ok(())
    }
}
