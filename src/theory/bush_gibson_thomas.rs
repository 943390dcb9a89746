//! The asperity model of Bush, Gibson and Thomas, at any load.

use super::greenwood_williamson::SummitHeights;
use super::quadrature::integral;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// Standard deviations to either side over which the curvatures are integrated.
const REACH: f64 = 9.0;
/// Separations between which the load is searched, in standard deviations of the heights.
const SEPARATIONS: [f64; 2] = [-10.0, 38.0];
/// Halvings of an interval until it is as short as rounding.
const HALVINGS: usize = 60;
/// Shapes of summits over which the curvatures are integrated.
const SHAPES: usize = 256;
/// Rounds of the arithmetic-geometric mean, which doubles the digits with each one.
const ROUNDS: usize = 12;

/// The model of Bush, Gibson and Thomas: each summit of a Gaussian isotropic surface is an elliptic paraboloid of its own height and
/// curvatures, and an elliptic Hertz contact that ignores the others.
///
/// Heights `z`, gradients and second derivatives of the surface have the joint normal distribution of Longuet-Higgins and Nayak,
/// with the moments `m0`, `m2`, `m4` of [`SpectralMoments`](crate::surface::SpectralMoments). With the principal curvatures `k1 >= k2`
/// of summits,
///
/// ```text
/// zeta = z/sqrt(m0)      c = (k1 + k2)/sqrt(8 m4/3)      q = (k1 - k2)/(k1 + k2)      rho^2 = 3/(2 alpha)
/// zeta at a given c      normal of mean rho c and variance 1 - rho^2
/// q at a given c         density 2 c^2 q exp(-c^2 q^2)
/// summits per area       (1 - q^2) c^2 m4/(3 pi m2) times the densities of c, zeta and q, for 0 < q < 1
/// ```
///
/// A summit that is compressed by `w` touches on an ellipse of parameter `m = 1 - b^2/a^2`. With the complete elliptic integrals
/// `K(m)` and `E(m)`,
///
/// ```text
/// k2/k1 = (1 - m)(K - E)/(E - (1 - m) K)      a^2 = 2 w (K - E)/(K m k2)
/// area = pi a^2 sqrt(1 - m)                   load = 2 pi E* w a/(3 K)
/// ```
///
/// Area and load are the sums over all summits above the separation. Only Nayak's parameter `alpha` enters, if the pressure is
/// reduced by the rms gradient `gbar = sqrt(2 m2)`. As the load vanishes `kappa = a_rel/p*` tends to `sqrt(2 pi)`
/// ([`KAPPA_BGT`](super::persson::KAPPA_BGT)), the more slowly the larger `alpha` is.
///
/// Source: A. W. Bush, R. D. Gibson, T. R. Thomas, Wear 35, 87 (1975); P. R. Nayak, J. Lubr. Technol. 93, 398 (1971); K. L. Johnson,
/// Contact Mechanics (1985), Sec. 4.2; for the slow limit G. Carbone, F. Bottiglione, J. Mech. Phys. Solids 56, 2555 (2008).
///
/// ```
/// use asperity::theory::{BushGibsonThomas, persson::KAPPA_BGT};
/// let [narrow, broad] = [2.0, 100.0].map(|nayak| BushGibsonThomas { nayak });
/// assert!(broad.kappa(0.01) < narrow.kappa(0.01) && narrow.kappa(0.01) < KAPPA_BGT);
/// assert!((narrow.kappa(1e-100) / KAPPA_BGT - 1.0).abs() < 0.01);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BushGibsonThomas {
    /// Nayak's parameter `alpha = m0 m4/m2^2`, above 3/2.
    pub nayak: f64,
}

/// A shape of summits, with its weight in an integral over `q`.
struct SummitShape {
    weight: f64,
    q: f64,
    /// `sqrt(1 - m) (K - E)/(K m)`, the area without its scale.
    area: f64,
    /// `(1 - q)^(1/2) sqrt((K - E)/(K m))/K`, the load without its scale.
    load: f64,
}

/// The shapes, equally far apart in `sqrt(1 - q)`: the area has a square root where summits become ridges.
static RULE: LazyLock<Vec<SummitShape>> = LazyLock::new(|| {
    let width = 1.0 / SHAPES as f64;
    (0..SHAPES).flat_map(|i| [-1.0, 1.0].map(|sign| SummitShape::new(width, i as f64, sign))).collect()
});

