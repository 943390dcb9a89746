//! A survey of measured heights.

mod band;
mod choice;
mod scales;
mod table;

pub use band::{Band, PowerLawFit};
pub use choice::PreparationChoice;
pub use scales::{Scale, Scales};

use super::{Detrend, Fill, PowerSpectrum, Scan, Surface};
use crate::error::SurfaceError;
use crate::grid::Grid;
use std::f64::consts::PI;

/// A survey of measured heights: tilt, jumps across the period, noise and resolution. They show whether a contact with
/// these heights is meaningful.
///
/// ```
/// use asperity::surface::{Scan, Survey};
/// // a tilted wave of 1024 nodes, with noise of 1e-3 that is different at each node
/// let noise = |x: usize| 1e-3 * 2f64.sqrt() * (x as f64 * x as f64 * 0.7).sin();
/// let wave = |x: usize| (std::f64::consts::TAU * x as f64 / 1024.0).sin();
/// let height = ndarray::Array2::from_shape_fn((1, 4096), |(_, x)| wave(x) + 0.5 * x as f64 + noise(x));
/// let survey = Survey::new(&Scan { height, spacing: [1.0, 1.0] })?;
/// assert!((survey.tilt[1] - 0.5).abs() < 1e-3);
/// assert!(survey.jumps[1] > 1000.0);
/// assert!((survey.axes[0].noise / 1e-3 - 1.0).abs() < 0.1);
/// # Ok::<(), asperity::error::SurfaceError>(())
/// ```
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Survey {
    /// Nodes without a height. The following fields, except those of the axes, are for heights with filled voids, see
    /// [`Fill::Harmonic`].
    pub voids: usize,
    /// Slopes along y and x of the least-squares plane.
    pub tilt: [f64; 2],
    /// The share of the mean square height about that plane which the terms of second order explain, see [`Detrend::Curvature`].
    pub curvature_share: f64,
    /// Jumps across the period along y and x in rms steps, see [`Surface::jumps`].
    pub jumps: [f64; 2],
    /// Scales, noise and resolution along y and x, of a profile along x; an axis of less than 9 nodes is left out.
    pub axes: Vec<Scales>,
    /// The power law of the power spectrum, where it has one, between its roll-off and its cut-off and above the noise.
    pub power_law: Option<PowerLawFit>,
    /// The power spectrum of the heights minus their plane, with a Hann window of mean square 1.
    pub spectrum: Vec<Band>,
}

impl Survey {
    /// The survey of some heights.
    ///
    /// # Errors
    /// [`SurfaceError::NonFinite`] for heights that are all void; [`SurfaceError::Grid`] for less nodes than a grid has.
    pub fn new(scan: &Scan) -> Result<Self, SurfaceError> {
        let full =
            if scan.voids() > 0 { Fill::Harmonic.apply(scan.clone()).unwrap_or(scan.clone()) } else { scan.clone() };
        let grid = grid(&full)?;
        let jumps = Surface::new(grid, full.height.clone())?.jumps();
        let flat = Detrend::Plane.apply(full.clone());
        let [total, rest] = [square(&flat), square(&Detrend::Curvature.apply(full.clone()))];
        let plane = Detrend::Plane.apply(scan.clone());
        let axes: Vec<Scales> = (0..2).filter_map(|axis| Scales::new(&plane, axis)).collect();
        let spectrum = Band::all(&PowerSpectrum::new(&Surface::new(grid, windowed(&flat).height)?), &grid);
        let rough = |it: &Scales| it.shortest_wavelength.max(it.smooth_wavelength.unwrap_or(0.0));
        let shortest = axes.iter().map(rough).fold(grid.shortest_wavelength(), f64::max);
        Ok(Self {
            voids: scan.voids(),
            tilt: Detrend::tilt(&full),
            curvature_share: if total > 0.0 { 1.0 - rest / total } else { 0.0 },
            jumps,
            power_law: PowerLawFit::new(&spectrum, grid.is_line(), shortest),
            axes,
            spectrum,
        })
    }

    /// The largest share of noise along any axis.
    pub fn noise_share(&self) -> f64 {
        self.axes.iter().map(|it| it.noise_share).fold(0.0, f64::max)
    }

    /// The shortest wavelength above the noise along all axes; 0 if no axis is long enough.
    pub fn shortest_wavelength(&self) -> f64 {
        self.axes.iter().map(|it| it.shortest_wavelength).fold(0.0, f64::max)
    }

    /// The ratio of the rms gradient at the spacing to that at twice the spacing, the largest of all axes: about 1 if
    /// the gradient is resolved, and larger if it still grows with finer spacing.
    pub fn gradient_growth(&self) -> f64 {
        let growth = |it: &Scales| it.scales[0].rms_gradient / it.scales[1].rms_gradient;
        self.axes.iter().map(growth).filter(|it| it.is_finite()).fold(0.0, f64::max)
    }
}

/// The grid under heights.
fn grid(scan: &Scan) -> Result<Grid, SurfaceError> {
    let ([ny, nx], [dy, dx]) = (scan.shape(), scan.spacing);
    let made = if ny == 1 {
        Grid::line(nx, nx as f64 * dx)
    } else {
        Grid::surface([ny, nx], [ny as f64 * dy, nx as f64 * dx])
    };
    Ok(made?)
}

/// The mean square of heights without voids.
fn square(scan: &Scan) -> f64 {
    scan.height.iter().map(|h| h * h).sum::<f64>() / scan.height.len() as f64
}

/// Heights times a Hann window of mean square 1 along each axis.
fn windowed(scan: &Scan) -> Scan {
    let window = |n: usize| -> Vec<f64> {
        let at = |i: usize| (8.0f64 / 3.0).sqrt() * (PI * (i as f64 + 0.5) / n as f64).sin().powi(2);
        if n == 1 { vec![1.0] } else { (0..n).map(at).collect() }
    };
    let [y, x] = scan.shape().map(window);
    let mut scan = scan.clone();
    scan.height.indexed_iter_mut().for_each(|((row, column), h)| *h *= y[row] * x[column]);
    scan
}
