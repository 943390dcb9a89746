//! The power spectrum of heights in bands, and its power law.

use crate::surface::PowerSpectrum;
use std::f64::consts::TAU;

/// Bands per octave, in which densities are averaged.
const BANDS: f64 = 4.0;
/// The longest wavelength of a fit, over the length of the surface: longer ones are too few.
const LONGEST: f64 = 0.25;

/// The waves in a quarter of an octave.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Band {
    /// The geometric mean of their wavenumbers, 1/length.
    pub wavenumber: f64,
    /// The mean of their densities, see [`PowerSpectrum`].
    pub density: f64,
}

/// A power law `C(q) ~ q^exponent`, fitted to the bands of a spectrum between two wavelengths.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PowerLaw {
    /// The exponent.
    pub exponent: f64,
    /// The Hurst exponent that follows from it, `-(1 + exponent) / 2` of a line and `-1 - exponent / 2` of a surface; below 0 or above 1 the
    /// heights are not self-affine.
    pub hurst: f64,
    /// The shortest and the longest wavelength of the fit.
    pub wavelengths: [f64; 2],
}

impl Band {
    /// The bands of a spectrum, from the longest waves on; those without a wave are left out.
    pub(super) fn all(spectrum: &PowerSpectrum) -> Vec<Self> {
        let number = |q: f64| (BANDS * q.log2()).floor();
        let waves: Vec<(f64, f64)> =
            spectrum.wavenumber.iter().copied().zip(spectrum.density.iter().copied()).collect();
        let bands = waves.chunk_by(|one, next| number(one.0) == number(next.0));
        bands.map(Self::of).collect()
    }

    fn of(waves: &[(f64, f64)]) -> Self {
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| waves.iter().map(of).sum::<f64>() / waves.len() as f64;
        Self { wavenumber: mean(&|wave| wave.0.ln()).exp(), density: mean(&|wave| wave.1) }
    }

    /// Its wavelength.
    pub fn wavelength(&self) -> f64 {
        TAU / self.wavenumber
    }
}

impl PowerLaw {
    /// The power law of the bands of heights of some length, down to a wavelength; none where less than an octave is left.
    pub(super) fn of(bands: &[Band], is_line: bool, length: f64, shortest: f64) -> Option<Self> {
        let longest = LONGEST * length;
        let is_inside = |band: &&Band| band.density > 0.0 && (shortest..=longest).contains(&band.wavelength());
        let logarithms = |band: &Band| [band.wavenumber.ln(), band.density.ln()];
        let points: Vec<[f64; 2]> = bands.iter().filter(is_inside).map(logarithms).collect();
        let exponent = slope(&points).filter(|_| longest >= 2.0 * shortest)?;
        let hurst = if is_line { -0.5 * (1.0 + exponent) } else { -1.0 - 0.5 * exponent };
        Some(Self { exponent, hurst, wavelengths: [shortest, longest] })
    }
}

/// The slope of the straight line of least squares; none for less than three points.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |i: usize| points.iter().map(|it| it[i]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let across = points.iter().map(|it| (it[0] - x) * (it[1] - y)).sum::<f64>();
    let along = points.iter().map(|it| (it[0] - x).powi(2)).sum::<f64>();
    (points.len() >= 3).then(|| across / along)
}
