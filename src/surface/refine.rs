//! Heights on a finer grid.

use super::{Field, Surface};
use crate::error::SurfaceError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use ndarray::Slice;

impl Surface {
    /// The surface on a grid of `factor` times as many points along each side: the heights are interpolated by their
    /// Fourier series, so that existing nodes keep their heights. Jumps, also those across the period, cause
    /// oscillations. At a free rim the heights are mirrored, so that there is no jump.
    ///
    /// # Errors
    /// The errors of [`Grid::line`] for more points than a grid can have.
    ///
    /// ```
    /// use asperity::{Grid, Indenter};
    /// let wave = |points| Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    /// let difference = wave(10).refined(3)?.heights_as_given() - wave(30).heights_as_given();
    /// assert!(difference.iter().all(|difference| difference.abs() < 1e-14));
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn refined(&self, factor: usize) -> Result<Self, SurfaceError> {
        let grid = self.grid.refined(factor)?;
        if factor == 1 {
            return Ok(self.clone());
        }
        let (plateaus, filled) = (self.plateaus_on(factor), self.filled_on(factor));
        if !grid.is_periodic() {
            let fine = self.mirrored()?.refined(factor)?.heights_as_given();
            let half = fine.slice_each_axis(|axis| Slice::from(..grid.shape()[axis.axis.index()])).to_owned();
            return Ok(Self { seed: self.seed, plateaus, filled, ..Self::new(grid, half)? });
        }
        let mut modes = vec![Complex::default(); self.grid.modes()];
        Fourier::new(&self.grid).forward(self.heights(), &mut modes);
        let mut modes = padded(&self.grid, &grid, &modes);
        let mut height = Field::zeros(grid.shape());
        Fourier::new(&grid).inverse(&mut modes, height.as_slice_mut().expect("standard layout by construction"));
        Ok(Self { seed: self.seed, plateaus, filled, ..Self::new(grid, height + self.mean_height)? })
    }
}

impl Surface {
    /// The periodic surface of which this one is a half along each free axis, mirrored at its first and last nodes.
    fn mirrored(&self) -> Result<Self, SurfaceError> {
        let (shape, spacing, periodic) = (self.grid.shape(), self.grid.spacing(), self.grid.periodic());
        let points = [0, 1].map(|axis| if periodic[axis] { shape[axis] } else { 2 * shape[axis] - 2 });
        let size = [0, 1].map(|axis| points[axis] as f64 * spacing[axis]);
        let grid = if self.grid.is_line() { Grid::line(points[1], size[1]) } else { Grid::surface(points, size) }?;
        let back = |i: usize, axis: usize| i.min(points[axis] - i);
        let at = |(y, x): (usize, usize)| {
            let [y, x] = [(y, 0), (x, 1)].map(|(i, axis)| if periodic[axis] { i } else { back(i, axis) });
            self.height[[y, x]] + self.mean_height
        };
        Self::new(grid, Field::from_shape_fn(points, at))
    }
}

/// The Fourier coefficients of `from` in the order of `to`; those of the shortest waves of an even number of points
/// represent two waves of opposite direction each.
fn padded(from: &Grid, to: &Grid, modes: &[Complex]) -> Vec<Complex> {
    let ([ny, nx], [fine_ny, _]) = (from.shape(), to.shape());
    let mut padded = vec![Complex::default(); to.modes()];
    for kx in 0..=nx / 2 {
        let of_x = if 2 * kx == nx { 0.5 } else { 1.0 };
        for ky in 0..ny {
            let mode = modes[kx * ny + ky] * of_x;
            let mut add = |ky: usize, share: f64| padded[kx * fine_ny + ky] += mode * share;
            if ny == 1 || 2 * ky < ny {
                add(ky, 1.0);
            } else if 2 * ky == ny {
                add(ky, 0.5);
                add(fine_ny - ky, 0.5);
            } else {
                add(fine_ny - (ny - ky), 1.0);
            }
        }
    }
    padded
}
