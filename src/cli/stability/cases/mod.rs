//! All cases, by what is extreme about them.

mod gaps;
mod grids;
mod heights;
mod inputs;
mod loads;
mod starts;
mod units;

use super::case::Case;
use anyhow::Result;
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Problem, Surface};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// All cases, small if `quick`.
pub fn all(quick: bool) -> Vec<Case> {
    let size = if quick { Size { line: 1 << 10, side: 32 } } else { Size { line: 1 << 12, side: 128 } };
    let mut cases = Vec::new();
    cases.extend(loads::cases(size));
    cases.extend(gaps::cases(size));
    cases.extend(units::cases(size));
    cases.extend(heights::cases(size));
    cases.extend(grids::cases(quick));
    cases.extend(starts::cases(size));
    cases.extend(inputs::cases(size));
    cases
}

/// Points of lines, and along each side of surfaces.
#[derive(Clone, Copy)]
struct Size {
    line: usize,
    side: usize,
}

impl Size {
    fn line(self) -> Result<Grid> {
        Ok(Grid::line(self.line, 1.0)?)
    }

    fn surface(self) -> Result<Grid> {
        Ok(Grid::surface([self.side, self.side], [1.0, 1.0])?)
    }
}

/// Lines and surfaces.
const GRIDS: [(&str, Grids); 2] = [("line", Size::line), ("surface", Size::surface)];

type Grids = fn(Size) -> Result<Grid>;

/// A rough surface on a grid of length 1, with a roll-off at a quarter of it and a short cut-off of eight spacings.
fn rough(grid: Grid) -> Result<Surface> {
    rough_with(grid, 0.8, 8.0, 0.1)
}

/// The same with another Hurst exponent, spacings of the short cut-off, and gradient.
fn rough_with(grid: Grid, hurst: f64, spacings: f64, rms_gradient: f64) -> Result<Surface> {
    let short_cutoff = 0.5 * spacings * grid.shortest_wavelength();
    let rolloff_wavelength = (0.25 * grid.longest_wavelength()).max(1.5 * short_cutoff);
    Ok(Surface::rough(grid, &Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient }, 1)?)
}

/// Heights drawn from [0, 1), each on its own.
fn noise(grid: Grid) -> Result<Surface> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    Ok(Surface::new(grid, Field::from_shape_simple_fn(grid.shape(), || random.random::<f64>()))?)
}

/// Heights as a function of row and column.
fn shaped(grid: Grid, height: impl Fn(usize, usize) -> f64) -> Result<Surface> {
    Ok(Surface::new(grid, Field::from_shape_fn(grid.shape(), |(y, x)| height(y, x)))?)
}

/// Pressed with a modulus of 1.
fn pressed(surface: Surface, reduced_pressure: f64) -> Result<Problem> {
    Ok(Problem::at_reduced_pressure(surface, 1.0, reduced_pressure)?)
}
