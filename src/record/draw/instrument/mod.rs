//! Pictures of a whole run, step by step.

mod energy;
mod flip_map;
mod lanes;
mod raster;
mod step_image;
mod waterfall;

use super::drawing::{Bytes, PartRow};
use super::ink::reduce::pixels;
use crate::grid::Grid;
use crate::setup::Part;

/// The parts of this group, in the order of their panes.
pub(crate) const PARTS: &[PartRow] = &[
    PartRow { part: Part::Raster, draw: raster::draw, bytes: bytes_of_rasters },
    PartRow { part: Part::Decisions, draw: lanes::draw, bytes: |_| Bytes::default() },
    PartRow { part: Part::Waterfall, draw: waterfall::draw, bytes: |grid| Bytes::per_run(2.0 * bytes_of_bands(grid)) },
    PartRow { part: Part::Energy, draw: energy::draw, bytes: |grid| Bytes::per_run(bytes_of_bands(grid)) },
];

fn bytes_of_rasters(grid: &Grid) -> Bytes {
    Bytes::per_run(if grid.is_line() { 100e3 } else { 200e3 + 4.0 * pixels(grid) as f64 })
}

/// Bytes of an image with a row for each half octave of the waves of a grid.
fn bytes_of_bands(grid: &Grid) -> f64 {
    6e3 * 2.0 * (grid.len() as f64).log2()
}
