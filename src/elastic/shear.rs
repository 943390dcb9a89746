//! The displacement of a half-space along both axes by tractions along both axes.

use super::free::{FreeTable, padded};
use super::solid::stiffness;
use super::{ElasticSolid, element};
use crate::chunks;
use crate::error::GridError;
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;
use std::sync::Arc;

/// Modes that one task multiplies.
const MODES: usize = 1 << 12;

/// The compliance of a half-space for tractions along both axes of a surface.
///
/// A traction `tau` displaces the surface by `u`, both with a component along `x` and one along `y`. For each wave
///
/// `u_i = (2/(E* q)) [(1 + m) delta_ij - m q_i q_j/q^2] tau_j`
///
/// with `m = sum (nu/G) / sum ((1 - nu)/G)` over the elastic bodies, which is `nu/(1 - nu)` for one of them. On a periodic surface a
/// uniform traction does not displace: displacements have zero mean. On a surface that is free along both axes `u` is the sum of the
/// displacements by a uniform traction on each element, the integrals of
///
/// `(1/(pi E*)) [delta_ij/r + m x_i x_j/r^3]`.
///
/// The term of `x` and `x` is that of [`Compliance::tangential`](super::Compliance::tangential). At the Nyquist waves, which run in no
/// direction, the terms of `x` and `y` are zero.
///
/// Memory: three doubles for each wave of the half spectrum, of the padded grid where the surface is free.
///
/// # Source
/// Cerruti; Johnson, *Contact Mechanics* (1985), Eqs. 3.75 and 3.76, and as waves.
///
/// ```
/// use asperity::Grid;
/// use asperity::elastic::{HalfSpace, ShearCompliance, ShearResponse};
/// use std::f64::consts::TAU;
/// let grid = Grid::surface([16, 16], [TAU, TAU])?; // wavenumbers 0, 1, 2, ...
/// let m = 0.5;
/// let mut response = ShearResponse::new(ShearCompliance::new(&grid, HalfSpace::new(1.0).into(), m)?.into());
/// // a wave along the diagonal, with a traction along x: q_x = q_y = 1
/// let wave: Vec<f64> = (0..256).map(|i| (TAU * (i / 16 + i % 16) as f64 / 16.0).cos()).collect();
/// let (mut along, mut across) = (vec![0.0; 256], vec![0.0; 256]);
/// response.displacement([&wave, &vec![0.0; 256]], [&mut along, &mut across]);
/// let scale = 2.0 / 2f64.sqrt();
/// assert!((along[0] - scale * (1.0 + 0.5 * m)).abs() < 1e-14);
/// assert!((across[0] + scale * 0.5 * m).abs() < 1e-14);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ShearCompliance {
    grid: Grid,
    /// The grid of the transforms: padded along free axes.
    padded: Grid,
    modulus: f64,
    m: f64,
    /// The terms `xx`, `xy` and `yy`, in the order of [`Grid::wavenumbers`] of the padded grid.
    weights: Vec<[f64; 3]>,
}

impl ShearCompliance {
    /// The compliance of a half-space over a surface that is periodic or free along both axes. With `m = 0` both components are
    /// displaced as by pressures, and any boundary is possible.
    ///
    /// # Errors
    /// [`GridError::TooFewPoints`] for a line, [`GridError::ShearedSolid`] for a solid other than a half-space, and on a surface that is free along one
    /// axis only if `m` is not zero; [`GridError::TooManyPoints`] if what a free boundary adds is too much.
    pub fn new(grid: &Grid, solid: Arc<dyn ElasticSolid>, m: f64) -> Result<Self, GridError> {
        if grid.is_line() {
            return Err(GridError::TooFewPoints { axis: "y", points: 1 });
        }
        if !solid.is_half_space() {
            return Err(GridError::ShearedSolid { solid: solid.description() });
        }
        let padded = padded(grid)?;
        let weights = match grid.periodic() {
            [true, true] => periodic(grid, solid.as_ref(), m),
            [false, false] => free(grid, &padded, solid.as_ref(), m)?,
            _ if m == 0.0 => twice(&FreeTable::new(grid, solid.as_ref())?, &padded),
            _ => return Err(GridError::ShearedSolid { solid: "a half-space that is free along one axis".into() }),
        };
        Ok(Self { grid: *grid, padded, modulus: solid.contact_modulus(), m, weights })
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The mean stiffness of the waves for a traction along its wave vector, a pressure per length.
    pub(crate) fn mean_stiffness(&self) -> f64 {
        let sum: f64 = self.grid.wavenumbers().sum();
        0.5 * self.modulus * sum / self.grid.modes() as f64
    }
}

/// The terms of a table for pressures, for both components.
fn twice(table: &FreeTable, padded: &Grid) -> Vec<[f64; 3]> {
    by_modes(table.weights(), padded).map(|weight| [weight, 0.0, weight]).collect()
}

/// Values by the places of a filter, in the order of the modes.
fn by_modes<'t>(table: &'t [f64], grid: &Grid) -> impl Iterator<Item = f64> + 't {
    let [ny, nx] = grid.shape();
    (0..=nx / 2).flat_map(move |kx| (0..ny).map(move |ky| table[kx * (ny / 2 + 1) + ky.min(ny - ky)]))
}

