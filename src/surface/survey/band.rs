//! The power spectrum of heights in bands, and its power law.

use crate::error::SurfaceError;
use crate::formats::Scan;
use crate::grid::Grid;
use crate::surface::{PowerSpectrum, Surface};
use std::f64::consts::{LN_2, PI, TAU};

/// Bands per octave, in which densities are averaged.
const BANDS: f64 = 4.0;
/// The mean square deviation of bands from a power law, over what chance makes, from which on they follow none.
const MOST_SCATTER: f64 = 1.7;
/// The fewest bands of a stretch, and the octaves that those of a fit span at least.
const FEWEST: usize = 6;
const LEAST_OCTAVES: f64 = 1.0;
/// How many neighbouring waves a Hann window makes one along each axis: 1 + 2 (2/3)^2 + 2 (1/6)^2, the sum of the squares of their
/// correlations.
const WINDOWED: f64 = 1.0 + 2.0 * 4.0 / 9.0 + 2.0 / 36.0;
/// What is added to the standard error for the bend of a spectrum at its ends.
const BEND: f64 = 0.01;
/// The part of the difference from the shorter half of the waves that the error is at least.
const OF_HALF: f64 = 0.5;
/// A Hurst exponent with a larger error than this is not reported.
const LARGEST_ERROR: f64 = 0.17;

/// The waves in a quarter of an octave.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Band {
    /// The geometric mean of their wavenumbers, 1/length.
    pub wavenumber: f64,
    /// The mean of their densities, see [`PowerSpectrum`].
    pub density: f64,
    /// The number of waves whose densities are independent of each other, at least 1.
    pub waves: f64,
}

/// A power law `C(q) ~ q^exponent`, fitted to the bands of a spectrum between its roll-off and its cut-off.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PowerLawFit {
    /// The exponent.
    pub exponent: f64,
    /// The Hurst exponent that follows from it, `-(1 + exponent) / 2` of a line and `-1 - exponent / 2` of a surface, between 0 and 1.
    pub hurst: f64,
    /// The standard error of the Hurst exponent, or half of the difference from that of the shorter half of the waves if it is larger.
    pub hurst_error: f64,
    /// The shortest and the longest wavelength of the fit.
    pub wavelengths: [f64; 2],
}

impl Band {
    /// The bands of heights about their plane under a Hann window, without voids.
    ///
    /// # Errors
    /// For less nodes than a grid has.
    pub(super) fn of_flat(flat: &Scan) -> Result<Vec<Self>, SurfaceError> {
        let grid = flat.grid()?;
        Ok(Self::all(&PowerSpectrum::new(&Surface::new(grid, windowed(flat).height)?), &grid))
    }

    /// The bands of a spectrum of heights on a grid under a Hann window, from the longest waves on; those without a wave are left out.
    pub(super) fn all(spectrum: &PowerSpectrum, grid: &Grid) -> Vec<Self> {
        let number = |q: f64| (BANDS * q.log2()).floor();
        let axes = if grid.is_line() { 1 } else { 2 };
        let [ly, lx] = grid.size().map(|length| length / TAU);
        // half of the waves, as those of opposite wave vectors are the same
        let independent = 0.5 * if grid.is_line() { lx } else { lx * ly } / WINDOWED.powi(axes);
        let waves = spectrum.wavenumber.iter().zip(&spectrum.density).zip(&spectrum.measure);
        let waves: Vec<[f64; 3]> = waves.map(|((&q, &density), measure)| [q, density, independent * measure]).collect();
        let bands = waves.chunk_by(|one, next| number(one[0]) == number(next[0]));
        bands.map(Self::new).collect()
    }

    fn new(waves: &[[f64; 3]]) -> Self {
        let mean = |of: &dyn Fn(&[f64; 3]) -> f64| waves.iter().map(of).sum::<f64>() / waves.len() as f64;
        Self {
            wavenumber: mean(&|wave| wave[0].ln()).exp(),
            density: mean(&|wave| wave[1]),
            waves: waves.iter().map(|wave| wave[2]).sum::<f64>().max(1.0),
        }
    }

    /// Its wavelength.
    pub fn wavelength(&self) -> f64 {
        TAU / self.wavenumber
    }

    /// Logarithms of wavenumber and density, and the weight of the latter. The logarithm of a mean of `n` densities, each of them
    /// exponentially distributed, is `1/(2n) + 1/(12n^2)` too small on average, with a variance of `1/n + 1/(2n^2)`.
    fn logarithms(&self) -> [f64; 3] {
        let n = self.waves;
        [self.wavenumber.ln(), self.density.ln() + (0.5 + 1.0 / (12.0 * n)) / n, 1.0 / (1.0 / n + 0.5 / (n * n))]
    }
}

