//! The stress below a periodic pressure, wave by wave.

use super::{Stress, check};
use crate::chunks;
use crate::error::SolidError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// Depths of one task, which plans the transforms that they share.
const DEPTHS_PER_TASK: usize = 8;

/// Depth, in units of `1/q`, below which a wave is left out: its amplitude is there below rounding.
const DEEPEST: f64 = 50.0;

/// The stress below row `row` of a periodic pressure on a grid; a line has the row 0.
///
/// Below one wave of pressure `p` the solid is in plane strain across its crests. With `k = q z`, the wave vector `(q_x, q_y)` of
/// length `q`, and `e = exp(-k)`:
///
/// | stress               | over `p_q`                                                       |
/// |----------------------|------------------------------------------------------------------|
/// | `sigma_zz`           | `-(1 + k) e`                                                     |
/// | `sigma_xx`           | `-[(q_x/q)^2 (1 - k) + 2 nu (q_y/q)^2] e`                        |
/// | `sigma_yy`           | `-[(q_y/q)^2 (1 - k) + 2 nu (q_x/q)^2] e`                        |
/// | `sigma_xy`           | `-(q_x q_y/q^2) (1 - k - 2 nu) e`                                |
/// | `sigma_xz`, `sigma_yz` | `i q_x z e`, `i q_y z e`                                       |
///
/// The mean pressure causes no lateral strain, since neighbouring cells confine the cell: `sigma_zz = -<p>` and
/// `sigma_xx = sigma_yy = -nu/(1 - nu) <p>` at all depths.
///
/// | argument   | shape      | unit     |
/// |------------|------------|----------|
/// | `pressure` | `(ny, nx)` | pressure |
/// | `poisson`  |            |          |
/// | `depth`    | any        | length   |
///
/// Memory: one half spectrum besides what comes out.
///
/// # Errors
/// [`SolidError::Poisson`] for a ratio outside `(-1, 1/2]`.
///
/// # Panics
/// If the length of `pressure` does not fit the grid, or for a row that it does not have.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 13.2, for the wave of a line; turned about `z` for the others.
pub fn under_row(grid: &Grid, pressure: &[f64], row: usize, poisson: f64, depth: &[f64]) -> Result<Stress, SolidError> {
    check(poisson)?;
    let [ny, nx] = grid.shape();
    assert!(row < ny, "the row must be one of the grid");
    let cut = Cut { grid, poisson, waves: waves(grid, pressure, row) };
    let mut stress = Stress::zero(depth, nx, poisson, grid.is_line());
    let mut rows = rows(&mut stress, nx);
    let mut tasks: Vec<_> = rows.chunks_mut(DEPTHS_PER_TASK).zip(depth.chunks(DEPTHS_PER_TASK)).collect();
    chunks::each(&mut tasks, grid.len(), |_, (rows, depth)| {
        let mut fourier = Fourier::new(&cut.line());
        rows.iter_mut().zip(*depth).for_each(|(rows, &depth)| cut.write(depth, rows, &mut fourier));
    });
    Ok(stress)
}

/// The row of the largest pressure on a grid.
///
/// # Panics
/// If the length of `pressure` does not fit the grid.
pub fn highest_row(grid: &Grid, pressure: &[f64]) -> usize {
    assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
    let highest = pressure.iter().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
    highest.map_or(0, |(node, _)| node / grid.shape()[1])
}

/// The waves of a pressure with the phases that they have on a row, in the order of [`crate::fourier`].
fn waves(grid: &Grid, pressure: &[f64], row: usize) -> Vec<Complex> {
    let ny = grid.shape()[0];
    let mut waves = vec![Complex::default(); grid.modes()];
    Fourier::new(grid).forward(pressure, &mut waves);
    let turns = |ky: usize| (ky * row % ny) as f64 / ny as f64;
    let phases: Vec<Complex> = (0..ny).map(|ky| Complex::from_polar(1.0, TAU * turns(ky))).collect();
    waves
        .chunks_exact_mut(ny)
        .for_each(|column| column.iter_mut().zip(&phases).for_each(|(wave, phase)| *wave *= phase));
    waves
}

