//! Rigid surfaces: heights on a grid, peaks towards the solid positive.

mod files;
mod indenter;
mod roughness;
mod spectrum;
mod synthesis;

pub use files::{check_target, read_heights, write_beside, write_heights};
pub use indenter::Indenter;
pub(crate) use indenter::{offsets, shortest_period};
pub use roughness::{PowerSpectrum, Roughness, square_gradients};
pub use spectrum::Spectrum;

use crate::error::SurfaceError;
use crate::grid::Grid;
use ndarray::{Array2, ArrayView1};

/// Values on a grid, shape `(ny, nx)`, row by row.
pub type Field = Array2<f64>;

/// The height profile of a rigid surface. Peaks that point at the solid are positive.
///
/// | field    | shape      | unit   |
/// |----------|------------|--------|
/// | `height` | `(ny, nx)` | length |
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    grid: Grid,
    height: Field,
    seed: Option<u64>,
}

impl Surface {
    /// A surface of given heights.
    ///
    /// # Errors
    /// [`SurfaceError::Shape`] if the array does not fit the grid, [`SurfaceError::NonFinite`] for a NaN or infinity.
    pub fn new(grid: Grid, height: Field) -> Result<Self, SurfaceError> {
        if height.shape() != grid.shape() {
            return Err(SurfaceError::Shape { found: height.shape().to_vec(), expected: grid.shape() });
        }
        if let Some(((row, column), &value)) = height.indexed_iter().find(|(_, h)| !h.is_finite()) {
            return Err(SurfaceError::NonFinite { index: [row, column], value });
        }
        let height = height.as_standard_layout().into_owned();
        Ok(Self { grid, height, seed: None })
    }

    /// A line of given heights and period.
    ///
    /// # Errors
    /// As [`Surface::new`] and [`Grid::line`].
    pub fn line(height: ArrayView1<f64>, length: f64) -> Result<Self, SurfaceError> {
        let grid = Grid::line(height.len(), length)?;
        Self::new(grid, height.to_owned().insert_axis(ndarray::Axis(0)))
    }

    fn with_seed(mut self, seed: u64) -> Self {
        self.seed = Some(seed);
        self
    }

    /// The grid under the heights.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The heights.
    pub fn height(&self) -> &Field {
        &self.height
    }

    /// The heights, row by row.
    pub fn heights(&self) -> &[f64] {
        self.height.as_slice().expect("standard layout by construction")
    }

    /// The seed of a random surface.
    pub fn seed(&self) -> Option<u64> {
        self.seed
    }
}
