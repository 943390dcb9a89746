//! The spectrum of heights as a table.

use super::{Band, Survey};
use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::surface::{PowerSpectrum, SpectrumKind, SpectrumTable, Surface};
use std::f64::consts::TAU;

impl SpectrumTable {
    /// The spectrum of heights that are taken as isotropic, from the longest wave of the cell to the shortest one that the grid carries along each
    /// axis. Surfaces that are periodic have the mean of each ring of waves, see [`PowerSpectrum`], and lines the bands of a [`Survey`]. Along an
    /// axis with a jump, see [`Surface::with_jumps_free`], there are no waves of the cell: then the bands are those of the heights less their
    /// plane under a Hann window.
    ///
    /// # Errors
    /// [`SurfaceError::SpectrumTable`] for a flat, and [`SurfaceError::NonFinite`] for heights beyond the range of doubles.
    pub fn from_surface(surface: &Surface) -> Result<Self, SurfaceError> {
        let grid = surface.grid();
        let in_bands = |bands: &[Band]| bands.iter().map(|band| (band.wavenumber, band.density)).collect();
        let is_periodic = surface.with_jumps_free().grid().is_periodic();
        let pairs: Vec<(f64, f64)> = match (is_periodic, PowerSpectrum::new(surface)) {
            (true, waves) if grid.is_line() => in_bands(&Band::all(&waves, grid)),
            (true, rings) => rings.wavenumber.into_iter().zip(rings.density).collect(),
            (false, _) => in_bands(&Survey::new(&Scan::from_surface(surface, 1))?.spectrum),
        };
        let [first, last] = [grid.longest_wavelength(), grid.shortest_wavelength()].map(|wavelength| TAU / wavelength);
        let longest = pairs.first().filter(|(q, _)| *q > first * (1.0 + 1e-9)).map(|(_, density)| (first, *density));
        let pairs = longest.into_iter().chain(pairs.iter().copied().filter(|(q, _)| *q < last));
        let (wavenumber, density) = pairs.unzip();
        let kind = if grid.is_line() { SpectrumKind::Profile } else { SpectrumKind::Surface };
        Self::new(wavenumber, density, kind)
    }
}
