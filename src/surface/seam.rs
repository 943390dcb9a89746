//! The seam of a period: where the last node meets the first.

use super::Surface;
use crate::chunks;

/// The largest jumps, in rms steps, of a line and of a surface that is periodic.
const MOST_OF_LINE: f64 = 3.0;
const MOST_OF_SURFACE: f64 = 2.0;
/// Jumps are larger than the steps inside by this factor, where they are not the same edges.
const LARGER: f64 = 1.1;
/// The number of pairs of lines that may differ more than those across the period do.
const ABOVE: usize = 3;

impl Surface {
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

    /// Whether the heights end along y and x, as a part of a larger surface does: whether they jump across the period by more than neighbours
    /// differ inside. The one step of a line is to be above three rms steps, as a large one may come by chance. The rms of those of a surface
    /// is to be above two rms steps, and above those between all but three pairs of neighbouring lines, such as the edges of a grating.
    ///
    /// Periodic random lines jump by 0.05 to 2.5 rms steps, periodic surfaces by about 1, and a sphere in its cell by 1.7.
    ///
    /// ```
    /// use asperity::{Grid, Surface};
    /// let surface = |of: fn(f64) -> f64| {
    ///     let height = ndarray::Array2::from_shape_fn((8, 64), |(_, x)| of(x as f64 / 64.0));
    ///     Surface::new(Grid::surface([8, 64], [1.0, 8.0]).unwrap(), height).unwrap()
    /// };
    /// assert_eq!(surface(|x| x).ends(), [false, true]);
    /// assert_eq!(surface(|x| (4.0 * x).fract().round()).ends(), [false, false]);
    /// ```
    pub fn ends(&self) -> [bool; 2] {
        let (jumps, is_line) = (self.jumps(), self.grid().is_line());
        [0, 1].map(|axis| match is_line {
            true => jumps[axis] > MOST_OF_LINE,
            false => jumps[axis] > MOST_OF_SURFACE && jumps[axis] > LARGER * self.large_step(axis),
        })
    }

    /// The root mean square of the differences between two neighbouring lines across an axis, in rms steps: of the pair that has only three
    /// above it.
    fn large_step(&self, axis: usize) -> f64 {
        let lines = self.height.axis_windows(ndarray::Axis(axis), 2);
        let square = |pair: ndarray::ArrayView2<'_, f64>| {
            let [one, next] = [0, 1].map(|i| pair.index_axis(ndarray::Axis(axis), i));
            one.iter().zip(next).map(|(a, b)| (b - a) * (b - a)).sum::<f64>()
        };
        let mut squares: Vec<f64> = lines.into_iter().map(square).collect();
        let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        squares.sort_unstable_by(|a, b| b.total_cmp(a));
        squares.get(ABOVE).map_or(0.0, |it| (it / mean).sqrt())
    }

    /// The surface, free along the axes on which its heights end, see [`Surface::ends`]: a part of a larger one, such as a measured map.
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
        let (ends, periodic) = (self.ends(), self.grid().periodic());
        let is_periodic = [0, 1].map(|axis| periodic[axis] && !ends[axis]);
        Self { grid: self.grid().with_periodic(is_periodic), ..self.clone() }
    }
}

/// The jump from sums of squares across the seam and inside, with `pairs` inner pairs per pair across the seam.
fn jump(across: f64, inside: f64, pairs: usize) -> f64 {
    if inside > 0.0 { (across * pairs as f64 / inside).sqrt() } else { 0.0 }
}