/// The components in the order `xx`, `yy`, `zz`, `xy`, `xz`, `yz` at one depth each.
fn rows(stress: &mut Stress, nx: usize) -> Vec<[&mut [f64]; 6]> {
    let Stress { xx, yy, zz, xy, xz, yz, .. } = stress;
    let [mut xx, mut yy, mut zz, mut xy, mut xz, mut yz] = [xx, yy, zz, xy, xz, yz]
        .map(|field| field.as_slice_mut().expect("fields are made in standard layout").chunks_exact_mut(nx));
    std::iter::from_fn(|| Some([xx.next()?, yy.next()?, zz.next()?, xy.next()?, xz.next()?, yz.next()?])).collect()
}

/// A cut through a pressure.
struct Cut<'a> {
    grid: &'a Grid,
    poisson: f64,
    waves: Vec<Complex>,
}

impl Cut<'_> {
    /// The grid of one row.
    fn line(&self) -> Grid {
        Grid::line(self.grid.shape()[1], self.grid.size()[1]).expect("the rows of a grid are lines")
    }

    /// Writes the stress at one depth.
    fn write(&self, depth: f64, rows: &mut [&mut [f64]; 6], fourier: &mut Fourier) {
        let mut spectra: [Vec<Complex>; 6] = Default::default();
        for (kx, waves) in self.waves.chunks_exact(self.grid.shape()[0]).enumerate() {
            let stress = self.summed(kx, waves, depth);
            spectra.iter_mut().zip(stress).for_each(|(spectrum, value)| spectrum.push(value));
        }
        for (spectrum, row) in spectra.iter_mut().zip(rows) {
            fourier.inverse(spectrum, row);
        }
    }

    /// The stress of all waves of one `q_x`.
    fn summed(&self, kx: usize, waves: &[Complex], depth: f64) -> [Complex; 6] {
        let [ly, lx] = self.grid.size();
        let (qx, ny) = (TAU * kx as f64 / lx, waves.len());
        let mut sums = [Complex::default(); 6];
        for (ky, wave) in waves.iter().enumerate() {
            let qy = TAU * if 2 * ky > ny { ky as f64 - ny as f64 } else { ky as f64 } / ly;
            if qx.hypot(qy) * depth > DEEPEST {
                continue;
            }
            let factors = factors([qx, qy], depth, self.poisson);
            // a wave at Nyquist is its own mirror image, and has no part that is odd along y
            let odd = if 2 * ky == ny { 0.0 } else { 1.0 };
            let turned = Complex::i() * wave;
            let parts = [*wave, *wave, *wave, *wave * odd, turned, turned * odd];
            sums.iter_mut().zip(parts.into_iter().zip(factors)).for_each(|(sum, (part, factor))| *sum += part * factor);
        }
        sums
    }
}

/// The stress of a wave of unit pressure: `xx`, `yy`, `zz`, `xy`, and `xz` and `yz` over `i`.
fn factors([qx, qy]: [f64; 2], z: f64, poisson: f64) -> [f64; 6] {
    let q = qx.hypot(qy);
    if q == 0.0 {
        let lateral = -poisson / (1.0 - poisson);
        return [lateral, lateral, -1.0, 0.0, 0.0, 0.0];
    }
    let (cosine, sine, k, e) = (qx / q, qy / q, q * z, (-q * z).exp());
    let lateral = |along: f64, across: f64| -e * (along * along * (1.0 - k) + 2.0 * poisson * across * across);
    [
        lateral(cosine, sine),
        lateral(sine, cosine),
        -e * (1.0 + k),
        -e * cosine * sine * (1.0 - k - 2.0 * poisson),
        e * z * qx,
        e * z * qy,
    ]
}
