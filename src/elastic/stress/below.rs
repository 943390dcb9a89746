//! The stress below a pressure, on any grid for which it can be computed.

use super::{Stress, under_row, under_strips};
use crate::elastic::ElasticSolid;
use crate::error::SolidError;
use crate::grid::Grid;

/// Whether the stress inside a solid can be computed: in a half-space, below a line, or below a periodic surface.
pub fn is_known(grid: &Grid, solid: &dyn ElasticSolid) -> bool {
    solid.is_half_space() && (grid.is_periodic() || grid.is_line())
}

/// The stress in a half-space below row `row` of a pressure, by [`under_strips`] below a line without images, and else
/// by [`under_row`].
///
/// # Errors
/// [`SolidError::Poisson`] for a ratio outside `(-1, 1/2]`, and [`SolidError::NoStress`] below a surface with a free boundary.
///
/// # Panics
/// If the length of `pressure` does not fit the grid, or for a row that it does not have.
pub fn below(grid: &Grid, pressure: &[f64], row: usize, poisson: f64, depth: &[f64]) -> Result<Stress, SolidError> {
    match (grid.is_periodic(), grid.is_line()) {
        (true, _) => under_row(grid, pressure, row, poisson, depth),
        (false, true) => under_strips(pressure, grid.spacing()[1], poisson, depth),
        (false, false) => Err(SolidError::NoStress),
    }
}
