//! Work in parallel, each task with scratch of its own.

use super::Complex;
use rayon::prelude::*;

/// Points below which waking another core costs more than it saves.
const WORTH_SHARING: usize = 1 << 12;

/// Tasks per thread: enough to even out threads of unequal speed.
const TASKS: usize = 4;

/// The scratch of one task.
#[derive(Clone)]
pub(super) struct Worker {
    pub row: Vec<f64>,
    pub band: Vec<Complex>,
    pub scratch: Vec<Complex>,
}

impl Worker {
    /// Workers for a grid of `points`, at most one for each of `units` that are transformed as a whole; with room for `row`
    /// numbers, a band of `band` and FFT scratch of `scratch` complex numbers.
    pub fn crew(points: usize, units: usize, [row, band, scratch]: [usize; 3]) -> Vec<Self> {
        let zeros = |n| vec![Complex::default(); n];
        let worker = Self { row: vec![0.0; row], band: zeros(band), scratch: zeros(scratch) };
        let tasks = if points < WORTH_SHARING { 1 } else { TASKS * rayon::current_num_threads() };
        vec![worker; tasks.min(units)]
    }
}

/// Does all `tasks`: here if there is one, else on all threads.
pub(super) fn share<T: Send>(tasks: impl ExactSizeIterator<Item = T>, work: impl Fn(T) + Sync + Send) {
    if tasks.len() == 1 {
        tasks.for_each(work);
    } else {
        tasks.collect::<Vec<_>>().into_par_iter().with_max_len(1).for_each(work);
    }
}
