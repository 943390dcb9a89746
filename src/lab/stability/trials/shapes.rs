//! The grids and surfaces that trials share.

use crate::contact::{ContactModulus, Load, Problem};
use crate::error::{GridError, SetupError, SurfaceError};
use crate::grid::Grid;
use crate::setup::{Cell, Recipe, Setup};
use crate::surface::{Field, Spectrum, Surface};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// The load of most trials.
pub const LOAD: Load = Load::ReducedPressure(0.05);
/// Mean pressure over the modulus, where that is varied.
pub const STRAIN: f64 = 0.01;

/// The line and the surface of most trials, of length 1.
#[derive(Clone, Copy)]
pub struct Grids {
    pub line: Grid,
    pub surface: Grid,
}

impl Grids {
    pub fn new(is_quick: bool) -> Result<Self, GridError> {
        let [points, side] = if is_quick { [1 << 10, 32] } else { [1 << 12, 128] };
        Ok(Self { line: Grid::line(points, 1.0)?, surface: Grid::surface([side; 2], [1.0; 2])? })
    }

    /// Both grids with their names.
    pub fn named(self) -> [(&'static str, Grid); 2] {
        [("line", self.line), ("surface", self.surface)]
    }
}

/// A surface on a grid, under a load, with a modulus of 1.
pub fn setup(recipe: Recipe, grid: Grid, load: Load) -> Setup {
    let ([ny, nx], size) = (grid.shape(), grid.size());
    let cell = if grid.is_line() { Cell::line(nx, size[1]) } else { Cell::surface([ny, nx], size) };
    Setup::new(recipe, cell, load)
}

/// The problem of a surface with a modulus of 1.
pub fn pressed(surface: Surface, load: Load) -> Result<Problem, SetupError> {
    Ok(Problem::new(surface, ContactModulus(1.0), load)?)
}

/// Roughness on a grid of length 1, with a roll-off at a quarter of it and a short cut-off of eight spacings.
pub fn rough(grid: Grid) -> Recipe {
    rough_with(grid, 0.8, 8.0, 0.1)
}

/// Roughness of another Hurst exponent, spacings of the short cut-off, and gradient.
pub fn rough_with(grid: Grid, hurst: f64, spacings: f64, rms_gradient: f64) -> Recipe {
    let short_cutoff = 0.5 * spacings * grid.shortest_wavelength();
    let rolloff_wavelength = (0.25 * grid.longest_wavelength()).max(1.5 * short_cutoff);
    Recipe::rough(Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient }, 1)
}

/// Heights drawn from [0, 1), each on its own.
pub fn noise(grid: Grid) -> Result<Surface, SurfaceError> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    Surface::new(grid, Field::from_shape_simple_fn(grid.shape(), || random.random::<f64>()))
}

/// Heights as a function of row and column.
pub fn shaped(grid: Grid, height: impl Fn(usize, usize) -> f64) -> Result<Surface, SurfaceError> {
    Surface::new(grid, Field::from_shape_fn(grid.shape(), |(y, x)| height(y, x)))
}
