//! Self-affine spectra.

use crate::error::SurfaceError;
use crate::grid::Grid;
use crate::surface::check_positive;
use std::f64::consts::TAU;

/// Relative slack within which a wavelength counts as equal to a limit.
const SLACK: f64 = 1e-12;

/// What a self-affine spectrum does at waves that are longer than its roll-off wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rolloff {
    /// It is constant above this wavelength, a length.
    Plateau(f64),
    /// It is zero above this wavelength, a length.
    Drop(f64),
    /// There is no roll-off: the power law holds up to the longest wave of the cell.
    None,
}

/// The power spectrum of self-affine roughness up to a factor: a power law with a short cut-off, and with or without a roll-off.
///
/// With `q_r = 2 pi / rolloff wavelength` and `q_s = 2 pi / short_cutoff`,
///
/// ```text
/// C(q) / C(q_r) = (q/q_r)^-(1+2H)      for q_r <= q < q_s, lines
///                 (q/q_r)^-2(1+H)      for q_r <= q < q_s, surfaces
///                 0                    for q >= q_s
///                 as Rolloff says      for q < q_r
/// ```
///
/// Source: Eq. 10 of the paper, which has a plateau; Jacobs, Junge & Pastewka, Surf. Topogr. 5:013001, 2017 for spectra without one.
///
/// ```
/// use asperity::surface::{Rolloff, SelfAffine};
/// let spectrum = |rolloff| SelfAffine { hurst: 0.5, rolloff, short_cutoff: 0.1 };
/// let q = 0.5 * std::f64::consts::TAU;
/// assert_eq!(spectrum(Rolloff::Plateau(1.0)).density(q, true), 1.0);
/// assert_eq!(spectrum(Rolloff::Drop(1.0)).density(q, true), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Hurst exponent `H`, above 0 and at most 1; the fractal dimension is `2 - H` or `3 - H`.
    pub hurst: f64,
    /// What there is above the roll-off wavelength.
    pub rolloff: Rolloff,
    /// Short cut-off wavelength, at and below which there is no roughness; a length.
    pub short_cutoff: f64,
}

impl SelfAffine {
    /// The roll-off wavelength, if there is one.
    pub fn rolloff_wavelength(&self) -> Option<f64> {
        match self.rolloff {
            Rolloff::Plateau(wavelength) | Rolloff::Drop(wavelength) => Some(wavelength),
            Rolloff::None => None,
        }
    }

    /// The wavelength at which the density is 1: that of the roll-off, or else the short cut-off.
    pub(super) fn reference(&self) -> f64 {
        self.rolloff_wavelength().unwrap_or(self.short_cutoff)
    }

    /// `C(q) / C(q_r)` at the wavenumber `q` (1/length), of a line or else a surface; without a roll-off over that at the short cut-off.
    ///
    /// A wavelength that equals the short cut-off except for rounding (1e-11) is cut off.
    pub fn density(&self, q: f64, is_line: bool) -> f64 {
        if !(q > 0.0 && q < self.largest_wavenumber()) {
            return 0.0;
        }
        let ratio = q * self.reference() / TAU;
        let exponent = if is_line { 1.0 + 2.0 * self.hurst } else { 2.0 * (1.0 + self.hurst) };
        match self.rolloff {
            Rolloff::Plateau(_) => ratio.max(1.0).powf(-exponent),
            Rolloff::Drop(_) if ratio < 1.0 - SLACK => 0.0,
            Rolloff::Drop(_) | Rolloff::None => ratio.powf(-exponent),
        }
    }

    /// The end of the band: `2 pi / short_cutoff`, less a hair so that rounding admits no mode at the limit itself.
    pub(super) fn largest_wavenumber(&self) -> f64 {
        TAU / self.short_cutoff * (1.0 - 10.0 * SLACK)
    }

    /// Checks the values, and that the longest wavelength of `grid` is not shorter than the roll-off.
    pub(super) fn check(&self, grid: &Grid) -> Result<(), SurfaceError> {
        let Self { hurst, short_cutoff, .. } = *self;
        let rolloff = self.rolloff_wavelength();
        rolloff.map_or(Ok(()), |value| check_positive(&[("rolloff_wavelength", value)]))?;
        check_positive(&[("short_cutoff", short_cutoff)])?;
        if !(hurst > 0.0 && hurst <= 1.0) {
            return Err(SurfaceError::Hurst { value: hurst });
        }
        let period = grid.longest_wavelength();
        match rolloff {
            Some(rolloff) if short_cutoff >= rolloff => Err(SurfaceError::CutoffOrder { rolloff, short_cutoff }),
            Some(rolloff) if rolloff > period * (1.0 + SLACK) => Err(SurfaceError::RolloffTooLong { rolloff, period }),
            _ => Ok(()),
        }
    }
}
