//! Random surfaces of a given power spectrum.

use super::{Field, Spectrum, Surface};
use crate::error::SurfaceError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::TAU;

impl Surface {
    /// A random self-affine surface with the power spectrum `spectrum` (Eq. 10).
    ///
    /// Each Fourier coefficient is `sqrt(C(q)) (xi + i eta)` with independent standard normal `xi`, `eta`: Gaussian
    /// amplitudes, uniform phases. The whole is then scaled so that the root-mean-square gradient of this realisation,
    /// by the finite differences of Eq. 8, is `spectrum.rms_gradient` to rounding.
    ///
    /// The numbers come from ChaCha8 and are drawn wave by wave, in an order set by the periods of the cell and the
    /// spectrum alone. So one seed gives one realisation: a finer grid samples the same waves at more points.
    ///
    /// | argument   | meaning                                  | unit         |
    /// |------------|------------------------------------------|--------------|
    /// | `grid`     | the points                               | length       |
    /// | `spectrum` | the power spectrum                       | length, -    |
    /// | `seed`     | which realisation; stored in the surface | -            |
    ///
    /// # Errors
    /// The errors of [`Spectrum::validate`].
    ///
    /// # Source
    /// Section 3 of the paper and the contact-mechanics challenge (Mueser et al., Tribol. Lett. 65:118, 2017).
    ///
    /// ```
    /// use asperity::surface::{Roughness, Spectrum};
    /// use asperity::{Grid, Surface};
    /// let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.02, rms_gradient: 0.1 };
    /// let surface = Surface::rough(Grid::line(1024, 1.0)?, &spectrum, 7)?;
    /// assert!((Roughness::of(&surface).rms_gradient - 0.1).abs() < 1e-12);
    /// assert_eq!(surface.seed(), Some(7));
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn rough(grid: Grid, spectrum: &Spectrum, seed: u64) -> Result<Self, SurfaceError> {
        spectrum.validate(&grid)?;
        let unscaled = Self::new(grid, unscaled(&grid, spectrum, seed))?;
        let scale = spectrum.rms_gradient / unscaled.rms_gradient();
        Ok(Self::new(grid, unscaled.height * scale)?.with_seed(seed))
    }
}

/// Heights of the right spectrum up to a factor. Coefficients and plans are gone when this returns.
fn unscaled(grid: &Grid, spectrum: &Spectrum, seed: u64) -> Field {
    let mut coefficients = amplitudes(grid, spectrum, seed);
    let mut height = Field::zeros(grid.shape());
    Fourier::new(grid).inverse(&mut coefficients, height.as_slice_mut().expect("standard layout by construction"));
    height
}

/// Random Fourier coefficients up to a factor, in the order of [`crate::fourier`]; in units of the roll-off wavelength,
/// so that gradients are of order one whatever the unit of length.
fn amplitudes(grid: &Grid, spectrum: &Spectrum, seed: u64) -> Vec<Complex> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut coefficients = vec![Complex::default(); grid.modes()];
    let ny = grid.shape()[0];
    for (kx, ky, density) in band(grid, spectrum) {
        let coefficient = normal(&mut random) * (density.sqrt() * spectrum.rolloff_wavelength);
        coefficients[kx * ny + ky.rem_euclid(ny as i64) as usize] = coefficient;
        if kx == 0 && ky != 0 {
            coefficients[(-ky).rem_euclid(ny as i64) as usize] = coefficient.conj();
        }
    }
    coefficients
}

fn normal(random: &mut impl Rng) -> Complex {
    let mut draw = || Distribution::<f64>::sample(&StandardNormal, random);
    Complex { re: draw(), im: draw() }
}

