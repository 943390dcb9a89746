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
    /// amplitudes, uniform phases. The heights are then scaled so that the root-mean-square gradient of this
    /// realisation, by the finite differences of Eq. 8, is `spectrum.rms_gradient` to rounding.
    ///
    /// The numbers come from ChaCha8 and are drawn wave by wave, in an order set by the periods of the cell and the
    /// spectrum alone. So one seed gives one realisation: a finer grid samples the same waves at more points.
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
    /// assert!((Roughness::new(&surface).rms_gradient - 0.1).abs() < 1e-12);
    /// assert_eq!(surface.seed(), Some(7));
    /// # Ok::<(), asperity::error::SurfaceError>(())
    /// ```
    pub fn rough(grid: Grid, spectrum: &Spectrum, seed: u64) -> Result<Self, SurfaceError> {
        spectrum.validate(&grid)?;
        let unscaled = Self::new(grid, unscaled(&grid, spectrum, seed))?;
        let scale = spectrum.rms_gradient / unscaled.rms_gradient();
        Ok(Self { seed: Some(seed), ..Self::new(grid, unscaled.height * scale)? })
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
