//! The spectrum of heights as a table.

use super::Survey;
use crate::error::SurfaceError;
use crate::surface::{PowerSpectrum, Scan, SpectrumKind, SpectrumTable, Surface};
use std::f64::consts::TAU;

impl SpectrumTable {
    /// The spectrum of heights that are taken as isotropic, from the longest wave of the cell to the shortest one that the grid carries along each
    /// axis. Where the heights are periodic it has the mean of each ring of waves, see [`PowerSpectrum`]. Along an axis with a jump, see
    /// [`Surface::with_jumps_free`], there are no waves of the cell: then it has the bands of a [`Survey`], of the heights less their
    /// plane under a Hann window.
    ///
    /// # Errors
    /// [`SurfaceError::SpectrumTable`] for a flat, and [`SurfaceError::NonFinite`] for heights beyond the range of doubles.
    pub fn from_surface(surface: &Surface) -> Result<Self, SurfaceError> {
        let grid = surface.grid();
        let pairs: Vec<(f64, f64)> = if surface.with_jumps_free().grid().is_periodic() {
            let PowerSpectrum { wavenumber, density, .. } = PowerSpectrum::new(surface);
            wavenumber.into_iter().zip(density).collect()
        } else {
            let survey = Survey::new(&Scan::from_surface(surface, 1))?;
            survey.spectrum.iter().map(|band| (band.wavenumber, band.density)).collect()
        };
        let [first, last] = [grid.longest_wavelength(), grid.shortest_wavelength()].map(|wavelength| TAU / wavelength);
        let longest = pairs.first().filter(|(q, _)| *q > first * (1.0 + 1e-9)).map(|(_, density)| (first, *density));
        let pairs = longest.into_iter().chain(pairs.iter().copied().filter(|(q, _)| *q < last));
        let (wavenumber, density) = pairs.unzip();
        let kind = if grid.is_line() { SpectrumKind::Profile } else { SpectrumKind::Surface };
        Self::new(wavenumber, density, kind)
    }
}