fn periodic(grid: &Grid, solid: &dyn ElasticSolid, m: f64) -> Vec<[f64; 3]> {
    let [ny, nx] = grid.shape();
    let has_direction = move |kx: usize, ky: usize| 2 * kx != nx && 2 * ky != ny;
    let places = (0..=nx / 2).flat_map(|kx| (0..ny).map(move |ky| has_direction(kx, ky)));
    let at = |([qy, qx], has_direction): ([f64; 2], bool)| {
        let q = qx.hypot(qy);
        if q == 0.0 {
            return [0.0; 3];
        }
        let (c, s, scale) = (qx / q, qy / q, stiffness(solid, q).recip());
        let cross = if has_direction { -m * c * s } else { 0.0 };
        [scale * (1.0 + m * s * s), scale * cross, scale * (1.0 + m * c * c)]
    };
    grid.wave_vectors().zip(places).map(at).collect()
}

fn free(grid: &Grid, padded: &Grid, solid: &dyn ElasticSolid, m: f64) -> Result<Vec<[f64; 3]>, GridError> {
    let (sides, modulus) = (grid.spacing(), solid.contact_modulus());
    let along = FreeTable::sheared(grid, solid, m)?;
    let across = FreeTable::sheared_across(grid, solid, m)?;
    let ([my, mx], [dy, dx]) = (padded.shape(), sides);
    let signed = |i: usize, n: usize| match 2 * i {
        twice if twice == n => 0.0,
        twice if twice < n => i as f64,
        _ => i as f64 - n as f64,
    };
    let mut influence = vec![0.0; my * mx];
    chunks::rows_mut(&mut influence, mx, |y, row| {
        let y = dy * signed(y, my);
        for (x, value) in row.iter_mut().enumerate() {
            *value = m * element::crossed_rectangle([y, dx * signed(x, mx)], sides, modulus);
        }
    });
    let mut crossed = vec![Complex::default(); padded.modes()];
    Fourier::new(padded).forward(&influence, &mut crossed);
    let points = (my * mx) as f64;
    let terms = by_modes(along.weights(), padded).zip(by_modes(across.weights(), padded)).zip(crossed);
    Ok(terms.map(|((xx, yy), xy)| [xx, points * xy.re, yy]).collect())
}

/// The response of a half-space to tractions along both axes of a surface: displacements, and an approximate inverse.
///
/// Memory: two half spectra and a field, of the padded grid where the surface is free.
pub struct ShearResponse {
    compliance: Arc<ShearCompliance>,
    fourier: Fourier,
    spectra: [Vec<Complex>; 2],
    field: Vec<f64>,
    /// The transforms of the cell itself where the grid is padded.
    cell: Option<Fourier>,
    transforms: u64,
}

impl ShearResponse {
    /// Plans the response that a compliance makes.
    pub fn new(compliance: Arc<ShearCompliance>) -> Self {
        let padded = &compliance.padded;
        let spectrum = || vec![Complex::default(); padded.modes()];
        let cell = (padded != &compliance.grid).then(|| Fourier::new(&compliance.grid));
        Self {
            fourier: Fourier::new(padded),
            spectra: [spectrum(), spectrum()],
            field: vec![0.0; padded.len()],
            cell,
            transforms: 0,
            compliance,
        }
    }

