//! Hertz contact of a paraboloid of two radii of curvature, whose contact is an ellipse.

use std::f64::consts::PI;

/// Halvings of the range of the ratio of the semi-axes, to the last bit.
const BISECTIONS: usize = 200;
/// Steps to the arithmetic-geometric mean, whose digits double with each once the two numbers are close: a ratio of 1e-300 takes 15.
const MEANS: usize = 20;

/// A paraboloid `-x^2/(2 Rx) - y^2/(2 Ry)` on a half-space.
///
/// The contact is an ellipse with semi-axes `a > b`, the longer one along the larger radius `R`. With `k = b/a`, `e^2 = 1 - k^2`, the complete elliptic
/// integral `K(e)` and `D = (K(e) - E(e))/e^2`,
///
/// ```text
/// R_long/R_short = (K - D)/(D k^2)      a^3 = 3 F D R_long/(pi E*)
/// p = p0 sqrt(1 - x^2/ax^2 - y^2/ay^2)  p0 = 3 F/(2 pi a b)        approach = 3 F K/(2 pi a E*)
/// ```
///
/// Source: K. L. Johnson, *Contact Mechanics* (1985), Eqs. 4.25 to 4.28.
///
/// ```
/// use asperity::theory::{EllipticHertz, hertz};
/// let contact = EllipticHertz::new([0.5, 0.5], 2.0);
/// let [ax, ay] = contact.semi_axes(0.3);
/// assert!((ax - hertz::sphere(0.5, 2.0).half_width(0.3)).abs() < 1e-12 && (ax - ay).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EllipticHertz {
    /// Radii of curvature along x and y.
    radii: [f64; 2],
    contact_modulus: f64,
    /// The shorter semi-axis over the longer one.
    ratio: f64,
    /// The elliptic integrals `K` and `D`.
    integrals: [f64; 2],
}

impl EllipticHertz {
    /// The contact of a paraboloid with radii of curvature along x and along y, both lengths.
    pub fn new(radii: [f64; 2], contact_modulus: f64) -> Self {
        let wanted = radii[0].max(radii[1]) / radii[0].min(radii[1]);
        // the ratio of the radii grows as that of the semi-axes falls
        let (mut low, mut high) = (f64::MIN_POSITIVE.ln(), 0.0_f64);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let k = middle.exp();
            let [first, second] = elliptic_integrals(k);
            if (first - second) / (second * k * k) > wanted { low = middle } else { high = middle }
        }
        let ratio = high.exp();
        Self { radii, contact_modulus, ratio, integrals: elliptic_integrals(ratio) }
    }

    /// The semi-axes along x and along y under a load, lengths.
    pub fn semi_axes(&self, load: f64) -> [f64; 2] {
        let [rx, ry] = self.radii;
        let long = (3.0 * load * self.integrals[1] * rx.max(ry) / (PI * self.contact_modulus)).cbrt();
        let short = self.ratio * long;
        if rx >= ry { [long, short] } else { [short, long] }
    }

    /// The largest pressure under a load.
    pub fn max_pressure(&self, load: f64) -> f64 {
        let [ax, ay] = self.semi_axes(load);
        1.5 * load / (PI * ax * ay)
    }

    /// The pressure under a load at the place `[y, x]` from the middle.
    pub fn pressure(&self, load: f64, [y, x]: [f64; 2]) -> f64 {
        let [ax, ay] = self.semi_axes(load);
        let inside = 1.0 - (x / ax).powi(2) - (y / ay).powi(2);
        self.max_pressure(load) * inside.max(0.0).sqrt()
    }

    /// The approach of remote points under a load, a length.
    pub fn approach(&self, load: f64) -> f64 {
        let [ax, ay] = self.semi_axes(load);
        1.5 * load * self.integrals[0] / (PI * ax.max(ay) * self.contact_modulus)
    }

    /// The root mean square slope over the contact, and `kappa_r` from it under a load. The slope is `hypot(x/Rx, y/Ry)`, and the mean of `x^2` over the
    /// ellipse is `ax^2/4`.
    pub fn kappa_r(&self, load: f64) -> f64 {
        let [ax, ay] = self.semi_axes(load);
        let rms_slope = 0.5 * (ax / self.radii[0]).hypot(ay / self.radii[1]);
        PI * ax * ay * rms_slope * self.contact_modulus / load
    }
}

/// The complete elliptic integrals `K` and `D = (K - E)/e^2` of the modulus `e` with `e^2 = 1 - k^2`, by the arithmetic-geometric mean. `D` is summed without
/// the difference, which would cancel for circles.
///
/// Source: NIST Digital Library of Mathematical Functions, 19.8.
fn elliptic_integrals(k: f64) -> [f64; 2] {
    let square = (1.0 - k) * (1.0 + k);
    let (mut a, mut g) = (1.0, k);
    // the terms 2^(n-1) c_n^2 over e^2, of which the first is one half
    let (mut sum, mut power) = (0.5, 1.0);
    for _ in 0..MEANS {
        let c = 0.5 * (a - g);
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
        sum += if square > 0.0 { power * c * c / square } else { 0.0 };
        power *= 2.0;
    }
    let first = 0.5 * PI / a;
    [first, first * sum]
}
