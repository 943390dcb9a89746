//! The power-law indenter on a half-space.

use super::quadrature::integral;
use libm::tgamma;
use std::f64::consts::PI;

/// Line or point contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Geometry {
    /// Plane strain: `h = -A |x|^n`, the load is one per unit length.
    Line,
    /// Axial symmetry: `h = -A r^n`.
    Point,
}

/// An isolated frictionless contact with the indenter `h = -A |x|^n` or `-A r^n` (Galin, Sneddon).
///
/// With the contact half-width or radius `a`, and `G` for the gamma function,
///
/// ```text
/// line   P = (E*/2) A n a^n c          c = sqrt(pi) G((n+1)/2) / G(n/2+1)
/// point  P = 2 E* A a^(n+1) c n/(n+1)  c = sqrt(pi) G(n/2+1) / G((n+1)/2),  approach A a^n c
/// ```
///
/// and the pressure is that of flat punches superposed, `int P'(b) p_b(x) db` with
/// `p_b = 1/(pi sqrt(b^2-x^2))` (line) or `1/(2 pi b sqrt(b^2-r^2))` (point).
///
/// Outside [`PowerLaw::EXPONENTS`] the pressure is NaN.
///
/// Source: L. A. Galin, *Contact Problems* (1961); I. N. Sneddon, Int. J. Eng. Sci. 3, 47 (1965); Johnson (1985), 5.3.
///
/// ```
/// use asperity::theory::{Geometry, PowerLaw};
/// let wedge = PowerLaw { geometry: Geometry::Line, coefficient: 0.1, exponent: 1.0, contact_modulus: 3.0 };
/// assert!((wedge.load(2.0) - 3.0 * 0.1 * 2.0).abs() < 1e-15);
/// assert!((wedge.kappa_r() - 2.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Line or point contact.
    pub geometry: Geometry,
    /// Coefficient `A`, a length to the power `1 - n`.
    pub coefficient: f64,
    /// Exponent `n`.
    pub exponent: f64,
    /// Contact modulus `E*`, a pressure.
    pub contact_modulus: f64,
}

impl PowerLaw {
    /// Exponents for which the pressure is known: below 1 the peak is a cusp, above 64 the profile is a punch.
    pub const EXPONENTS: std::ops::RangeInclusive<f64> = 1.0..=64.0;

    /// Load at the contact half-width `a`; pressure times length (line) or area (point).
    pub fn load(&self, a: f64) -> f64 {
        let (n, c) = (self.exponent, self.gamma_ratio());
        match self.geometry {
            Geometry::Line => 0.5 * self.contact_modulus * self.coefficient * n * a.powf(n) * c,
            Geometry::Point => 2.0 * self.contact_modulus * self.coefficient * a.powf(n + 1.0) * c * n / (n + 1.0),
        }
    }

    /// Contact half-width or radius under the load `load`, a length.
    pub fn half_width(&self, load: f64) -> f64 {
        let power = match self.geometry {
            Geometry::Line => self.exponent,
            Geometry::Point => self.exponent + 1.0,
        };
        (load / self.load(1.0)).powf(1.0 / power)
    }

    /// Approach of distant points at the contact radius `a`, a length; a line contact has none (it grows with the
    /// logarithm of the distance).
    pub fn approach(&self, a: f64) -> Option<f64> {
        let approach = self.coefficient * a.powf(self.exponent) * self.gamma_ratio();
        (self.geometry == Geometry::Point).then_some(approach)
    }

    /// Pressure at the distance `x` from the middle of a contact of half-width `a`; infinite in the middle for `n = 1`.
    pub fn pressure(&self, a: f64, x: f64) -> f64 {
        let (n, c, s) = (self.exponent, self.gamma_ratio(), x.abs() / a);
        if s >= 1.0 {
            return 0.0;
        }
        let factor = match self.geometry {
            Geometry::Line => 0.5 * n * n,
            Geometry::Point => n,
        };
        factor * c / PI * self.contact_modulus * self.coefficient * a.powf(n - 1.0) * profile(n, s)
    }

    /// Root-mean-square slope of the indenter over a contact of half-width `a` (Eqs. 6, 19): `n A a^(n-1) / sqrt(2n-1)`
    /// for lines, `sqrt(n) A a^(n-1)` for points.
    pub fn rms_gradient_contact(&self, a: f64) -> f64 {
        let n = self.exponent;
        let factor = match self.geometry {
            Geometry::Line => n / (2.0 * n - 1.0).sqrt(),
            Geometry::Point => n.sqrt(),
        };
        factor * self.coefficient * a.powf(n - 1.0)
    }

    /// `kappa_r = a_rel gbar_r E* / p` (Eq. 3), which no load changes.
    ///
    /// Line `4 G(n/2+1) / (sqrt(2n-1) sqrt(pi) G((n+1)/2))`, point
    /// `sqrt(pi) (n+1) G((n+1)/2) / (2 sqrt(n) G(n/2+1))`.
    pub fn kappa_r(&self) -> f64 {
        let (n, c) = (self.exponent, self.gamma_ratio());
        match self.geometry {
            Geometry::Line => 4.0 / ((2.0 * n - 1.0).sqrt() * c),
            Geometry::Point => PI * (n + 1.0) / (2.0 * n.sqrt() * c),
        }
    }

    /// The constant `c` of the loads.
    fn gamma_ratio(&self) -> f64 {
        let ratio = PI.sqrt() * tgamma(0.5 * self.exponent + 1.0) / tgamma(0.5 * (self.exponent + 1.0));
        match self.geometry {
            Geometry::Line => PI / ratio,
            Geometry::Point => ratio,
        }
    }
}

/// `F_n(s) = int_s^1 b^(n-1) / sqrt(b^2 - s^2) db`, the shape of the pressure, for `0 <= s < 1`.
///
/// Integration by parts, `(n-1) F_n = sqrt(1-s^2) + (n-2) s^2 F_{n-2}`, brings `n` below 3. There `b = s cosh t` leaves
/// the smooth integrand `(s cosh t)^(n-1)`.
fn profile(n: f64, s: f64) -> f64 {
    if !PowerLaw::EXPONENTS.contains(&n) {
        return f64::NAN;
    }
    if s < f64::MIN_POSITIVE {
        return 1.0 / (n - 1.0);
    }
    if n >= 3.0 {
        return ((1.0 - s * s).sqrt() + (n - 2.0) * s * s * profile(n - 2.0, s)) / (n - 1.0);
    }
    integral(0.0, (1.0 / s).acosh(), |t| (s * t.cosh()).powf(n - 1.0))
}
