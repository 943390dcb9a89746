//! The surfaces of trials.

use crate::error::SetupError;
use crate::grid::Grid;
use crate::surface::{Field, Spectrum, Surface};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// A surface, or why it cannot be made.
pub(crate) type SurfaceResult = Result<Surface, SetupError>;

/// A function that makes a surface on a grid.
pub(crate) type SurfaceMaker = fn(Grid) -> SurfaceResult;

/// Roughness on a grid of length 1, with a roll-off at a quarter of it and a short cut-off of eight spacings.
pub(crate) fn rough(grid: Grid) -> SurfaceResult {
    rough_with(grid, 0.8, 8.0, 0.1)
}

/// Roughness of another Hurst exponent, spacings of the short cut-off, and gradient.
pub(crate) fn rough_with(grid: Grid, hurst: f64, spacings: f64, rms_gradient: f64) -> SurfaceResult {
    let short_cutoff = 0.5 * spacings * grid.shortest_wavelength();
    let rolloff_wavelength = (0.25 * grid.longest_wavelength()).max(1.5 * short_cutoff);
    Ok(Surface::rough(grid, &Spectrum { hurst, rolloff_wavelength, short_cutoff, rms_gradient }, 1)?)
}

/// Heights drawn from [0, 1), each on its own.
pub(crate) fn noise(grid: Grid) -> SurfaceResult {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    Ok(Surface::new(grid, Field::from_shape_simple_fn(grid.shape(), || random.random::<f64>()))?)
}

/// Heights as a function of row and column.
pub(crate) fn shaped(grid: Grid, height: impl Fn(usize, usize) -> f64) -> SurfaceResult {
    Ok(Surface::new(grid, Field::from_shape_fn(grid.shape(), |(y, x)| height(y, x)))?)
}

/// Flat, except for one node.
pub(crate) fn spike(grid: Grid, node: [usize; 2]) -> SurfaceResult {
    shaped(grid, |y, x| if [y, x] == node { 1.0 } else { 0.0 })
}

/// Roughness on an offset of a billion rms heights.
pub(crate) fn offset(grid: Grid) -> SurfaceResult {
    let surface = rough(grid)?;
    let rms = (surface.heights().iter().map(|h| h * h).sum::<f64>() / grid.len() as f64).sqrt();
    Ok(Surface::new(grid, surface.height() + 1e9 * rms)?)
}

/// Roughness whose heights are rounded to few values.
pub(crate) fn plateaus(grid: Grid) -> SurfaceResult {
    let surface = rough(grid)?;
    let highest = surface.heights().iter().fold(0.0, |highest: f64, h| highest.max(h.abs()));
    Ok(Surface::new(grid, surface.height().mapv(|h| (4.0 * h / highest).round()))?)
}

/// Two equal peaks, half a period apart, each a parabola.
pub(crate) fn two_peaks(grid: Grid) -> SurfaceResult {
    let [ny, nx] = grid.shape();
    let half = nx / 2;
    shaped(grid, |y, x| {
        let (x, y) = ((x % half) as f64 / half as f64 - 0.5, y as f64 / ny as f64 - 0.5);
        -x * x - if ny > 1 { y * y } else { 0.0 }
    })
}
