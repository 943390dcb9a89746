//! Any symmetric, periodic single contact of a line, by superposition of strip punches.
//!
//! The map `tan(pi b/L) = sinh tau` takes the half-widths `0 < b < L/2` to `tau > 0` and turns the kernels of the
//! periodic problem into those of the isolated one; all integrals below are taken in it.

use super::quadrature::integral;
use std::f64::consts::{FRAC_PI_2, PI};

/// Largest `tau`: there the gap between two contacts is `1e-14` of the period.
const LARGEST: f64 = 32.0;

/// The periodic contact of a line with one symmetric asperity per period.
///
/// The asperity is given by its slope, as a depth: `slope(s) = -dh/ds > 0` at the distance `s` from the peak, for
/// `0 < s < L/2`; `slope` must be smooth there but may be any power of `s` at the peak. With the contact half-width
/// `a`,
///
/// ```text
/// P(a)   = (E*/2) int_-a^a slope(s) sin(pi s/L) / sqrt(sin^2(pi a/L) - sin^2(pi s/L)) ds
/// p(x)   = int_|x|^a P'(b) cos(pi x/L) / (L sqrt(sin^2(pi b/L) - sin^2(pi x/L))) db
/// <g>(a) = <g>(0) - int_0^a c(b) P'(b)/L db,     c(b) = -(2L/(pi E*)) ln sin(pi b/L)
/// ```
///
/// where `c` is the mean gap that a strip punch of half-width `b` closes per unit of mean pressure.
///
/// Source: superposition of the strip punches of Koiter; it reproduces Westergaard's load, mean gap and pressure (tests).
///
/// ```
/// use asperity::theory::Periodic;
/// let parabola = Periodic { slope: |s| s / 0.25, period: 1.0, contact_modulus: 1.0 };
/// let hertz = std::f64::consts::PI * 0.1 * 0.1 / (4.0 * 0.25);
/// assert!((parabola.load(0.1) / hertz - 1.016896).abs() < 5e-7);
/// assert!((parabola.kappa_r(0.1) - 1.44578).abs() < 5e-6);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Periodic<S> {
    /// Slope `-dh/ds` at the distance `s` from the peak.
    pub slope: S,
    /// Period `L`, a length.
    pub period: f64,
    /// Contact modulus `E*`, a pressure.
    pub contact_modulus: f64,
}

impl<S: Fn(f64) -> f64> Periodic<S> {
    /// Load per unit length at the contact half-width `a`; pressure times length.
    pub fn load(&self, a: f64) -> f64 {
        self.load_at(self.tau(a))
    }

    /// Contact half-width under the load `load` per unit length, a length; `None` where the contact is full but for
    /// `1e-14` of the period, or the load is not positive.
    pub fn half_width(&self, load: f64) -> Option<f64> {
        let (mut low, mut high) = (LARGEST, LARGEST);
        while load > 0.0 && self.load_at(low) > load {
            (low, high) = (0.5 * low, low);
        }
        (low < high).then(|| self.width(bisect(low, high, |tau| self.load_at(tau) > load)))
    }

    /// Root-mean-square slope over a contact of half-width `a`, the `gbar_r` of Eq. 6.
    pub fn rms_gradient_contact(&self, a: f64) -> f64 {
        integral(0.0, 1.0, |w| 2.0 * w * (self.slope)(a * w * w).powi(2)).sqrt()
    }

    /// `kappa_r = a_rel gbar_r E* / p_mean` (Eq. 3) at the contact half-width `a`.
    pub fn kappa_r(&self, a: f64) -> f64 {
        2.0 * a * self.rms_gradient_contact(a) * self.contact_modulus / self.load(a)
    }

    /// Gap averaged over the period at the contact half-width `a`, a length.
    pub fn mean_gap(&self, a: f64) -> f64 {
        let (half, end) = (0.5 * self.period, self.tau(a));
        let open = integral(0.0, 1.0, |w| 2.0 * w * (self.slope)(half * w * w) * half * (1.0 - w * w));
        let compliance = -2.0 / (PI * self.contact_modulus) * end.tanh().ln();
        let by_parts = integral(0.0, 1.0, |w| {
            let tau = end * w * w;
            2.0 * w * end * self.load_at(tau) / (0.5 * (2.0 * tau).sinh())
        });
        open - compliance * self.load_at(end) - 2.0 / (PI * self.contact_modulus) * by_parts
    }

    /// The pressure of a contact of half-width `a`, as a function of the distance from its middle.
    pub fn pressure(&self, a: f64) -> Profile<'_, S> {
        let (end, angle) = (self.tau(a), |k: usize| PI * (k as f64 + 0.5) / TERMS as f64);
        let ratio = |k: usize| {
            let tau = 0.5 * end * (1.0 + angle(k).cos());
            self.load_rate(tau) / (self.slope)(self.width(tau))
        };
        let values: Vec<f64> = (0..TERMS).map(ratio).collect();
        let term = |j: usize| {
            let sum: f64 = values.iter().enumerate().map(|(k, value)| value * (j as f64 * angle(k)).cos()).sum();
            sum * if j == 0 { 1.0 } else { 2.0 } / TERMS as f64
        };
        Profile { contact: self, end, series: (0..TERMS).map(term).collect() }
    }

    /// `tau` at the half-width `a`.
    fn tau(&self, a: f64) -> f64 {
        (PI * a / self.period).tan().asinh()
    }

    /// Half-width at `tau`.
    fn width(&self, tau: f64) -> f64 {
        self.period / PI * tau.sinh().atan()
    }

    /// Load as a function of `tau`: `(E* L/pi) int_0^tau slope(s(t)) dt` with `cos(pi s/L) = cosh(t)/cosh(tau)`, taken
    /// in `t = tau cos(beta)`.
    fn load_at(&self, tau: f64) -> f64 {
        let factor = self.contact_modulus * self.period / PI * tau;
        factor * integral(0.0, FRAC_PI_2, |beta| (self.slope)(self.distance(tau, beta)) * beta.sin())
    }

    /// The distance `s` in [`Periodic::load_at`], from half-angles so that it keeps all digits near the peak.
    fn distance(&self, tau: f64, beta: f64) -> f64 {
        let (sin, cos) = (0.5 * beta).sin_cos();
        let square = (tau * cos * cos).sinh() * (tau * sin * sin).sinh() / tau.cosh();
        2.0 * self.period / PI * square.sqrt().asin()
    }

    /// `dP/dtau`, by the central difference of sixth order: its step of 1 % leaves 1e-12.
    fn load_rate(&self, tau: f64) -> f64 {
        let difference = |k: f64| self.load_at(tau * (1.0 + 0.01 * k)) - self.load_at(tau * (1.0 - 0.01 * k));
        (45.0 * difference(1.0) - 9.0 * difference(2.0) + difference(3.0)) / (0.6 * tau)
    }
}

