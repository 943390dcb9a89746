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
/// | field             | meaning                       | unit              |
/// |-------------------|-------------------------------|-------------------|
/// | `geometry`        | line or point                 | -                 |
/// | `coefficient`     | `A`                           | length^(1-n)      |
/// | `exponent`        | `n`, from 1 to 64             | -                 |
/// | `contact_modulus` | `E*`                          | pressure          |
///
/// Outside that range of exponents the pressure is NaN.
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
    /// Coefficient `A`, length^(1-n).
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

#[cfg(test)]
mod tests {
    use super::*;
    use Geometry::{Line, Point};

    fn indenter(geometry: Geometry, exponent: f64) -> PowerLaw {
        PowerLaw { geometry, coefficient: 0.3, exponent, contact_modulus: 2.0 }
    }

    #[test]
    fn kappa_r_of_the_first_four_exponents() {
        let line = [2.0, 1.47021, 1.34164, 1.28330];
        let point = [2.0, 1.66608, 1.53960, 1.47262];
        for (n, (line, point)) in line.into_iter().zip(point).enumerate() {
            let n = n as f64 + 1.0;
            assert!((indenter(Line, n).kappa_r() - line).abs() < 5e-6);
            assert!((indenter(Point, n).kappa_r() - point).abs() < 5e-6);
        }
    }

    #[test]
    fn kappa_r_is_its_definition() {
        for n in [1.0, 1.5, 2.0, 3.3, 10.0] {
            let (line, point, a) = (indenter(Line, n), indenter(Point, n), 0.7);
            let of_line = 2.0 * a * line.rms_gradient_contact(a) * 2.0 / line.load(a);
            let of_point = PI * a * a * point.rms_gradient_contact(a) * 2.0 / point.load(a);
            assert!((line.kappa_r() / of_line - 1.0).abs() < 1e-13);
            assert!((point.kappa_r() / of_point - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn wedge_and_cone_have_their_logarithmic_pressure() {
        let (wedge, cone) = (indenter(Line, 1.0), indenter(Point, 1.0));
        assert!((wedge.load(0.4) - 2.0 * 0.3 * 0.4).abs() < 1e-15);
        assert!((cone.half_width(1.7) - (2.0 * 1.7 / (PI * 2.0 * 0.3)).sqrt()).abs() < 1e-14);
        for x in [1e-9, 0.1, 0.3, 0.3999] {
            let log = (0.4_f64 / x).acosh();
            assert!((wedge.pressure(0.4, x) - 2.0 * 0.3 / PI * log).abs() < 1e-13);
            assert!((cone.pressure(0.4, -x) - 2.0 * 0.3 / 2.0 * log).abs() < 1e-13);
        }
        assert_eq!((wedge.pressure(0.4, 0.0), cone.pressure(0.4, 0.4)), (f64::INFINITY, 0.0));
    }

    #[test]
    fn pressure_carries_the_load() {
        for n in [1.2, 1.5, 2.0, 2.7, 3.0, 4.0, 7.5, 64.0] {
            let (line, point, a) = (indenter(Line, n), indenter(Point, n), 1.3);
            // x = a sin^3(t) spreads the nodes to both ends.
            let x = |t: f64| (a * t.sin().powi(3), 3.0 * a * t.sin().powi(2) * t.cos());
            let of_line = 2.0 * integral(0.0, 0.5 * PI, |t| line.pressure(a, x(t).0) * x(t).1);
            let of_point = integral(0.0, 0.5 * PI, |t| 2.0 * PI * x(t).0 * point.pressure(a, x(t).0) * x(t).1);
            assert!((of_line / line.load(a) - 1.0).abs() < 1e-6, "{n}: {of_line}");
            assert!((of_point / point.load(a) - 1.0).abs() < 1e-6, "{n}: {of_point}");
        }
    }

    #[test]
    fn pressure_is_continuous_in_the_middle() {
        for n in [2.0, 2.5, 3.0, 4.0, 9.0] {
            let line = indenter(Line, n);
            assert!((line.pressure(1.0, 1e-12) / line.pressure(1.0, 0.0) - 1.0).abs() < 1e-9, "{n}");
        }
        assert!(PowerLaw { exponent: 1e300, ..indenter(Line, 1.0) }.pressure(1.0, 0.5).is_nan());
    }

    #[test]
    fn half_width_inverts_the_load() {
        for geometry in [Line, Point] {
            for n in [1.0, 2.0, 3.7] {
                let indenter = indenter(geometry, n);
                assert!((indenter.half_width(indenter.load(0.8)) - 0.8).abs() < 1e-14);
            }
        }
    }
}