impl PowerLawFit {
    /// The power law of the bands of heights down to a wavelength. Of all stretches of bands that follow one with a Hurst exponent
    /// between 0 and 1 it is the one whose exponent is known best, which leaves out waves beyond roll-off and cut-off. None where no octave
    /// follows one.
    pub(super) fn new(bands: &[Band], is_line: bool, shortest: f64) -> Option<Self> {
        let is_inside = |band: &&Band| band.density > 0.0 && band.wavelength() >= shortest;
        let bands: Vec<Band> = bands.iter().filter(is_inside).copied().collect();
        let stretches = (0..bands.len()).flat_map(|from| (from + FEWEST..=bands.len()).map(move |to| from..to));
        let laws =
            stretches.filter_map(|stretch| Some((Self::from_stretch(&bands[stretch.clone()], is_line)?, stretch)));
        let (_, stretch) = laws.min_by(|(one, _), (other, _)| one.hurst_error.total_cmp(&other.hurst_error))?;
        // roll-off and cut-off may lie inside the bands at the ends
        let inner = &bands[stretch.start + 1..stretch.end - 1];
        let law = Self::from_stretch(inner, is_line)?;
        // long waves are few, so that chance may hide a roll-off among them: then the shorter half has another exponent
        let half = hurst(&Line::fit(&logarithms(&inner[inner.len() / 2..])), is_line);
        let hurst_error = law.hurst_error.max(OF_HALF * (law.hurst - half).abs());
        (hurst_error <= LARGEST_ERROR).then_some(Self { hurst_error, ..law })
    }

    /// The power law that all bands follow, if there is one.
    fn from_stretch(bands: &[Band], is_line: bool) -> Option<Self> {
        let points = logarithms(bands);
        let (first, last) = (points.first()?[0], points.last()?[0]);
        let line = Line::fit(&points);
        let hurst = hurst(&line, is_line);
        let Line { slope, variance, scatter } = line;
        let follows = last - first >= LEAST_OCTAVES * LN_2 && scatter <= MOST_SCATTER && (0.0..=1.0).contains(&hurst);
        follows.then(|| Self {
            exponent: slope,
            hurst,
            hurst_error: BEND + 0.5 * (variance * scatter.max(1.0)).sqrt(),
            wavelengths: [last, first].map(|q| TAU / q.exp()),
        })
    }
}

fn logarithms(bands: &[Band]) -> Vec<[f64; 3]> {
    bands.iter().map(Band::logarithms).collect()
}

/// The Hurst exponent of a straight line through logarithms.
fn hurst(line: &Line, is_line: bool) -> f64 {
    if is_line { -0.5 * (1.0 + line.slope) } else { -1.0 - 0.5 * line.slope }
}

/// The straight line of least squares through points with weights, which are the inverse variances.
struct Line {
    slope: f64,
    /// The variance of the slope.
    variance: f64,
    /// The weighted mean square deviation.
    scatter: f64,
}

impl Line {
    fn fit(points: &[[f64; 3]]) -> Self {
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(|point| point[2] * of(point)).sum::<f64>();
        let weight = sum(&|_| 1.0);
        let (x, y) = (sum(&|it| it[0]) / weight, sum(&|it| it[1]) / weight);
        let along = sum(&|it| (it[0] - x).powi(2));
        let slope = sum(&|it| (it[0] - x) * (it[1] - y)) / along;
        let scatter = sum(&|it| (it[1] - y - slope * (it[0] - x)).powi(2)) / (points.len() as f64 - 2.0);
        Self { slope, variance: 1.0 / along, scatter }
    }
}

/// Heights times a Hann window of mean square 1 along each axis.
pub(super) fn windowed(scan: &Scan) -> Scan {
    let window = |n: usize| -> Vec<f64> {
        let at = |i: usize| (8.0f64 / 3.0).sqrt() * (PI * (i as f64 + 0.5) / n as f64).sin().powi(2);
        if n == 1 { vec![1.0] } else { (0..n).map(at).collect() }
    };
    let [y, x] = scan.shape().map(window);
    let mut scan = scan.clone();
    scan.height.indexed_iter_mut().for_each(|((row, column), h)| *h *= y[row] * x[column]);
    scan
}
