//! The coupling of normal and tangential displacements of a half-space.

use super::directed::{SteadyMotion, sign_strip};
use super::free::padded;
use super::{ElasticSolid, element};
use crate::chunks;
use crate::error::{GridError, ProblemError};
use crate::fourier::{Complex, Fourier};
use crate::grid::Grid;

/// The coupling of normal and tangential displacements of a half-space, for Dundurs' `beta = 1`.
///
/// A pressure `p` displaces the surface along `x` and `y` by `-beta S p`, and a traction displaces it into the solid by
/// `beta (S_x tau_x + S_y tau_y)`. For each wave
///
/// `S_j = (2/E*) q_j/(i q^2)`,
///
/// which is `(S p)(x) = (1/E*) int sgn(x - s) p(s) ds` on a line, and the integral of `(1/(pi E*)) x_j/r^2` on a surface. `S` is skew,
/// `<a S b> = -<b S a>`, as the theorem of Betti asks for. A free grid has the sum of the displacements by uniform tractions on elements.
///
/// Memory: two complex weights for each wave of the half spectrum (one on a line), a field and a half spectrum, of the padded grid
/// where it is free.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), Eqs. 2.23 and 3.75 to 3.77; Dundurs, J. Appl. Mech. 36, 650 (1969), for `beta`.
///
/// ```
/// use asperity::Grid;
/// use asperity::elastic::{Coupling, HalfSpace};
/// // on a free line all elements but the one at x itself lie before or behind it
/// let grid = Grid::line(8, 8.0)?.with_periodic([false; 2]);
/// let mut coupling = Coupling::new(&grid, &HalfSpace::new(2.0))?;
/// let pressure = [0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0];
/// let mut along = [0.0; 8];
/// coupling.by_pressure(&pressure, [&mut along, &mut []]);
/// assert!((along[2] + 1.5).abs() < 1e-14 && along[3].abs() < 1e-14 && (along[7] - 1.5).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Coupling {
    grid: Grid,
    padded: Grid,
    /// `S_x` and `S_y` of the modes of the padded grid; the second is empty on a line.
    weights: [Vec<Complex>; 2],
    fourier: Fourier,
    field: Vec<f64>,
    spectra: [Vec<Complex>; 2],
    transforms: u64,
}

impl Coupling {
    /// The coupling on a grid that is periodic or free along all of its axes.
    ///
    /// # Errors
    /// [`GridError::ShearedSolid`] for a solid other than a half-space, and on a surface that is free along one axis only;
    /// [`GridError::TooManyPoints`] if what a free boundary adds is too much.
    pub fn new(grid: &Grid, solid: &dyn ElasticSolid) -> Result<Self, GridError> {
        if !solid.is_half_space() {
            return Err(GridError::ShearedSolid { solid: solid.description() });
        }
        let modulus = solid.contact_modulus();
        let [dy, dx] = grid.spacing();
        match (grid.is_line(), grid.periodic()) {
            (true, [_, true]) | (false, [true, true]) => {
                let axes = if grid.is_line() { 1 } else { 2 };
                Self::periodic(grid, axes, |q, axis| Complex::new(0.0, -2.0 * q[1 - axis] / modulus))
            }
            (true, _) => Self::free(grid, 1, |[_, x], _| sign_strip(x, dx) / modulus),
            (false, [false, false]) => Self::free(grid, 2, |[y, x], axis| match axis {
                0 => element::coupled_rectangle([y, x], [dy, dx], modulus),
                _ => element::coupled_rectangle([x, y], [dx, dy], modulus),
            }),
            _ => Err(GridError::ShearedSolid { solid: "a half-space that is free along one axis".into() }),
        }
    }

    /// The coupling of lines that roll steadily towards `+x`, with the `step` `dq`, a length: `(S p)(x) - (S p)(x + dq)`.
    ///
    /// # Errors
    /// [`ProblemError::NeedsLine`] for a surface, and the errors of [`Coupling::new`].
    pub fn rolling(grid: &Grid, solid: &dyn ElasticSolid, step: f64) -> Result<Self, ProblemError> {
        if !grid.is_line() {
            return Err(ProblemError::NeedsLine { shape: grid.shape() });
        }
        let (modulus, width) = (solid.contact_modulus(), grid.spacing()[1]);
        let motion = SteadyMotion::Rolling { step };
        let ahead = |x: f64| sign_strip(x, width) - sign_strip(x + step, width);
        Ok(match grid.is_periodic() {
            true => Self::periodic(grid, 1, |q, _| motion.factor(q[1]) * Complex::new(0.0, -2.0 * q[1] / modulus)),
            false => Self::free(grid, 1, |[_, x], _| ahead(x) / modulus),
        }?)
    }

