//! Lines of theory along an axis.

use crate::plot::{Axis, Point};

/// A function of the load, along a logarithmic axis.
pub fn along(axis: &Axis, of: impl Fn(f64) -> f64) -> Vec<Point> {
    let [low, high] = axis.range.map(f64::log10);
    let load = |i: i32| 10f64.powf(low + (high - low) * f64::from(i) / 100.0);
    (0..=100).map(load).map(|p| Point::at(p, of(p))).collect()
}

/// One value from end to end of an axis.
pub fn level(axis: &Axis, value: f64) -> Vec<Point> {
    axis.range.map(|x| Point::at(x, value)).to_vec()
}
