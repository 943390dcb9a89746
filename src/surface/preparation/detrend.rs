//! Heights without their trend.

use super::Scan;
use super::least_squares::linear;
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Heights below this fraction of those before the trend was subtracted are rounding errors, and become 0.
const ROUNDING: f64 = 1e-13;

/// The trend to subtract from measured heights: the least-squares polynomial through all heights that are not void.
///
/// ```
/// use asperity::surface::{Detrend, Scan};
/// let height = ndarray::Array2::from_shape_fn((4, 6), |(y, x)| 7.0 + 0.5 * y as f64 - 0.25 * (x * x) as f64);
/// let bent = Scan { height, spacing: [1.0, 1.0] };
/// assert!(Detrend::Curvature.apply(bent.clone()).height.iter().all(|h| h.abs() < 1e-13));
/// assert!(Detrend::Mean.apply(bent).height.sum().abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Detrend {
    /// The mean height, which does not change the contact.
    Mean,
    /// The least-squares plane; for a line, the straight line.
    Plane,
    /// The least-squares polynomial of second order; for a line, the parabola.
    Curvature,
}

impl Detrend {
    /// The heights without their trend.
    pub fn apply(self, scan: Scan) -> Scan {
        let (trend, before) = (self.coefficients(&scan), scan.reach());
        let mut rest = scan.less(|place| legendre(place).iter().zip(trend).map(|(f, c)| f * c).sum());
        if self != Self::Mean && rest.reach() <= ROUNDING * before {
            rest.height.mapv_inplace(|h| if h.is_nan() { h } else { 0.0 });
        }
        rest
    }

    /// The slopes along y and x of the plane of least squares.
    pub(in crate::surface) fn tilt(scan: &Scan) -> [f64; 2] {
        let [_, y, x, ..] = Self::Plane.coefficients(scan);
        [y, x].map(|slope| slope / scan.half())
    }

    /// The heights minus the least-squares plane through some of the nodes.
    pub(in crate::surface) fn plane_through(scan: &Scan, nodes: &Array2<bool>) -> Scan {
        let mut some = scan.clone();
        some.height.zip_mut_with(nodes, |h, is_of_plane| *h = if *is_of_plane { *h } else { f64::NAN });
        let coefficients = Self::Plane.coefficients(&some);
        scan.clone()
            .less(|place| coefficients.iter().zip(legendre(place)).map(|(factor, function)| factor * function).sum())
    }

    /// The coefficients of Legendre's polynomials, 0 for those that are not in the trend.
    fn coefficients(self, scan: &Scan) -> [f64; 6] {
        let terms = match self {
            Self::Mean => 1,
            Self::Plane => 3,
            Self::Curvature => 6,
        };
        let functions = |place: [f64; 2]| {
            let all = legendre(place);
            std::array::from_fn(|i| if i < terms { all[i] } else { 0.0 })
        };
        linear(scan.points().into_iter().map(|(place, h)| (functions(place), h)))
    }
}

/// Legendre's polynomials up to second order, which are nearly independent on a map: `1, y, x, xy, P_2(y), P_2(x)`.
pub(super) fn legendre([y, x]: [f64; 2]) -> [f64; 6] {
    let second = |x: f64| 0.5 * (3.0 * x * x - 1.0);
    [1.0, y, x, x * y, second(y), second(x)]
}