    /// The weights `weight(q, axis)/q^2` of the waves `q = [q_y, q_x]`, with the axis 0 for `x`. Waves at the Nyquist wavenumber of an
    /// axis run in no direction along it.
    fn periodic(grid: &Grid, axes: usize, weight: impl Fn([f64; 2], usize) -> Complex) -> Result<Self, GridError> {
        let ([ny, nx], vectors) = (grid.shape(), || grid.wave_vectors().enumerate());
        let weights_along = |axis: usize| {
            let at = |(mode, q): (usize, [f64; 2])| {
                let (kx, ky) = (mode / ny, mode % ny);
                let is_nyquist = [2 * kx == nx, ny > 1 && 2 * ky == ny][axis];
                let square = q[0] * q[0] + q[1] * q[1];
                if square == 0.0 {
                    return Complex::default();
                }
                let weight = weight(q, axis) / square;
                if is_nyquist { Complex::new(weight.re, 0.0) } else { weight }
            };
            vectors().map(at).collect::<Vec<_>>()
        };
        Ok(Self::of_weights(grid, *grid, [0, 1].map(|axis| if axis < axes { weights_along(axis) } else { Vec::new() })))
    }

    /// The weights of the displacement at the distance `[y, x]` from an element, for each axis.
    fn free(grid: &Grid, axes: usize, kernel: impl Fn([f64; 2], usize) -> f64 + Sync) -> Result<Self, GridError> {
        let padded = padded(grid)?;
        let ([my, mx], [dy, dx]) = (padded.shape(), grid.spacing());
        let mut fourier = Fourier::new(&padded);
        let signed = |i: usize, n: usize| match 2 * i {
            twice if twice == n => 0.0,
            twice if twice < n => i as f64,
            _ => i as f64 - n as f64,
        };
        let mut weights_along = |axis: usize| {
            let mut influence = vec![0.0; padded.len()];
            chunks::rows_mut(&mut influence, mx, |y, row| {
                let y = if grid.is_line() { 0.0 } else { dy * signed(y, my) };
                let values = row.iter_mut().enumerate();
                values.for_each(|(x, value)| *value = kernel([y, dx * signed(x, mx)], axis));
            });
            let mut weights = vec![Complex::default(); padded.modes()];
            fourier.forward(&influence, &mut weights);
            weights.iter_mut().for_each(|weight| *weight *= padded.len() as f64);
            weights
        };
        let weights = [0, 1].map(|axis| if axis < axes { weights_along(axis) } else { Vec::new() });
        Ok(Self::of_weights(grid, padded, weights))
    }

    fn of_weights(grid: &Grid, padded: Grid, weights: [Vec<Complex>; 2]) -> Self {
        let spectrum = || vec![Complex::default(); padded.modes()];
        let (fourier, field, spectra) = (Fourier::new(&padded), vec![0.0; padded.len()], [spectrum(), spectrum()]);
        Self { grid: *grid, padded, weights, fourier, field, spectra, transforms: 0 }
    }

