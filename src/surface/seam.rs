//! The seam of a period: where the last node meets the first.

use super::Surface;
use crate::chunks;

impl Surface {
    /// Jumps across the period above this many rms steps are no roughness: periodic random lines have 0.05 to 2, measured traces less
    /// their plane up to 100.
    pub const JUMP: f64 = 10.0;

    /// The jumps across the period along y and x, in rms steps: the root mean square of the differences between the
    /// last and the first nodes, divided by that of the differences between neighbours inside. About 1, or less, on a
    /// periodic surface; 0 along y of a line, along a free axis, and if all neighbours inside are equal.
    ///
    /// ```
    /// use asperity::{Grid, Surface};
    /// let grid = Grid::line(100, 1.0)?;
    /// let tilted = Surface::new(grid, ndarray::Array2::from_shape_fn((1, 100), |(_, x)| x as f64))?;
    /// assert_eq!(tilted.jumps(), [0.0, 99.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn jumps(&self) -> [f64; 2] {
        let ([ny, nx], h) = (self.grid().shape(), self.heights());
        let square = |a: usize, b: usize| (h[a] - h[b]).powi(2);
        let last_row = (ny - 1) * nx;
        let along_y = chunks::sum(last_row, |i| square(i + nx, i));
        let along_x = chunks::sum(h.len() - 1, |i| if (i + 1) % nx == 0 { 0.0 } else { square(i + 1, i) });
        let across_y = chunks::sum(nx, |x| square(x, last_row + x));
        let across_x = chunks::sum(ny, |y| square(y * nx, y * nx + nx - 1));
        let [round_y, round_x] = self.grid().periodic();
        let jump =
            |is_periodic: bool, across, inside, pairs| if is_periodic { jump(across, inside, pairs) } else { 0.0 };
        [jump(round_y, across_y, along_y, ny - 1), jump(round_x, across_x, along_x, nx - 1)]
    }

    /// The surface, free along the axes on which it jumps across the period by more than [`Surface::JUMP`]: a part of a larger one,
    /// such as a measured map.
    ///
    /// ```
    /// use asperity::{Grid, Surface};
    /// let grid = Grid::line(100, 1.0)?;
    /// let tilted = Surface::new(grid, ndarray::Array2::from_shape_fn((1, 100), |(_, x)| x as f64))?;
    /// assert!(tilted.grid().is_periodic());
    /// assert_eq!(tilted.with_jumps_free().grid().boundary(), "free");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_jumps_free(&self) -> Self {
        let (jumps, periodic) = (self.jumps(), self.grid().periodic());
        let is_periodic = [0, 1].map(|axis| periodic[axis] && jumps[axis] <= Self::JUMP);
        Self { grid: self.grid().with_periodic(is_periodic), ..self.clone() }
    }
}

/// The jump from sums of squares across the seam and inside, with `pairs` inner pairs per pair across the seam.
fn jump(across: f64, inside: f64, pairs: usize) -> f64 {
    if inside > 0.0 { (across * pairs as f64 / inside).sqrt() } else { 0.0 }
}