    /// The compliance.
    pub fn compliance(&self) -> &Arc<ShearCompliance> {
        &self.compliance
    }

    /// Number of transforms so far, forward and inverse, of one component each.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// Writes the displacements along `x` and `y`, lengths, under the tractions along `x` and `y`, pressures: two transform pairs.
    ///
    /// | argument       | shape            | unit     |
    /// |----------------|------------------|----------|
    /// | `traction`     | two of `ny * nx` | pressure |
    /// | `displacement` | two of `ny * nx` | length   |
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn displacement(&mut self, traction: [&[f64]; 2], displacement: [&mut [f64]; 2]) {
        let Self { compliance, fourier, spectra, field, transforms, .. } = self;
        *transforms += 4;
        let (from, to) = (compliance.grid.shape()[1], compliance.padded.shape()[1]);
        for (traction, spectrum) in traction.into_iter().zip(&mut *spectra) {
            assert_eq!(traction.len(), compliance.grid.len(), "a traction must fit the grid");
            if from == to {
                field[..traction.len()].copy_from_slice(traction);
            } else {
                let rows = field.chunks_exact_mut(to).zip(traction.chunks_exact(from));
                rows.for_each(|(row, values)| row[..from].copy_from_slice(values));
            }
            fourier.forward(field, spectrum);
            field.fill(0.0);
        }
        multiply(spectra, |mode| compliance.weights[mode]);
        for (displacement, spectrum) in displacement.into_iter().zip(spectra) {
            fourier.inverse(spectrum, field);
            let rows = field.chunks_exact(to).zip(displacement.chunks_exact_mut(from));
            rows.for_each(|(row, values)| values.copy_from_slice(&row[..from]));
        }
        field.fill(0.0);
    }

    /// Makes of two displacements the tractions, with zero mean: two transform pairs. If an axis is free, they are those of the
    /// periodic solid, which are good approximations for waves that are short compared with the cell.
    pub(crate) fn traction(&mut self, fields: [&mut [f64]; 2]) {
        let Self { compliance, fourier, spectra, cell, transforms, .. } = self;
        *transforms += 4;
        let (grid, m) = (compliance.grid, compliance.m);
        let fourier = cell.as_mut().unwrap_or(fourier);
        let modes = grid.modes();
        let [a, b] = spectra;
        let mut spectra = [&mut a[..modes], &mut b[..modes]];
        for (field, spectrum) in fields.iter().zip(&mut spectra) {
            fourier.forward(field, spectrum);
        }
        let ([ny, nx], half) = (grid.shape(), 0.5 * compliance.modulus);
        let [ly, lx] = grid.size().map(|length| std::f64::consts::TAU / length);
        multiply(&mut spectra, |mode| {
            let (kx, ky) = (mode / ny, mode % ny);
            let qy = if 2 * ky <= ny { ly * ky as f64 } else { -ly * (ny - ky) as f64 };
            let qx = lx * kx as f64;
            let q = qx.hypot(qy);
            if q == 0.0 {
                return [0.0; 3];
            }
            let (c, s, scale) = (qx / q, qy / q, half * q / (1.0 + m));
            let cross = if 2 * kx == nx || 2 * ky == ny { 0.0 } else { m * c * s };
            [scale * (1.0 + m * c * c), scale * cross, scale * (1.0 + m * s * s)]
        });
        for (field, spectrum) in fields.into_iter().zip(&mut spectra) {
            fourier.inverse(spectrum, field);
        }
    }
}

/// Multiplies the modes of two fields by symmetric matrices `[xx, xy, yy]`.
fn multiply<S: AsMut<[Complex]>>(spectra: &mut [S; 2], weight: impl Fn(usize) -> [f64; 3] + Sync) {
    let [x, y] = spectra;
    let parts = x.as_mut().chunks_mut(MODES).zip(y.as_mut().chunks_mut(MODES)).enumerate();
    chunks::spread(parts, |(part, (x, y))| {
        for (i, (x, y)) in x.iter_mut().zip(y).enumerate() {
            let [xx, xy, yy] = weight(part * MODES + i);
            (*x, *y) = (*x * xx + *y * xy, *x * xy + *y * yy);
        }
    });
}