    /// Number of transforms so far, forward and inverse.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// Writes `S_x p` and `S_y p`, lengths, of a pressure. The second one is not written on a line.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn by_pressure(&mut self, pressure: &[f64], displacement: [&mut [f64]; 2]) {
        self.forward(pressure, 0);
        for (axis, displacement) in displacement.into_iter().enumerate().take(self.axes()) {
            let [pressure, product] = &mut self.spectra;
            let modes = product.iter_mut().zip(&*pressure).zip(&self.weights[axis]);
            modes.for_each(|((product, mode), weight)| *product = mode * weight);
            self.inverse(1, displacement);
        }
    }

    /// Writes `S_x tau_x + S_y tau_y`, a length, of the tractions along `x` and `y`. The second one may be empty, and is zero then.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn by_traction(&mut self, traction: [&[f64]; 2], displacement: &mut [f64]) {
        let mut sum = std::mem::take(&mut self.spectra[1]);
        sum.fill(Complex::default());
        for (axis, traction) in traction.into_iter().enumerate().filter(|(_, traction)| !traction.is_empty()) {
            self.forward(traction, 0);
            let modes = sum.iter_mut().zip(&self.spectra[0]).zip(&self.weights[axis]);
            modes.for_each(|((sum, mode), weight)| *sum += mode * weight);
        }
        self.spectra[1] = sum;
        self.inverse(1, displacement);
    }

    fn axes(&self) -> usize {
        if self.grid.is_line() { 1 } else { 2 }
    }

    fn forward(&mut self, values: &[f64], spectrum: usize) {
        assert_eq!(values.len(), self.grid.len(), "a field must fit the grid");
        let (from, to) = (self.grid.shape()[1], self.padded.shape()[1]);
        self.field.fill(0.0);
        let rows = self.field.chunks_exact_mut(to).zip(values.chunks_exact(from));
        rows.for_each(|(row, values)| row[..from].copy_from_slice(values));
        self.fourier.forward(&self.field, &mut self.spectra[spectrum]);
        self.transforms += 1;
    }

    fn inverse(&mut self, spectrum: usize, values: &mut [f64]) {
        assert_eq!(values.len(), self.grid.len(), "a field must fit the grid");
        let (from, to) = (self.grid.shape()[1], self.padded.shape()[1]);
        self.fourier.inverse(&mut self.spectra[spectrum], &mut self.field);
        let rows = self.field.chunks_exact(to).zip(values.chunks_exact_mut(from));
        rows.for_each(|(row, values)| values.copy_from_slice(&row[..from]));
        self.transforms += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::HalfSpace;

    /// On grids that are fine enough, a smooth pressure is displaced alike on a free surface and on a wide periodic one; and `S` is skew.
    #[test]
    fn free_and_periodic_surfaces_agree_and_the_coupling_is_skew() {
        let displaced = |periodic: [bool; 2], points: usize, size: f64| {
            let grid = Grid::surface([points, points], [size, size]).unwrap().with_periodic(periodic);
            let mut coupling = Coupling::new(&grid, &HalfSpace::new(1.0)).unwrap();
            let middle = points / 2;
            let at = |i: usize, turn: f64| {
                let [y, x] = [i / points, i % points].map(|i| (i as f64 - middle as f64) * size / points as f64);
                (1.0 + turn * x * y + 0.5 * turn * x) * (-4.0 * (x * x + 0.5 * y * y)).exp()
            };
            let [p, tau] = [0.0, 1.0].map(|turn| (0..grid.len()).map(|i| at(i, turn)).collect::<Vec<f64>>());
            let zeros = || vec![0.0; grid.len()];
            let (mut x, mut y, mut z) = (zeros(), zeros(), zeros());
            coupling.by_pressure(&p, [&mut x, &mut y]);
            coupling.by_traction([&tau, &p], &mut z);
            let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let (there, back) = (sum(&p, &z), -sum(&tau, &x) - sum(&p, &y));
            assert!((there - back).abs() < 1e-12 * there.abs(), "{there} against {back}");
            // the displacement at a node beside the middle, less that on the other side
            let far = points * 3 / 8 / (size as usize / 4);
            [x[middle * points + middle + far] - x[middle * points + middle - far], y[(middle + far) * points + middle]]
        };
        let (free, wide) = (displaced([false; 2], 64, 4.0), displaced([true; 2], 512, 32.0));
        assert!((free[0] / wide[0] - 1.0).abs() < 0.02 && (free[1] / wide[1] - 1.0).abs() < 0.02, "{free:?} {wide:?}");
    }

    /// The closed form near an element and the quadrature far from it join.
    #[test]
    fn the_element_is_the_same_near_and_far() {
        for [y, x] in [[0.0, 64.0], [30.0, 56.6], [63.0, 12.0]] {
            let [near, far] = [0.9999, 1.001]
                .map(|scale| element::coupled_rectangle([y * scale, x * scale], [1.0, 0.7], 1.0) * scale);
            assert!((near / far - 1.0).abs() < 1e-5, "{near} {far}");
        }
    }
}
