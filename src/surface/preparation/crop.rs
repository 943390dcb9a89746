//! A part of a map.

use super::Scan;
use ndarray::Slice;
use serde::{Deserialize, Serialize};

/// The rows and columns to keep, counted from 0: `[first, last + 1]` for a profile; for a map, first for the rows and
/// then for the columns.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Crop(pub Vec<usize>);

impl Crop {
    /// First and one beyond last of rows and columns; none for ranges that are empty or beyond the map.
    pub(super) fn ranges(&self, shape: [usize; 2]) -> Option<[[usize; 2]; 2]> {
        let ranges = match *self.0 {
            [first, beyond] if shape[0] == 1 => [[0, 1], [first, beyond]],
            [top, bottom, left, right] => [[top, bottom], [left, right]],
            _ => return None,
        };
        let is_in = |([first, beyond], n): ([usize; 2], usize)| first < beyond && beyond <= n;
        ranges.into_iter().zip(shape).all(is_in).then_some(ranges)
    }

    /// The part of the heights.
    pub fn apply(&self, scan: &Scan) -> Option<Scan> {
        let ranges = self.ranges(scan.shape())?;
        let slice = |axis: ndarray::AxisDescription| {
            let [first, beyond] = ranges[axis.axis.index()];
            Slice::from(first..beyond)
        };
        Some(Scan { height: scan.height.slice_each_axis(slice).to_owned(), ..*scan })
    }
}
