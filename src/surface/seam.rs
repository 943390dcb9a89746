//! The seam of a period: where the last node meets the first.

use super::Surface;
use crate::chunks;

impl Surface {
    /// The jumps across the period along y and x, in rms steps: the root mean square of the differences between the last nodes and
    /// the first ones, over that of the differences between neighbours inside. About 1, or less, on a periodic surface; 0 along
    /// the y of a line, and where all neighbours inside are equal.
    ///
    /// ```
    /// use asperity::{Grid, Surface};
    /// let grid = Grid::line(100, 1.0)?;
    /// let tilted = Surface::new(grid, ndarray::Array2::from_shape_fn((1, 100), |(_, x)| x as f64))?;
    /// assert_eq!(tilted.jumps(), [0.0, 99.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn jumps(&self) -> [f64; 2] {
        let [ny, nx] = self.grid().shape();
        let h = self.heights();
        let along_y = jump(ny, nx, |row, column| h[row * nx + column]);
        let along_x = jump(nx, ny, |column, row| h[row * nx + column]);
        [along_y, along_x]
    }
}

/// The jump of heights `h(i, lane)` across the seam of `nodes` nodes in each of so many lanes.
fn jump(nodes: usize, lanes: usize, h: impl Fn(usize, usize) -> f64 + Sync) -> f64 {
    let mean_square = |pairs: usize, pair: &(dyn Fn(usize, usize) -> f64 + Sync)| {
        chunks::sum(pairs * lanes, |i| pair(i / lanes, i % lanes).powi(2)) / (pairs * lanes) as f64
    };
    if nodes < 2 {
        return 0.0;
    }
    let inside = mean_square(nodes - 1, &|i, lane| h(i + 1, lane) - h(i, lane));
    let seam = mean_square(1, &|_, lane| h(0, lane) - h(nodes - 1, lane));
    if inside > 0.0 { (seam / inside).sqrt() } else { 0.0 }
}
