//! The half-space in Fourier space.

use crate::fourier::Filter;
use crate::grid::Grid;

/// A flat, frictionless, linearly elastic half-space, periodic over a grid.
///
/// Compliance and stiffness are diagonal in Fourier space, in one and in two dimensions alike:
///
/// `u_q = 2 p_q / (E* |q|)` and `p_q = E* |q| u_q / 2` for `q != 0`,
///
/// with the pressure `p >= 0` in compression, the displacement `u` of the surface positive into the solid, and the contact
/// modulus `E* = E / (1 - nu^2)`. The mean of `u` is a free datum and is returned as zero; a uniform pressure displaces
/// nothing.
///
/// Memory: one half spectrum, which is about one real field, and scratch for some rows and columns per thread.
///
/// # Source
/// Johnson, *Contact Mechanics* (1985), section 13.2; Stanley & Kato, J. Tribol. 119, 481 (1997).
///
/// ```
/// use asperity::{Grid, elastic::HalfSpace};
/// use std::f64::consts::TAU;
/// let grid = Grid::line(16, TAU)?; // wavenumbers 0, 1, 2, ...
/// let pressure: Vec<f64> = grid.x().map(|x| 1.0 + (3.0 * x).cos()).collect();
/// let mut displacement = vec![0.0; grid.len()];
/// HalfSpace::new(&grid, 4.0).displacement(&pressure, &mut displacement);
/// assert!((displacement[0] - 2.0 / (4.0 * 3.0)).abs() < 1e-15);
/// # Ok::<(), asperity::error::GridError>(())
/// ```
pub struct HalfSpace {
    grid: Grid,
    contact_modulus: f64,
    filter: Filter,
    transforms: u64,
}

impl HalfSpace {
    /// Plans the response of a solid of contact modulus `E*` over `grid`.
    pub fn new(grid: &Grid, contact_modulus: f64) -> Self {
        Self { grid: *grid, contact_modulus, filter: Filter::new(grid), transforms: 0 }
    }

    /// Stiffness `k = E* |q| / 2` of each mode, in the order of [`Grid::wavenumbers`]; zero for the mean.
    pub fn stiffnesses(&self) -> impl Iterator<Item = f64> + use<> {
        let modulus = self.contact_modulus;
        self.grid.wavenumbers().map(move |q| 0.5 * modulus * q)
    }

    /// Stiffness of the longest wave.
    pub fn softest_stiffness(&self) -> f64 {
        0.5 * self.contact_modulus * std::f64::consts::TAU / self.grid.longest_wavelength()
    }

    /// Transforms made so far, forward and inverse counted alike: the unit of work of this crate.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// What `work` makes of this half-space, with transforms that do not count.
    pub(crate) fn uncounted<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let transforms = self.transforms;
        let result = work(self);
        self.transforms = transforms;
        result
    }

    /// Writes the displacement under `pressure`, with zero mean: one transform pair.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn displacement(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.respond(pressure, displacement, Self::compliance);
    }

    /// Writes the pressure that makes `displacement`, with zero mean: one transform pair.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn pressure(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.respond(displacement, pressure, Self::stiffness);
    }

    /// Displacement over pressure of a mode of stiffness `k`: a factor for the responses below.
    pub(crate) fn compliance(k: f64) -> f64 {
        if k > 0.0 { 1.0 / k } else { 0.0 }
    }

    /// Pressure over displacement of a mode of stiffness `k`: a factor for the responses below.
    pub(crate) fn stiffness(k: f64) -> f64 {
        k
    }

    /// [`HalfSpace::displacement`] in place.
    pub(crate) fn comply(&mut self, field: &mut [f64]) {
        self.respond_in_place(field, Self::compliance);
    }

    /// [`HalfSpace::pressure`] in place.
    pub(crate) fn stiffen(&mut self, field: &mut [f64]) {
        self.respond_in_place(field, Self::stiffness);
    }

    fn respond_in_place(&mut self, field: &mut [f64], factor: impl Fn(f64) -> f64 + Sync + Send) {
        self.load(field);
        self.scale(factor);
        self.store(field);
    }

    /// Multiplies each mode of `cause` by `factor(k)`.
    pub(crate) fn respond(&mut self, cause: &[f64], effect: &mut [f64], factor: impl Fn(f64) -> f64 + Sync + Send) {
        self.load(cause);
        self.scale(factor);
        self.store(effect);
    }

    /// The number of rows in which [`HalfSpace::respond_by_rows`] takes and gives fields, and their length: the rows of a
    /// surface, or pieces of a line that follow each other.
    pub(crate) fn rows(&self) -> [usize; 2] {
        self.filter.rows()
    }

    /// Multiplies each mode of the cause by `factor(k)`, for fields that need not exist as a whole.
    ///
    /// `fill(r, row)` writes row `r` of the cause to `row`, whose content is undefined before; `store(r, row, sink)` takes row
    /// `r` of the effect with the sink of that row, one of [`HalfSpace::rows`].
    pub(crate) fn respond_by_rows<S: Send>(
        &mut self,
        factor: impl Fn(f64) -> f64 + Sync + Send,
        fill: impl Fn(usize, &mut [f64]) + Sync + Send,
        sinks: &mut [S],
        store: impl Fn(usize, &[f64], &mut S) + Sync + Send,
    ) {
        self.filter.load(fill);
        self.scale(factor);
        self.filter.store(sinks, store);
    }

    fn load(&mut self, cause: &[f64]) {
        assert_eq!(cause.len(), self.grid.len(), "fields must fit the grid");
        let width = self.rows()[1];
        self.filter.load(|r, row| row.copy_from_slice(&cause[r * width..][..width]));
    }

    fn store(&mut self, effect: &mut [f64]) {
        assert_eq!(effect.len(), self.grid.len(), "fields must fit the grid");
        let width = self.rows()[1];
        let mut rows: Vec<_> = effect.chunks_exact_mut(width).collect();
        self.filter.store(&mut rows, |_, row, sink| sink.copy_from_slice(row));
    }

    fn scale(&mut self, factor: impl Fn(f64) -> f64 + Sync + Send) {
        let modulus = self.contact_modulus;
        self.filter.scale(|q| factor(0.5 * modulus * q));
        self.transforms += 2;
    }
}
