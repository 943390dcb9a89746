//! The model of Greenwood and Williamson, with the gradient taken over the contact.

use super::quadrature::integral;
use libm::tgamma;
use std::f64::consts::{PI, TAU};

/// Distribution of summit heights `z` of scale `sigma`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SummitHeights {
    /// `phi(z) = exp(-z/sigma)/sigma`, as the paper has it above the reference plane.
    Exponential,
    /// `phi(z) = exp(-z^2/(2 sigma^2))/sqrt(2 pi sigma^2)`.
    Gaussian,
}

impl SummitHeights {
    /// `kappa_r` at the separation `d/sigma` (Eqs. 21, 22): no other parameter of the model enters.
    ///
    /// `kappa_r = (3 pi/4) sqrt(F_1 F_2/2) / F_{3/2}` with `F_m = int_d^inf (z-d)^m phi dz`: `sqrt(pi)` for exponential
    /// heights, and the limit `sqrt(pi)` of Gaussian heights for large separations.
    ///
    /// ```
    /// use asperity::theory::SummitHeights;
    /// let root_pi = std::f64::consts::PI.sqrt();
    /// assert!((SummitHeights::Exponential.kappa_r(3.0) - root_pi).abs() < 1e-14);
    /// assert!((SummitHeights::Gaussian.kappa_r(40.0) - root_pi).abs() < 1e-3);
    /// ```
    pub fn kappa_r(self, separation: f64) -> f64 {
        let [first, three_halves, second] = [1.0, 1.5, 2.0].map(|m| self.scaled_moment(m, separation));
        0.75 * PI * (0.5 * first * second).sqrt() / three_halves
    }

    /// `F_m` in units of `sigma^m`.
    pub(super) fn moment(self, m: f64, separation: f64) -> f64 {
        let scale = match self {
            Self::Exponential => (-separation).exp(),
            Self::Gaussian if separation > 0.0 => (-0.5 * separation * separation).exp(),
            Self::Gaussian => 1.0,
        };
        self.scaled_moment(m, separation) * scale
    }

    /// `F_m` in units of `sigma^m` without its exponential factor, so that no separation underflows.
    fn scaled_moment(self, m: f64, separation: f64) -> f64 {
        match self {
            Self::Exponential => tgamma(m + 1.0),
            Self::Gaussian => gaussian_moment(m, separation),
        }
    }
}

/// `int_0^inf w^m exp(-w d - w^2/2) dw / sqrt(2 pi)` for `d > 0`, else the same times `exp(-d^2/2)`; taken in `sqrt w`,
/// which makes `w^(3/2)` smooth, and cut where the exponential falls below 1e-18.
fn gaussian_moment(m: f64, d: f64) -> f64 {
    let reach: f64 = 84.0;
    let (from, to) = if d > 0.0 {
        (0.0, reach / (d + d.hypot(reach.sqrt())))
    } else {
        ((-d - reach.sqrt()).max(0.0), reach.sqrt() - d)
    };
    let exponent = |w: f64| if d > 0.0 { -w * (d + 0.5 * w) } else { -0.5 * (w + d) * (w + d) };
    let integrand = |root: f64| 2.0 * root.powf(2.0 * m + 1.0) * exponent(root * root).exp();
    integral(f64::sqrt(from), to.sqrt(), integrand) / TAU.sqrt()
}

/// The model of Greenwood and Williamson: equal spheres of random height, each a Hertz contact that ignores the others.
///
/// A summit at the height `z` above the separation `d` is compressed by `w = z - d`: `da = pi R w`, `dL = (4/3) E* w
/// sqrt(R w)`, and contributes `pi (R w)^2/(2 R^2)` to the integral of the squared gradient (Eqs. 12, 13, 18, 19). With
/// `F_m = int_d^inf (z-d)^m phi dz` and `eta` summits per area
///
/// ```text
/// a_rel = pi eta R F_1        p = (4/3) eta E* sqrt(R) F_{3/2}        gbar_r^2 = F_2/(2 R F_1)
/// ```
///
/// The paper leaves `eta` out (`eta = 1`); it drops out of `gbar_r` and `kappa_r`.
///
/// All methods take the separation `d/sigma`.
///
/// Source: Section 6 of the paper, Eqs. 12 to 22; J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295, 300
/// (1966).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GreenwoodWilliamson {
    /// Distribution of summit heights.
    pub heights: SummitHeights,
    /// Scale `sigma` of the heights, a length.
    pub scale: f64,
    /// Radius `R` of the summits, a length.
    pub radius: f64,
    /// Summits per area `eta`, 1/length^2.
    pub density: f64,
    /// Contact modulus `E*`, a pressure.
    pub contact_modulus: f64,
}

impl GreenwoodWilliamson {
    /// Relative contact area (Eqs. 14, 16) at the separation `d/sigma`.
    pub fn relative_area(&self, separation: f64) -> f64 {
        PI * self.density * self.radius * self.scale * self.heights.moment(1.0, separation)
    }

    /// Mean pressure (Eqs. 15, 17) at the separation `d/sigma`.
    pub fn pressure(&self, separation: f64) -> f64 {
        let length_cubed = self.scale * (self.radius * self.scale).sqrt();
        4.0 / 3.0 * self.density * self.contact_modulus * length_cubed * self.heights.moment(1.5, separation)
    }

    /// Root-mean-square gradient over the contact (Eqs. 18, 20) at the separation `d/sigma`.
    pub fn rms_gradient_contact(&self, separation: f64) -> f64 {
        let [first, second] = [1.0, 2.0].map(|m| self.heights.scaled_moment(m, separation));
        (0.5 * self.scale / self.radius * second / first).sqrt()
    }
}
