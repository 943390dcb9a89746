//! The sine pressed on a half-space.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The periodic contact with `h = D cos(2 pi x/L)`, exact at any load (Westergaard).
///
/// With the contact half-width `a`, `psi = pi a/L`, `t = pi x/L` and `p_full = pi E* D/L`,
///
/// ```text
/// p_mean = p_full sin^2 psi
/// p(x)   = 2 p_full cos t sqrt(sin^2 psi - sin^2 t)        |x| <= a
/// <g>    = D cos^2 psi + 2 D sin^2 psi ln sin psi
/// ```
///
/// and from `p_mean = p_full` on the contact is full: `p = p_mean + p_full cos(2 pi x/L)`, `<g> = 0`.
///
/// Source: H. M. Westergaard, J. Appl. Mech. 6, 49 (1939); Johnson (1985), section 13.2. The mean gap is the integral
/// of the compliance of the strip punch, see [`super::periodic`].
///
/// ```
/// use asperity::theory::Westergaard;
/// let sine = Westergaard { amplitude: 0.01, period: 1.0, contact_modulus: 1.0 };
/// let half = 0.5 * sine.full_pressure();
/// assert!((sine.relative_area(half) - 0.5).abs() < 1e-15);
/// assert!((sine.mean_gap(half) / 0.02 - 0.076713).abs() < 5e-7);
/// assert!((sine.kappa_r(half) - 2f64.sqrt()).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Westergaard {
    /// Amplitude `D`, a length: half the height from valley to peak.
    pub amplitude: f64,
    /// Period `L`, a length.
    pub period: f64,
    /// Contact modulus `E*`, a pressure.
    pub contact_modulus: f64,
}

impl Westergaard {
    /// Mean pressure that just makes the contact full, `pi E* D/L`.
    pub fn full_pressure(&self) -> f64 {
        PI * self.contact_modulus * self.amplitude / self.period
    }

    /// Mean pressure at the contact half-width `a` (up to half the period).
    pub fn mean_pressure(&self, a: f64) -> f64 {
        self.full_pressure() * (PI * a / self.period).sin().powi(2)
    }

    /// `psi = pi a/L` at the mean pressure `mean_pressure`.
    fn angle(&self, mean_pressure: f64) -> f64 {
        (mean_pressure / self.full_pressure()).clamp(0.0, 1.0).sqrt().asin()
    }

    /// Contact half-width at the mean pressure `mean_pressure`, a length.
    pub fn half_width(&self, mean_pressure: f64) -> f64 {
        self.angle(mean_pressure) / PI * self.period
    }

    /// Relative contact area.
    pub fn relative_area(&self, mean_pressure: f64) -> f64 {
        self.angle(mean_pressure) / FRAC_PI_2
    }

    /// Pressure at the distance `x` from a peak.
    pub fn pressure(&self, mean_pressure: f64, x: f64) -> f64 {
        let (full, t) = (self.full_pressure(), PI * x / self.period);
        if mean_pressure >= full {
            return mean_pressure + full * (2.0 * t).cos();
        }
        let square = self.angle(mean_pressure).sin().powi(2) - t.sin().powi(2);
        2.0 * full * t.cos().abs() * square.max(0.0).sqrt()
    }

    /// Gap averaged over the period, a length.
    pub fn mean_gap(&self, mean_pressure: f64) -> f64 {
        let psi = self.angle(mean_pressure);
        if psi == 0.0 || psi == FRAC_PI_2 {
            return self.amplitude * psi.cos().round();
        }
        self.amplitude * (psi.cos().powi(2) + 2.0 * psi.sin().powi(2) * psi.sin().ln())
    }

    /// Root-mean-square gradient over the contact, `gbar_r^2 = (2 pi D/L)^2 (1 - sin(4 psi)/(4 psi))/2`.
    pub fn rms_gradient_contact(&self, mean_pressure: f64) -> f64 {
        let slope = TAU * self.amplitude / self.period;
        slope * (0.5 * one_less_sinc(4.0 * self.angle(mean_pressure))).sqrt()
    }

    /// `kappa_r = a_rel gbar_r E* / p_mean` (Eq. 3): `8/(pi sqrt 3)` at small loads, less at larger ones.
    pub fn kappa_r(&self, mean_pressure: f64) -> f64 {
        self.relative_area(mean_pressure) * self.rms_gradient_contact(mean_pressure) * self.contact_modulus
            / mean_pressure
    }
}

/// `1 - sin(y)/y`, by its series where the difference would lose digits.
fn one_less_sinc(y: f64) -> f64 {
    let z = y * y;
    if z > 0.01 {
        return 1.0 - y.sin() / y;
    }
    z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0)))
}

/// Mean pressure that just makes the contact with `h = D cos(2 pi x/Lx) cos(2 pi y/Ly)` full,
/// `pi E* D sqrt(1/Lx^2 + 1/Ly^2)`: `sqrt2 pi E* D/L` in a square cell.
///
/// From there on `p = p_mean + p_full cos(2 pi x/Lx) cos(2 pi y/Ly)`. Below it no closed form is known.
///
/// Source: K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci. 27, 383 (1985).
pub fn crossed_full_pressure(amplitude: f64, [ly, lx]: [f64; 2], contact_modulus: f64) -> f64 {
    PI * contact_modulus * amplitude * lx.recip().hypot(ly.recip())
}
