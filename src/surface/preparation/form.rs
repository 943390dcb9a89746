//! Heights without the form of the measured body.

use super::detrend::legendre;
use super::least_squares::{linear, nearest};
use crate::formats::Scan;
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The form to subtract from measured heights: the least-squares body through all heights that exist, at any position
/// and with any tilt.
///
/// In the section of a body its height is `c s^2 / (1 + sqrt(1 - c^2 s^2))` at the distance `s` from its highest or
/// lowest point, with the curvature `c` of either sign. A cylinder may have any direction, and its axis may be
/// inclined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Form {
    /// The least-squares cylinder; for a line, the circle.
    Cylinder,
    /// The least-squares sphere; for a line, the circle.
    Sphere,
}

/// A curvature below this fraction of the reciprocal of the map's half length counts as zero.
const FLAT: f64 = 1e-9;

impl Form {
    /// The heights without their form, and its radius, which is negative for a concave form; none if no such body fits.
    pub fn apply(self, scan: Scan) -> Option<(Scan, f64)> {
        let half = scan.half();
        let points: Vec<_> = scan.points().into_iter().map(|(place, h)| (place, h / half)).collect();
        let [z0, zy, zx, zxy, zyy, zxx] = linear(points.iter().map(|(place, h)| (legendre(*place), *h)));
        let bend = Bend { slope: [zy, zx], second: [3.0 * zyy, 3.0 * zxx], mixed: zxy };
        let is_line = scan.shape()[0] == 1;
        let (curvature, form): (f64, Height) = match self {
            Self::Cylinder if !is_line => {
                let fitted = nearest(bend.cylinder(z0)?, &points, cylinder)?;
                (fitted[2], Box::new(move |place| cylinder(&fitted, place).map_or(f64::NAN, |it| it.0)))
            }
            _ => {
                let fitted = nearest(bend.sphere(z0)?, &points, sphere)?;
                (fitted[3], Box::new(move |place| sphere(&fitted, place).map_or(f64::NAN, |it| it.0)))
            }
        };
        (curvature.abs() > FLAT).then(|| (scan.less(|place| half * form(place)), -half / curvature))
    }
}

/// The height of a form at a place.
type Height = Box<dyn Fn([f64; 2]) -> f64>;

/// Slopes and second derivatives of a bent map in its middle.
struct Bend {
    slope: [f64; 2],
    second: [f64; 2],
    mixed: f64,
}

impl Bend {
    /// The sphere to begin with: height, place of the point without slope, and curvature.
    fn sphere(&self, z0: f64) -> Option<[f64; 4]> {
        let [yy, xx] = self.second;
        let curvature = if yy == 0.0 { xx } else { 0.5 * (yy + xx) };
        let summit = self.slope.map(|slope| -slope / curvature);
        (curvature.abs() > FLAT).then_some([z0, summit[0], summit[1], curvature])
    }

    /// The cylinder to begin with: height, distance of its ridge, curvature, angle between its section and x, and slope along its axis.
    fn cylinder(&self, z0: f64) -> Option<[f64; 5]> {
        let [yy, xx] = self.second;
        let angle = 0.5 * (2.0 * self.mixed).atan2(xx - yy);
        let along = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            xx * cos * cos + 2.0 * self.mixed * sin * cos + yy * sin * sin
        };
        let angle = if along(angle).abs() >= along(angle + FRAC_PI_2).abs() { angle } else { angle + FRAC_PI_2 };
        let ((sin, cos), curvature, [sy, sx]) = (angle.sin_cos(), along(angle), self.slope);
        let ridge = -(sx * cos + sy * sin) / curvature;
        (curvature.abs() > FLAT).then_some([z0, ridge, curvature, angle, sy * cos - sx * sin])
    }
}

/// Height of a circle of curvature `c` at the square distance `r2`, with its derivatives by `r2` and `c`; none beyond it.
fn circle(c: f64, r2: f64) -> Option<[f64; 3]> {
    let w = (1.0 - c * c * r2).sqrt();
    (w > 0.0).then(|| [c * r2 / (1.0 + w), c / (2.0 * w), r2 / (1.0 + w) + (c * r2 / (1.0 + w)).powi(2) / w])
}

/// The sphere of some parameters at a place.
fn sphere(&[z0, y0, x0, c]: &[f64; 4], [y, x]: [f64; 2]) -> Option<(f64, [f64; 4])> {
    let [height, by_r2, by_c] = circle(c, (y - y0).powi(2) + (x - x0).powi(2))?;
    Some((z0 + height, [1.0, -2.0 * (y - y0) * by_r2, -2.0 * (x - x0) * by_r2, by_c]))
}

/// The cylinder of some parameters at a place.
fn cylinder(&[z0, s0, c, angle, slope]: &[f64; 5], [y, x]: [f64; 2]) -> Option<(f64, [f64; 5])> {
    let (sin, cos) = angle.sin_cos();
    let (s, t) = (x * cos + y * sin, y * cos - x * sin);
    let [height, by_r2, by_c] = circle(c, (s - s0).powi(2))?;
    let by_s = 2.0 * (s - s0) * by_r2;
    Some((z0 + height + slope * t, [1.0, -by_s, by_c, by_s * t - slope * s, t]))
}
