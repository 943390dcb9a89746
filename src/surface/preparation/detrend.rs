//! Heights without their trend.

use super::least_squares::linear;
use crate::formats::Scan;
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Heights below this fraction of those before the trend was subtracted are rounding errors, and become 0.
const ROUNDING: f64 = 1e-13;
/// The share of the mean square gradient from which on the plane of least squares is a tilt. That of 154 maps without a tilt was at
/// most .017; what stands off is the same without a plane.
const TILTED: f64 = 0.05;

/// The trend to subtract from measured heights: the least-squares polynomial through all heights that are not void.
///
/// ```
/// use asperity::formats::Scan;
/// use asperity::surface::Detrend;
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
    /// The least-squares polynomial of third order, as tube scanners bend maps in the shape of an S.
    Cubic,
}

impl Scan {
    /// The heights without their plane, if it makes much of the mean square gradient: what stands off, settles or is offset is small beside the slope of a
    /// tilted map.
    pub(in crate::surface) fn without_tilt(&self) -> Cow<'_, Self> {
        let [y, x] = Detrend::tilt(self);
        let is_tilted = y * y + x * x > TILTED * self.rms_gradient().powi(2);
        if is_tilted { Cow::Owned(Detrend::Plane.apply(self.clone())) } else { Cow::Borrowed(self) }
    }
}

impl Detrend {
    /// The heights without their trend.
    pub fn apply(self, scan: Scan) -> Scan {
        let (trend, before) = (self.coefficients(&scan), scan.reach());
        let mut rest = scan.less(|place| self.value(&trend, place));
        if self != Self::Mean && rest.reach() <= ROUNDING * before {
            rest.height.mapv_inplace(|h| if h.is_nan() { h } else { 0.0 });
        }
        rest
    }

    /// The slopes along y and x of the plane of least squares.
    pub(in crate::surface) fn tilt(scan: &Scan) -> [f64; 2] {
        let plane = Self::Plane.coefficients(scan);
        [plane[1], plane[2]].map(|slope| slope / scan.half())
    }

    /// The heights minus the least-squares plane through some of the nodes.
    pub(in crate::surface) fn plane_through(scan: &Scan, nodes: &Array2<bool>) -> Scan {
        let mut some = scan.clone();
        some.height.zip_mut_with(nodes, |h, is_of_plane| *h = if *is_of_plane { *h } else { f64::NAN });
        let coefficients = Self::Plane.coefficients(&some);
        scan.clone().less(|place| Self::Plane.value(&coefficients, place))
    }

    /// The coefficients of Legendre's polynomials.
    fn coefficients(self, scan: &Scan) -> Vec<f64> {
        let points = scan.points().into_iter();
        match self {
            Self::Mean => linear(points.map(|(_, h)| ([1.0], h))).to_vec(),
            Self::Plane => linear(points.map(|([y, x], h)| ([1.0, y, x], h))).to_vec(),
            Self::Curvature => linear(points.map(|(place, h)| (legendre(place), h))).to_vec(),
            Self::Cubic => linear(points.map(|(place, h)| (third_order(place), h))).to_vec(),
        }
    }

    /// The trend of some coefficients at a place.
    fn value(self, coefficients: &[f64], place: [f64; 2]) -> f64 {
        let sum = |functions: &[f64]| functions.iter().zip(coefficients).map(|(f, c)| f * c).sum();
        match self {
            Self::Mean => coefficients[0],
            Self::Plane => sum(&[1.0, place[0], place[1]]),
            Self::Curvature => sum(&legendre(place)),
            Self::Cubic => sum(&third_order(place)),
        }
    }
}

/// Legendre's polynomials up to second order, which are nearly independent on a map: `1, y, x, xy, P_2(y), P_2(x)`.
pub(super) fn legendre([y, x]: [f64; 2]) -> [f64; 6] {
    let second = |x: f64| 0.5 * (3.0 * x * x - 1.0);
    [1.0, y, x, x * y, second(y), second(x)]
}

/// The same up to third order: with `P_2(y) x, y P_2(x), P_3(y), P_3(x)`.
fn third_order(place: [f64; 2]) -> [f64; 10] {
    let [one, y, x, xy, yy, xx] = legendre(place);
    let third = |x: f64| 0.5 * (5.0 * x * x - 3.0) * x;
    [one, y, x, xy, yy, xx, yy * x, y * xx, third(y), third(x)]
}
