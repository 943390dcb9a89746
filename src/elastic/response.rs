//! A solid over a grid, in Fourier space.

use super::solid::stiffness;
use super::{Compliance, Convolution, ElasticSolid};
use crate::error::GridError;
use crate::grid::Grid;
use std::sync::Arc;

/// The response of an elastic solid on a grid: the displacement `u` by a pressure `p`, and an approximate inverse.
///
/// On a periodic grid both are diagonal in Fourier space, in one and in two dimensions: with the [`ElasticSolid`]'s
/// `factor`,
///
/// `u_q = factor(q) 2 p_q / (E* |q|)` for `q != 0`,
///
/// with the pressure `p >= 0` in compression, the displacement `u` of the surface positive into the solid, and the
/// contact modulus `E* = E / (1 - nu^2)`. There the mean of `u` is a datum and is returned as zero, unless the
/// [`Compliance`] was made to keep it; and the inverse is exact except for the mean.
///
/// Along a free axis there is no pressure outside the cell: `u` is the sum of the displacements by a uniform pressure
/// on each element, computed by a convolution padded with zeros (Liu, Wang & Liu 2000), or on large free surfaces as the sum of a near
/// part on a slightly larger grid and a smooth part on a coarse one, to rounding. Its inverse is approximated by
/// that of the periodic solid.
///
/// Memory: one half spectrum, which is about one real field, and scratch for some rows and columns per thread; where an axis is free
/// one field more and a half spectrum that is twice as large for each such axis, or on large free surfaces two fields in all.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 13.2; Stanley & Kato, J. Tribol. 119, 481 (1997); Liu, Wang & Liu, Wear 243, 101
/// (2000).
///
/// ```
/// use asperity::{Grid, elastic::Response};
/// use std::f64::consts::TAU;
/// let grid = Grid::line(16, TAU)?; // wavenumbers 0, 1, 2, ...
/// let pressure: Vec<f64> = grid.x().map(|x| 1.0 + (3.0 * x).cos()).collect();
/// let mut displacement = vec![0.0; grid.len()];
/// Response::half_space(&grid, 4.0).displacement(&pressure, &mut displacement);
/// assert!((displacement[0] - 2.0 / (4.0 * 3.0)).abs() < 1e-15);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
pub struct Response {
    waves: Convolution<f64>,
    transforms: u64,
}

impl Response {
    /// Plans the response of a solid over a grid.
    ///
    /// # Errors
    /// The errors of [`Compliance::new`].
    pub fn new(grid: &Grid, solid: impl Into<Arc<dyn ElasticSolid>>) -> Result<Self, GridError> {
        Ok(Self::from_compliance(Arc::new(Compliance::new(grid, solid.into(), true)?)))
    }

    /// Plans the response of a half-space of contact modulus `E*` over a periodic grid.
    ///
    /// # Panics
    /// If the grid is not periodic.
    pub fn half_space(grid: &Grid, contact_modulus: f64) -> Self {
        Self::from_compliance(Arc::new(Compliance::half_space(grid, contact_modulus)))
    }

    /// The response that a compliance makes; transforms are planned on first use.
    pub fn from_compliance(compliance: Arc<Compliance>) -> Self {
        Self { waves: Convolution::new(compliance, 1.0), transforms: 0 }
    }

    /// Stiffness of each mode of the periodic solid, in the order of [`Grid::wavenumbers`]; zero for the mean. Of a half-space it is
    /// `k = E* |q| / 2`.
    pub fn stiffnesses(&self) -> impl Iterator<Item = f64> + use<> {
        let compliance = self.waves.compliance().clone();
        compliance.grid.wavenumbers().map(move |q| stiffness(compliance.solid.as_ref(), q))
    }

    /// Stiffness of the softest wave.
    pub fn softest_stiffness(&self) -> f64 {
        self.waves.compliance().stiffness_range()[0]
    }

    /// Whether waves are independent, as on periodic grids.
    pub fn is_diagonal(&self) -> bool {
        self.waves.compliance().is_diagonal()
    }

