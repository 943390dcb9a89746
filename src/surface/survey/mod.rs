//! A survey of measured heights.

mod artefact;
mod artefacts;
mod band;
mod choice;
mod clip;
mod interpolated;
mod jump;
mod noise;
mod repeat;
mod scales;
mod seam;
mod shift;
mod table;
mod tip;
mod waves;

pub use artefact::Artefact;
pub use artefacts::Artefacts;
pub use band::{Band, PowerLawFit};
pub use choice::PreparationChoice;
pub use noise::Noise;
pub use repeat::RepeatNoise;
pub use scales::{Scale, Scales};
pub use tip::TipReach;

use super::{Detrend, Fill, Surface};
use crate::error::SurfaceError;
use crate::formats::Scan;

/// A survey of measured heights: tilt, jumps across the period, noise and resolution. They show whether a contact with
/// these heights is meaningful.
///
/// ```
/// use asperity::formats::Scan;
/// use asperity::surface::Survey;
/// // a tilted wave of 1024 nodes, with noise of 1e-3 that is different at each node
/// let noise = |x: usize| 1e-3 * 2f64.sqrt() * (x as f64 * x as f64 * 0.7).sin();
/// let wave = |x: usize| (std::f64::consts::TAU * x as f64 / 1024.0).sin();
/// let height = ndarray::Array2::from_shape_fn((1, 4096), |(_, x)| wave(x) + 0.5 * x as f64 + noise(x));
/// let survey = Survey::new(&Scan { height, spacing: [1.0, 1.0] })?;
/// assert!((survey.tilt[1] - 0.5).abs() < 1e-3);
/// assert!(survey.jumps[1] > 1000.0);
/// assert!((survey.noise.rms / 1e-3 - 1.0).abs() < 0.1);
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
    /// Whether the heights end along y and x, so that they are not periodic, see [`Surface::ends`].
    pub ends: [bool; 2],
    /// Artefacts. Scales, noise and spectrum are those of the heights without the ones that can be mended.
    pub artefacts: Vec<Artefact>,
    /// The largest relative error of areas that the artefacts which can be mended may cause, see [`Artefacts`].
    pub area_error: f64,
    /// Scales, noise and resolution along y and x, of a profile along x; an axis of less than 9 nodes is left out.
    pub axes: Vec<Scales>,
    /// Noise that is the same along all axes.
    pub noise: Noise,
    /// The power law of the power spectrum, where it has one, between its roll-off and its cut-off and above the noise.
    pub power_law: Option<PowerLawFit>,
    /// The power spectrum of the heights minus their plane, with a Hann window of mean square 1.
    pub spectrum: Vec<Band>,
    /// The artefacts with what mends them, of which `artefacts` and `area_error` are a part.
    #[serde(skip)]
    pub(crate) found: Artefacts,
}

impl Survey {
    /// The survey of some heights.
    ///
    /// # Errors
    /// [`SurfaceError::NonFinite`] for heights that are all void; [`SurfaceError::Grid`] for less nodes than a grid has.
    pub fn new(scan: &Scan) -> Result<Self, SurfaceError> {
        Self::without(Artefacts::new(scan), scan)
    }

    /// The survey of some heights whose artefacts are known.
    pub(super) fn without(artefacts: Artefacts, raw: &Scan) -> Result<Self, SurfaceError> {
        let scan = &artefacts.rest;
        let full =
            if scan.voids() > 0 { Fill::Harmonic.apply(scan.clone()).unwrap_or(scan.clone()) } else { scan.clone() };
        let grid = full.grid()?;
        let surface = Surface::new(grid, full.height.clone())?;
        let (jumps, ends) = (surface.jumps(), surface.ends());
        let flat = Detrend::Plane.apply(full.clone());
        let [total, rest] = [square(&flat), square(&Detrend::Curvature.apply(full.clone()))];
        let plane = Detrend::Plane.apply(scan.clone());
        let axes: Vec<Scales> = (0..2).filter_map(|axis| Scales::new(&plane, axis)).collect();
        let spectrum = Band::of_flat(&flat)?;
        let rough = |it: &Scales| it.shortest_wavelength.max(it.smooth_wavelength.unwrap_or(0.0));
        let shortest = axes.iter().map(rough).fold(grid.shortest_wavelength(), f64::max);
        Ok(Self {
            voids: raw.voids(),
            artefacts: artefacts.all.clone(),
            area_error: artefacts.area_error,
            noise: Noise::new(&axes, &spectrum, &flat),
            tilt: Detrend::tilt(&full),
            curvature_share: if total > 0.0 { 1.0 - rest / total } else { 0.0 },
            jumps,
            ends,
            power_law: PowerLawFit::new(&spectrum, grid.is_line(), shortest),
            axes,
            spectrum,
            found: artefacts,
        })
    }

    /// The ratio of the rms gradient at the spacing to that at twice the spacing, along all axes together: about 1 if the gradient is resolved,
    /// and larger if it still grows with finer spacing.
    pub fn gradient_growth(&self) -> f64 {
        let square = |i: usize| self.axes.iter().map(|it| it.scales[i].rms_gradient.powi(2)).sum::<f64>();
        let growth = (square(0) / square(1)).sqrt();
        if growth.is_finite() { growth } else { 0.0 }
    }
}

/// The mean square of heights without voids.
fn square(scan: &Scan) -> f64 {
    scan.height.iter().map(|h| h * h).sum::<f64>() / scan.height.len() as f64
}
