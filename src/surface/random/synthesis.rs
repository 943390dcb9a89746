//! Gaussian heights of a given power spectrum.

use super::{Lay, MeasuredSpectrum, SelfAffine, SpectralDensity, SpectrumTable};
use crate::error::{FileError, RoughnessError, SurfaceError};
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use crate::surface::Field;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::{SQRT_2, TAU};

/// Relative slack within which a wavelength counts as equal to two spacings.
const SLACK: f64 = 1e-12;

/// The spectrum that the waves of a surface are drawn from.
pub(super) struct WaveSource {
    density: WaveDensity,
    is_line: bool,
}

enum WaveDensity {
    Law(SelfAffine),
    /// A table, and the wavenumber at and above which there are no waves.
    Table(SpectrumTable, f64),
}

impl WaveSource {
    /// The waves of a spectrum that `grid` can carry, if it were isotropic.
    pub(crate) fn new(spectrum: &SpectralDensity, grid: &Grid) -> Result<Self, RoughnessError> {
        if let SpectralDensity::SelfAffine(law) = spectrum {
            law.check(grid)?;
        }
        Ok(Self::from_spectrum(spectrum, grid.is_line())?)
    }

    /// The waves of a spectrum on a line or else a surface.
    pub(crate) fn from_spectrum(spectrum: &SpectralDensity, is_line: bool) -> Result<Self, FileError> {
        let density = match spectrum {
            SpectralDensity::SelfAffine(law) => WaveDensity::Law(*law),
            SpectralDensity::Measured(MeasuredSpectrum { file, convention, short_cutoff }) => {
                let table = file.read(*convention, is_line)?;
                let end = short_cutoff.map_or(f64::INFINITY, |cutoff| TAU / cutoff).min(table.last());
                WaveDensity::Table(table, end * (1.0 - 10.0 * SLACK))
            }
        };
        Ok(Self { density, is_line })
    }

    /// The density at the wavenumber `q`: of a law up to a factor, of a table as it is.
    pub(crate) fn density(&self, q: f64) -> f64 {
        match &self.density {
            WaveDensity::Law(law) => law.density(q, self.is_line),
            WaveDensity::Table(table, end) if q < *end => table.density(q),
            WaveDensity::Table(..) => 0.0,
        }
    }

    /// A wavenumber above which there are no waves.
    pub(crate) fn largest_wavenumber(&self) -> f64 {
        match &self.density {
            WaveDensity::Law(law) => law.largest_wavenumber(),
            WaveDensity::Table(_, end) => *end,
        }
    }

    /// The factor from `sqrt C` to a part of a Fourier coefficient on a grid. That of a law is its wavelength of reference, so that
    /// gradients are of order one whatever the unit of length; that of a table makes `C` the mean of the realisations.
    fn amplitude(&self, grid: &Grid) -> f64 {
        let [ly, lx] = grid.size();
        match &self.density {
            WaveDensity::Law(law) => law.reference(),
            WaveDensity::Table(..) if self.is_line => (TAU / lx).sqrt() / SQRT_2,
            WaveDensity::Table(..) => TAU / (lx * ly).sqrt() / SQRT_2,
        }
    }

    /// Checks that two spacings are not longer than the shortest waves along each axis, and that there is a wave.
    pub(crate) fn check(&self, lay: &Lay, grid: &Grid) -> Result<(), SurfaceError> {
        let (period, shortest) = (grid.longest_wavelength(), grid.shortest_wavelength());
        if let (WaveDensity::Law(law), true) = (&self.density, lay.is_isotropic())
            && law.short_cutoff < shortest * (1.0 - SLACK)
        {
            return Err(SurfaceError::CutoffTooFine { short_cutoff: law.short_cutoff, shortest });
        }
        let largest = lay.largest(self.largest_wavenumber());
        for axis in if self.is_line { 1..2 } else { 0..2 } {
            let (wavelength, least) = (TAU / largest[axis], 2.0 * grid.spacing()[axis]);
            if wavelength < least * (1.0 - 10.0 * SLACK) {
                return Err(SurfaceError::WavesTooFine { axis: ["y", "x"][axis], wavelength, shortest: least });
            }
        }
        match band(grid, self, lay).next() {
            Some(_) => Ok(()),
            None => Err(SurfaceError::EmptySpectrum { period, short_cutoff: TAU / self.largest_wavenumber() }),
        }
    }
}

/// Gaussian heights of the waves, up to a factor for a law. Coefficients and plans are gone when this returns.
///
/// The numbers come from ChaCha8 and are drawn wave by wave, in an order set by the periods of the cell and the spectrum alone. So one
/// seed gives one realisation: a finer grid samples the same waves at more points.
pub(super) fn heights(grid: &Grid, waves: &WaveSource, lay: &Lay, [seed, stream]: [u64; 2]) -> Field {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    let mut coefficients = vec![Complex::default(); grid.modes()];
    let (ny, amplitude) = (grid.shape()[0], waves.amplitude(grid));
    for (kx, ky, density) in band(grid, waves, lay) {
        let coefficient = normal(&mut random) * (density.sqrt() * amplitude);
        coefficients[kx * ny + ky.rem_euclid(ny as i64) as usize] = coefficient;
        if kx == 0 && ky != 0 {
            coefficients[(-ky).rem_euclid(ny as i64) as usize] = coefficient.conj();
        }
    }
    let mut height = Field::zeros(grid.shape());
    Fourier::new(grid).inverse(&mut coefficients, height.as_slice_mut().expect("standard layout by construction"));
    height
}

fn normal(random: &mut impl Rng) -> Complex {
    let mut draw = || Distribution::<f64>::sample(&StandardNormal, random);
    Complex { re: draw(), im: draw() }
}

/// One of each pair of opposite wave vectors in the band, as integers `(kx, ky)` with their density.
///
/// Order and extent follow from the periods, the spectrum and the lay alone, never from the number of points.
fn band(grid: &Grid, waves: &WaveSource, lay: &Lay) -> impl Iterator<Item = (usize, i64, f64)> {
    let ([ly, lx], is_line) = (grid.size(), grid.is_line());
    let [largest_y, largest_x] = lay.largest(waves.largest_wavenumber());
    let extent = |largest: f64, period: f64| (largest * period / TAU).ceil() as i64;
    let (columns, rows) = (extent(largest_x, lx), if is_line { 0 } else { extent(largest_y, ly) });
    (0..=columns).flat_map(move |kx| {
        let first = if kx == 0 { (!is_line).into() } else { -rows };
        (first..=rows).filter_map(move |ky| {
            let q = lay.wavenumber(TAU * kx as f64 / lx, TAU * ky as f64 / ly);
            let density = waves.density(q);
            (density > 0.0).then_some((kx as usize, ky, density))
        })
    })
}
