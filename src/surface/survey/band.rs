//! The power law of a spectrum.

use crate::surface::PowerSpectrum;
use std::f64::consts::TAU;

/// Bins per octave in which densities are averaged before a power law is fitted, so that all wavelengths count alike.
const BINS: f64 = 4.0;
/// The longest wavelength of a fit, over the length of the surface: longer ones are too few.
const LONGEST: f64 = 0.25;

/// A power law `C(q) ~ q^exponent`, fitted to a spectrum between two wavelengths.
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

impl PowerLaw {
    /// The power law of the waves of heights of some length, down to a wavelength; none where less than an octave is left.
    pub(super) fn of(spectrum: &PowerSpectrum, is_line: bool, length: f64, shortest: f64) -> Option<Self> {
        let longest = LONGEST * length;
        let bin = |q: f64| (BINS * (q * longest / TAU).log2()).floor();
        let waves = spectrum.wavenumber.iter().zip(&spectrum.density);
        let inside = waves.filter(|(q, density)| **density > 0.0 && (shortest..=longest).contains(&(TAU / **q)));
        let mut bins: Vec<Bin> = Vec::new();
        for (&q, density) in inside {
            match bins.last_mut().filter(|it| it.number == bin(q)) {
                Some(last) => last.take(q, *density),
                None => bins.push(Bin { number: bin(q), waves: 1.0, log_q: q.ln(), density: *density }),
            }
        }
        let exponent = slope(&bins.iter().map(Bin::point).collect::<Vec<_>>()).filter(|_| longest >= 2.0 * shortest)?;
        let hurst = if is_line { -0.5 * (1.0 + exponent) } else { -1.0 - 0.5 * exponent };
        Some(Self { exponent, hurst, wavelengths: [shortest, longest] })
    }
}

/// Sums over the waves of a bin.
struct Bin {
    number: f64,
    waves: f64,
    log_q: f64,
    density: f64,
}

impl Bin {
    fn take(&mut self, q: f64, density: f64) {
        self.waves += 1.0;
        self.log_q += q.ln();
        self.density += density;
    }

    /// The mean logarithm of the wavenumbers, and the logarithm of the mean density.
    fn point(&self) -> [f64; 2] {
        [self.log_q / self.waves, (self.density / self.waves).ln()]
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
