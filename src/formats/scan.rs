//! Heights between a file and a surface.

use ndarray::Array2;

/// Heights on an even grid, some of which may be void.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// Heights, shape `(ny, nx)`, a line one row; NaN where there is none.
    pub height: Array2<f64>,
    /// Distances of neighbours along y and x.
    pub spacing: [f64; 2],
}

impl Scan {
    /// The number of voids.
    pub fn voids(&self) -> usize {
        self.height.iter().filter(|h| h.is_nan()).count()
    }

    /// Rows and columns.
    pub fn shape(&self) -> [usize; 2] {
        self.height.dim().into()
    }
}

/// The lowest and the highest of some heights, if the sum of the squares of their differences may overflow.
pub(crate) fn overflowing(heights: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let none = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
    let (least, most, count) = heights.fold(none, |(least, most, n), h| (least.min(h), most.max(h), n + 1.0));
    (count > 0.0 && !((most - least).powi(2) * count).is_finite()).then_some([least, most])
}