/// The root of a predicate that turns from false at `low` to true at `high`.
fn bisect(mut low: f64, mut high: f64, is_above: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if is_above(middle) { high = middle } else { low = middle }
    }
}

/// The pressure of a periodic contact, made by [`Periodic::pressure`].
///
/// The density of punches `P'(b)` is tabulated once: relative to the slope at `b` it is a smooth function of `tau`, for
/// any power law at the peak, and so a short Chebyshev series.
#[derive(Debug, Clone)]
pub struct Profile<'a, S> {
    contact: &'a Periodic<S>,
    end: f64,
    series: Vec<f64>,
}

/// Terms of the Chebyshev series.
const TERMS: usize = 48;

impl<S: Fn(f64) -> f64> Profile<'_, S> {
    /// Pressure at the distance `x` from the middle of the contact; in the middle itself infinite for a wedge.
    pub fn at(&self, x: f64) -> f64 {
        let inner = (PI * x / self.contact.period).tan().abs();
        let ratio = self.end.sinh() / inner;
        if ratio.is_infinite() {
            return self.in_the_middle();
        }
        if ratio <= 1.0 {
            return 0.0;
        }
        integral(0.0, ratio.acosh(), |v| self.density((inner * v.cosh()).asinh())) / self.contact.period
    }

    /// `(1/L) int dP/dtau dS/S` over `S = sinh tau`, whose part below a millionth of the whole is that of a power law.
    fn in_the_middle(&self) -> f64 {
        let (largest, range) = (self.end.sinh(), 1e6_f64.ln());
        let density = |v: f64| self.density((largest * (v - range).exp()).asinh());
        let growth = (density(1.0) / density(0.0)).ln();
        if growth < 1e-6 {
            return f64::INFINITY;
        }
        (density(0.0) / growth + integral(0.0, range, density)) / self.contact.period
    }

    /// `dP/dtau` from the table (Clenshaw's recurrence).
    fn density(&self, tau: f64) -> f64 {
        let x = 2.0 * tau / self.end - 1.0;
        let sums = self.series[1..].iter().rev().fold((0.0, 0.0), |(b1, b2), c| (c + 2.0 * x * b1 - b2, b1));
        (self.series[0] + x * sums.0 - sums.1) * (self.contact.slope)(self.contact.width(tau))
    }
}

/// Pressure under a flat strip punch of half-width `b` per period `L`, at the distance `x` from its middle (Koiter):
/// `p_mean cos(pi x/L) / sqrt(sin^2(pi b/L) - sin^2(pi x/L))`, infinite at its edges and zero beyond.
pub fn strip_pressure(mean_pressure: f64, half_width: f64, period: f64, x: f64) -> f64 {
    let [inner, outer] = [x, half_width].map(|s| (PI * s / period).sin());
    let square = outer * outer - inner * inner;
    if square < 0.0 { 0.0 } else { mean_pressure * (PI * x / period).cos().abs() / square.sqrt() }
}

/// Share of the load of a strip punch that lies between its middle and the distance `x` on one side, from -1/2 to 1/2:
/// `asin(sin(pi x/L) / sin(pi b/L)) / pi`.
pub fn strip_load(half_width: f64, period: f64, x: f64) -> f64 {
    let within = x.clamp(-half_width, half_width);
    ((PI * within / period).sin() / (PI * half_width / period).sin()).clamp(-1.0, 1.0).asin() / PI
}

/// Depth of the middle of the gap between two strip punches below their faces, a length:
/// `(2 L p_mean/(pi E*)) acosh(1/sin(pi b/L))`.
pub fn strip_penetration(mean_pressure: f64, half_width: f64, period: f64, contact_modulus: f64) -> f64 {
    strip_length(mean_pressure, period, contact_modulus) * (PI * half_width / period).sin().recip().acosh()
}

/// Mean depth of the solid's surface below the faces of strip punches, a length: `-(2 L p_mean/(pi E*)) ln sin(pi
/// b/L)`.
pub fn strip_mean_penetration(mean_pressure: f64, half_width: f64, period: f64, contact_modulus: f64) -> f64 {
    -strip_length(mean_pressure, period, contact_modulus) * (PI * half_width / period).sin().ln()
}

/// `2 L p_mean/(pi E*)`.
fn strip_length(mean_pressure: f64, period: f64, contact_modulus: f64) -> f64 {
    2.0 * period * mean_pressure / (PI * contact_modulus)
}