    /// Number of transforms so far, forward and inverse: the unit of work of this crate. A padded transform for a free
    /// boundary counts as one.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// The result of `work` on this response, with transforms that do not count.
    pub(crate) fn uncounted<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let transforms = self.transforms;
        let result = work(self);
        self.transforms = transforms;
        result
    }

    /// Writes the displacement under `pressure`: one transform pair.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.check(pressure, displacement);
        let width = self.rows()[1];
        let fill = |r: usize, row: &mut [f64]| row.copy_from_slice(&pressure[r * width..][..width]);
        let mut rows: Vec<_> = displacement.chunks_exact_mut(width).collect();
        self.displace_by_rows(fill, &mut rows, |_, row, sink| sink.copy_from_slice(row));
    }

    /// Writes the pressure that makes `displacement`, with zero mean: one transform pair. If an axis is free, it is
    /// that of the periodic solid, which is a good approximation for waves that are short compared with the cell.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn pressure(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.respond(displacement, pressure, |k| k);
    }

    /// Multiplies each mode of `cause` by `factor(k)` with its stiffness `k` in the periodic solid, which is zero for the mean: one
    /// transform pair.
    pub(crate) fn respond(&mut self, cause: &[f64], effect: &mut [f64], factor: impl Fn(f64) -> f64 + Sync) {
        self.check(cause, effect);
        self.transforms += 2;
        let width = self.rows()[1];
        let fill = |r: usize, row: &mut [f64]| row.copy_from_slice(&cause[r * width..][..width]);
        let mut rows: Vec<_> = effect.chunks_exact_mut(width).collect();
        self.waves.multiply(factor, false, fill, &mut rows, |_, row, sink| sink.copy_from_slice(row));
    }

    fn check(&self, cause: &[f64], effect: &[f64]) {
        let n = self.waves.compliance().grid.len();
        assert_eq!((cause.len(), effect.len()), (n, n), "cause and effect must fit the grid");
    }

    /// The rows of [`Convolution::rows`].
    pub(crate) fn rows(&self) -> [usize; 2] {
        self.waves.rows()
    }

    /// Frees the memory of the transforms until they are used again.
    pub(crate) fn release(&mut self) {
        self.waves.release();
    }

    /// The displacement under a pressure, see [`Convolution::displace`]: one transform pair.
    pub(crate) fn displace_by_rows<S: Send>(
        &mut self,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[f64], &mut S) + Sync,
    ) {
        self.transforms += 2;
        self.waves.displace(fill, sinks, store);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::HalfSpace;

    fn noise(n: usize) -> Vec<f64> {
        (0..n).map(|i| ((i % 1009 * (i % 911)) as f64 * 0.7).sin() + 0.3).collect()
    }

    /// Lines in one piece and in many, surfaces on one core and on many, periodic and free.
    fn grids() -> Vec<Grid> {
        let periodic = [
            Grid::line(31, 0.5).unwrap(),
            Grid::line(1 << 16, 2.0).unwrap(),
            Grid::line(2 * 3 * 5 * 7 * 11 * 31, 2.0).unwrap(),
            Grid::surface([7, 5], [2.0, 1.0]).unwrap(),
            Grid::surface([4, 37], [1.0, 1.0]).unwrap(),
            Grid::surface([181, 200], [1.0, 3.0]).unwrap(),
        ];
        let free = |grid: &Grid| grid.with_periodic([false; 2]);
        periodic.into_iter().chain(periodic[..1].iter().map(free)).chain(periodic[2..].iter().map(free)).collect()
    }

    fn displacement(grid: &Grid, pressure: &[f64]) -> Vec<f64> {
        let mut displacement = vec![0.0; grid.len()];
        Response::new(grid, HalfSpace::new(3.0)).unwrap().displacement(pressure, &mut displacement);
        displacement
    }

    #[test]
    fn rows_of_a_contact_set_respond_as_the_whole_field() {
        for grid in grids() {
            let mut response = Response::new(&grid, HalfSpace::new(3.0)).unwrap();
            let [count, width] = response.rows();
            assert_eq!(count * width, grid.len());
            let is_in = |i: usize| i % 7 < 2;
            let mut field = noise(grid.len());
            (0..field.len()).filter(|&i| !is_in(i)).for_each(|i| field[i] = 0.0);
            let fill = |r: usize, row: &mut [f64]| {
                row.fill(0.0);
                (0..width).filter(|c| is_in(r * width + c)).for_each(|c| row[c] = field[r * width + c]);
            };
            let mut sinks = vec![Vec::new(); count];
            response.displace_by_rows(fill, &mut sinks, |r, row, sink: &mut Vec<f64>| {
                sink.extend((0..width).filter(|c| is_in(r * width + c)).map(|c| row[c]));
            });
            let dense = displacement(&grid, &field);
            let expected: Vec<f64> = (0..grid.len()).filter(|&i| is_in(i)).map(|i| dense[i]).collect();
            assert_eq!(sinks.concat(), expected, "{grid:?}");
        }
    }

    #[test]
    fn a_response_counts_two_transforms_unless_uncounted() {
        let grid = Grid::surface([4, 6], [1.0, 1.0]).unwrap();
        let (mut response, pressure, mut displacement) = (Response::half_space(&grid, 1.0), noise(24), noise(24));
        response.displacement(&pressure, &mut displacement);
        assert_eq!(response.transforms(), 2);
        let same = response.uncounted(|response| {
            response.displacement(&pressure, &mut displacement);
            response.transforms()
        });
        assert_eq!((same, response.transforms()), (4, 2));
    }
}