impl SummitShape {
    /// One of the two Gauss points of interval `i` in `t = sqrt(1 - q)`.
    fn new(width: f64, i: f64, sign: f64) -> Self {
        let t = width * (i + 0.5 + sign / 12f64.sqrt());
        let q = 1.0 - t * t;
        let parameter = parameter((1.0 - q) / (1.0 + q));
        let (k, sum) = elliptic(parameter);
        let shape = sum / (1.0 - parameter);
        Self { weight: width * t, q, area: parameter.sqrt() * shape, load: t * shape.sqrt() / k }
    }
}

/// `1 - m` of the ellipse on which a summit with the ratio of curvatures `k2/k1` touches.
fn parameter(ratio: f64) -> f64 {
    let of = |log: f64| {
        let complement = log.exp();
        let (_, sum) = elliptic(complement);
        complement * sum / (1.0 - complement - sum)
    };
    let [mut low, mut high] = [-80.0, -1e-9];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if of(middle) < ratio { &mut low } else { &mut high }) = middle;
    }
    f64::exp(0.5 * (low + high))
}

/// The complete elliptic integral `K(m)`, and `(K - E)/K`, of `1 - m`; by the arithmetic-geometric mean.
fn elliptic(complement: f64) -> (f64, f64) {
    let (mut a, mut b, mut sum, mut power) = (1.0, complement.sqrt(), 0.5 * (1.0 - complement), 1.0);
    for _ in 0..ROUNDS {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += power * c * c;
        power *= 2.0;
    }
    (FRAC_PI_2 / a, sum)
}

impl BushGibsonThomas {
    /// Relative contact area at the separation `d/sqrt(m0)` from the mean plane. It is a sum over summits that may overlap, and not
    /// limited by 1.
    pub fn relative_area(&self, separation: f64) -> f64 {
        let summits = |c: f64| {
            let shape = |it: &SummitShape| it.weight * it.q * (1.0 + it.q) * (-(c * it.q).powi(2)).exp() * it.area;
            2.0 * c.powi(3) * RULE.iter().map(shape).sum::<f64>()
        };
        (2.0 * self.nayak / 3.0).sqrt() * self.over_curvatures(separation, 1.0, summits)
    }

    /// Reduced pressure `p* = p/(gbar E*)` at the separation `d/sqrt(m0)` from the mean plane.
    pub fn reduced_pressure(&self, separation: f64) -> f64 {
        let summits = |c: f64| {
            let shape = |it: &SummitShape| it.weight * it.q * (1.0 + it.q) * (-(c * it.q).powi(2)).exp() * it.load;
            2.0 * c.powf(3.5) * RULE.iter().map(shape).sum::<f64>()
        };
        let scale = 4.0 / 9.0 * 0.375f64.powf(0.25) / 2f64.sqrt();
        scale * self.nayak.powf(0.75) * self.over_curvatures(separation, 1.5, summits)
    }

    /// `kappa = a_rel/p*` at a reduced pressure `p*`. Below the smallest pressure that has a separation, about 1e-300, it is that
    /// of this pressure.
    pub fn kappa(&self, reduced_pressure: f64) -> f64 {
        let [mut low, mut high] = SEPARATIONS;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if self.reduced_pressure(middle) > reduced_pressure { &mut low } else { &mut high }) = middle;
        }
        self.relative_area(low) / self.reduced_pressure(low)
    }

    /// The mean over `c` of `summits`, times that of the `power` of the compression.
    fn over_curvatures(&self, separation: f64, power: f64, summits: impl Fn(f64) -> f64) -> f64 {
        let correlation = (1.5 / self.nayak).sqrt();
        let deviation = (1.0 - correlation * correlation).sqrt();
        let integrand = |c: f64| {
            let distance = (separation - correlation * c) / deviation;
            let heights = deviation.powf(power) * SummitHeights::Gaussian.moment(power, distance);
            (-0.5 * c * c).exp() / (2.0 * PI).sqrt() * heights * summits(c)
        };
        let middle = (correlation * separation).max(0.0);
        integral((middle - REACH).max(0.0), middle + REACH, integrand)
    }
}