/// One of each pair of opposite wave vectors in the band, as integers `(kx, ky)` with their density.
///
/// Order and extent follow from the periods and the spectrum alone, never from the number of points.
fn band(grid: &Grid, spectrum: &Spectrum) -> impl Iterator<Item = (usize, i64, f64)> {
    let ([ly, lx], is_line) = (grid.size(), grid.is_line());
    let extent = |period: f64| (spectrum.largest_wavenumber() * period / TAU).ceil() as i64;
    let (columns, rows) = (extent(lx), if is_line { 0 } else { extent(ly) });
    (0..=columns).flat_map(move |kx| {
        let first = if kx == 0 { (!is_line).into() } else { -rows };
        (first..=rows).filter_map(move |ky| {
            let q = (TAU * kx as f64 / lx).hypot(TAU * ky as f64 / ly);
            let density = spectrum.density(q, is_line);
            (density > 0.0).then_some((kx as usize, ky, density))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{PowerSpectrum, Roughness};

    const SPECTRUM: Spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.7, short_cutoff: 0.2, rms_gradient: 0.02 };

    fn grid([ny, nx]: [usize; 2], size: [f64; 2]) -> Grid {
        if ny == 1 { Grid::line(nx, size[1]).unwrap() } else { Grid::surface([ny, nx], size).unwrap() }
    }

    /// The rms gradients differ by the finite differences alone; the heights are the same up to that factor.
    fn assert_same_realisation(shape: [usize; 2], [fy, fx]: [usize; 2], size: [f64; 2]) {
        let coarse = Surface::rough(grid(shape, size), &SPECTRUM, 11).unwrap();
        let fine = Surface::rough(grid([shape[0] * fy, shape[1] * fx], size), &SPECTRUM, 11).unwrap();
        let sampled = Field::from_shape_fn(shape, |(i, j)| fine.height()[[i * fy, j * fx]]);
        let factor = (&sampled * coarse.height()).sum() / (coarse.height() * coarse.height()).sum();
        assert!((factor - 1.0).abs() < 0.2, "{factor}");
        let largest = coarse.heights().iter().fold(0.0, |m: f64, h| m.max(h.abs()));
        for (a, b) in sampled.iter().zip(coarse.heights()) {
            assert!((a - factor * b).abs() < 1e-10 * largest, "{shape:?}: {a} against {b}");
        }
    }

    #[test]
    fn a_finer_grid_carries_the_same_realisation() {
        assert_same_realisation([1, 32], [1, 2], [1.0, 2.0]);
        assert_same_realisation([1, 31], [1, 3], [1.0, 2.0]);
        assert_same_realisation([16, 32], [2, 2], [1.0, 2.0]);
        assert_same_realisation([15, 33], [3, 2], [1.0, 2.0]);
        assert_same_realisation([25, 24], [2, 3], [1.7, 1.3]);
    }

    #[test]
    fn the_rms_gradient_is_exact_in_any_unit() {
        for unit in [1e-100, 1e-6, 1.0, 1e100] {
            let spectrum = Spectrum { rolloff_wavelength: 0.7 * unit, short_cutoff: 0.2 * unit, ..SPECTRUM };
            for shape in [[1, 64], [40, 36]] {
                let surface = Surface::rough(grid(shape, [1.0 * unit, 2.0 * unit]), &spectrum, 3).unwrap();
                let found = Roughness::of(&surface).rms_gradient;
                assert!((found / 0.02 - 1.0).abs() < 1e-13, "{shape:?} at {unit:e}: {found}");
            }
        }
    }

    #[test]
    fn seeds_are_reproducible_and_distinct() {
        let grid = Grid::line(64, 2.0).unwrap();
        let surface = |seed| Surface::rough(grid, &SPECTRUM, seed).unwrap();
        assert_eq!(surface(1), surface(1));
        assert_ne!(surface(1), surface(2));
        assert_eq!(surface(5).seed(), Some(5));
    }

    #[test]
    fn the_exponents_are_those_of_the_spectrum() {
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.1, short_cutoff: 0.004, rms_gradient: 0.1 };
        for (shape, exponent) in [([1, 1 << 16], -2.6), ([512, 512], -3.6)] {
            let mut slope = 0.0;
            for seed in 0..8 {
                let surface = Surface::rough(grid(shape, [1.0, 1.0]), &spectrum, seed).unwrap();
                slope += fitted_exponent(&PowerSpectrum::of(&surface), 80.0, 1400.0) / 8.0;
            }
            assert!((slope - exponent).abs() < 0.15, "{shape:?}: {slope} against {exponent}");
        }
    }

    fn fitted_exponent(spectrum: &PowerSpectrum, low: f64, high: f64) -> f64 {
        let points = spectrum.wavenumber.iter().zip(&spectrum.density);
        let points: Vec<_> =
            points.filter(|&(&q, _)| q > low && q < high).map(|(q, c)| (q.ln(), c.max(1e-300).ln())).collect();
        let n = points.len() as f64;
        let (mx, my) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
        let (num, den) =
            points.iter().fold((0.0, 0.0), |(a, b), p| (a + (p.0 - mx) * (p.1 - my), b + (p.0 - mx) * (p.0 - mx)));
        num / den
    }
}
