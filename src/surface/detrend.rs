//! Heights without their trend.

use super::Field;
use ndarray::Axis;
use serde::{Deserialize, Serialize};

/// The trend to take off measured heights.
///
/// ```
/// use asperity::surface::Detrend;
/// let tilted = ndarray::Array2::from_shape_fn((4, 6), |(y, x)| 7.0 + 0.5 * y as f64 - 0.25 * x as f64);
/// assert!(Detrend::Plane.of(tilted.clone()).iter().all(|h| h.abs() < 1e-14));
/// assert!(Detrend::Mean.of(tilted).sum().abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Detrend {
    /// The mean height.
    Mean,
    /// The plane of least squares, of a line the straight line.
    Plane,
}

impl Detrend {
    /// The trends by their names in scenes, in a few words.
    pub const TRENDS: [(&str, &str); 2] = [
        ("mean", "The mean height, which no contact depends on"),
        ("plane", "The plane of least squares; of a line the straight line"),
    ];

    /// The heights without their trend.
    pub fn of(self, mut height: Field) -> Field {
        let mean = height.mean().unwrap_or(0.0);
        height -= mean;
        if self == Self::Plane {
            let slopes = [Axis(0), Axis(1)].map(|axis| slope(&height, axis));
            let [y, x] = [0, 1].map(|axis| middle(height.len_of(Axis(axis))));
            height.indexed_iter_mut().for_each(|((row, column), h)| {
                *h -= slopes[0] * (row as f64 - y) + slopes[1] * (column as f64 - x);
            });
        }
        height
    }
}

/// The place of the middle among so many nodes.
fn middle(nodes: usize) -> f64 {
    0.5 * (nodes as f64 - 1.0)
}

/// The slope of least squares along an axis, a height per spacing; 0 along an axis of a single node. On a grid the slopes along
/// both axes do not depend on one another.
fn slope(height: &Field, axis: Axis) -> f64 {
    let (nodes, across) = (height.len_of(axis), height.len() / height.len_of(axis));
    let place = |i: usize| i as f64 - middle(nodes);
    let moment: f64 = height.axis_iter(axis).enumerate().map(|(i, lane)| place(i) * lane.sum()).sum();
    let squares: f64 = (0..nodes).map(|i| place(i).powi(2)).sum();
    if squares > 0.0 { moment / (squares * across as f64) } else { 0.0 }
}
