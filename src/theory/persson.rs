//! Relative area against reduced pressure, `p* = p/(gbar E*)`: Persson's theory, its corrected form for lines, and the
//! slope of Bush, Gibson and Thomas.

use libm::erf;
use std::f64::consts::SQRT_2;

/// Slope `kappa = a_rel/p*` of Persson's theory at small pressure, `sqrt(8/pi)`.
pub const KAPPA: f64 = 1.595_769_121_605_730_8;

/// Slope `kappa` of the theory of Bush, Gibson and Thomas at small pressure, `sqrt(2 pi)` (Wear 35, 87, 1975).
pub const KAPPA_BGT: f64 = 2.506_628_274_631_000_2;

/// Relative contact area of Persson's theory, `erf(sqrt2 p*)`.
///
/// Source: B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001).
///
/// ```
/// use asperity::theory::persson;
/// assert!((persson::relative_area(1e-4) / 1e-4 - persson::KAPPA).abs() < 1e-7);
/// ```
pub fn relative_area(reduced_pressure: f64) -> f64 {
    erf(SQRT_2 * reduced_pressure)
}

/// The corrected form for lines (Eq. 11), `a_rel = erf(sqrt2 p*/Psi)` with `Psi = b1 + (1-b1) erf(b2 p*)`.
///
/// Source: Eq. 11 of the paper, after M. Scaraggi et al., Wear 297, 811 (2013).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrectedArea {
    /// `b1`, the correction at small pressure: `kappa = sqrt(8/pi)/b1`. With 1 the form is Persson's.
    pub b1: f64,
    /// `b2`, the inverse of the reduced pressure over which the correction fades.
    pub b2: f64,
}

impl CorrectedArea {
    /// `Psi(p*)`.
    pub fn correction(&self, reduced_pressure: f64) -> f64 {
        self.b1 + (1.0 - self.b1) * erf(self.b2 * reduced_pressure)
    }

    /// Relative contact area.
    pub fn relative_area(&self, reduced_pressure: f64) -> f64 {
        relative_area(reduced_pressure / self.correction(reduced_pressure))
    }

    /// `kappa = a_rel/p*`; at no pressure its limit.
    pub fn kappa(&self, reduced_pressure: f64) -> f64 {
        if reduced_pressure == 0.0 {
            return KAPPA / self.b1;
        }
        self.relative_area(reduced_pressure) / reduced_pressure
    }
}
