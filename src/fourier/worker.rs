//! Work in parallel, each task with scratch of its own.

use super::Real;
use rustfft::num_complex::Complex;

/// Points of the smallest grid that is shared: the pair on 128 x 128 takes 60 us, of which a second core saves what it takes
/// to wake it.
pub(super) const WORTH_SHARING: usize = 1 << 15;

/// Tasks per thread: enough to even out threads of unequal speed.
const TASKS: usize = 4;

/// The scratch of one task.
#[derive(Clone)]
pub(super) struct Worker<T: Real = f64> {
    /// A row of the field.
    pub row: Vec<T>,
    /// A band of rows or columns of the spectrum.
    pub band: Vec<Complex<T>>,
    /// Scratch of the FFTs.
    pub scratch: Vec<Complex<T>>,
}

impl<T: Real> Worker<T> {
    /// Workers for a grid of `points`, at most one for each of `units` that are transformed as a whole; with room for as many
    /// numbers in `row`, `band` and `scratch`.
    pub(crate) fn crew(points: usize, units: usize, [row, band, scratch]: [usize; 3]) -> Vec<Self> {
        let zeros = |n| vec![Complex::new(T::zero(), T::zero()); n];
        let worker = Self { row: vec![T::zero(); row], band: zeros(band), scratch: zeros(scratch) };
        let tasks = if points < WORTH_SHARING { 1 } else { TASKS * rayon::current_num_threads() };
        vec![worker; tasks.min(units)]
    }
}
