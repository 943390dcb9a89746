//! The half spectrum of a field, filtered in place.

use super::Real;
use super::columns::{band_len, for_each_column};
use super::plans::Plans;
use super::wave::Wave;
use super::worker::{WORTH_SHARING, Worker};
use crate::chunks::spread;
use crate::grid::Grid;
use rayon::iter::{IndexedParallelIterator, ParallelIterator, repeat_n};
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// The transforms of the used rows, of `nx/2 + 1` coefficients each, and those of the columns in the same place.
///
/// Bands of columns are transformed, scaled and transformed back while they are in the cache. Only there they have all `ny` rows.
pub(crate) struct SurfaceFilter<T: Real = f64> {
    shape: [usize; 2],
    /// The first rows, which are not all zero and are needed.
    used_rows: usize,
    plans: Plans<T>,
    /// `q_x` of each column and `q_y^2` of each row up to Nyquist; the other rows are their mirror images.
    qx: Vec<f64>,
    qy_squares: Vec<f64>,
    spectrum: Vec<Complex<T>>,
    workers: Vec<Worker<T>>,
}

impl SurfaceFilter {
    /// Wave numbers along y and x of each place.
    pub(crate) fn places(grid: &Grid) -> Vec<[usize; 2]> {
        let [ny, nx] = grid.shape();
        (0..=nx / 2).flat_map(|kx| (0..=ny / 2).map(move |ky| [ky, kx])).collect()
    }
}

impl<T: Real> SurfaceFilter<T> {
    /// Plans the transforms of fields of which only the first `used_rows` are not zero, and only these rows are needed.
    pub(crate) fn new(grid: &Grid, used_rows: usize) -> Self {
        let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
        let plans = Plans::new(grid);
        let workers = Worker::crew(grid.len(), ny, [nx.max(ny / 2 + 1), band_len(ny), plans.scratch_len()]);
        Self {
            shape: [ny, nx],
            used_rows,
            plans,
            qx: (0..=nx / 2).map(|kx| TAU * kx as f64 / lx).collect(),
            qy_squares: (0..=ny / 2).map(|ky| (TAU * ky as f64 / ly).powi(2)).collect(),
            spectrum: zeros(used_rows * (nx / 2 + 1)),
            workers,
        }
    }

    pub(crate) fn rows(&self) -> [usize; 2] {
        [self.used_rows, self.shape[1]]
    }

    pub(crate) fn load(&mut self, fill: impl Fn(usize, &mut [T]) + Sync) {
        let nx = self.shape[1];
        let half = nx / 2 + 1;
        let per_worker = self.used_rows.div_ceil(self.workers.len());
        let tasks = self.spectrum.chunks_mut(per_worker * half).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, (spectra, Worker { row, scratch, .. }))| {
            for (i, spectrum) in spectra.chunks_exact_mut(half).enumerate() {
                let row = &mut row[..nx];
                fill(task * per_worker + i, row);
                // many rows of a light contact carry nothing
                if row.iter().all(|value| *value == T::zero()) {
                    spectrum.fill(Complex::new(T::zero(), T::zero()));
                } else {
                    self.plans.forward_row(row, spectrum, scratch);
                }
            }
        });
    }

    pub(crate) fn scale(&mut self, factor: impl Fn(Wave) -> f64 + Sync) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        let norm = 1.0 / (ny * nx) as f64;
        let qy_squares = &self.qy_squares;
        for_each_column(&mut self.spectrum, [ny, half], &mut self.workers, |kx, column, row, scratch| {
            let factors = &mut row[..qy_squares.len()];
            let square = self.qx[kx].powi(2);
            let first = kx * qy_squares.len();
            factors.iter_mut().zip(qy_squares).enumerate().for_each(|(ky, (f, qy_square))| {
                *f = T::from_double(norm * factor(Wave { q: (square + qy_square).sqrt(), place: first + ky }));
            });
            self.plans.forward_columns.process_with_scratch(column, scratch);
            let (modes, mirrored) = column.split_at_mut(factors.len());
            modes.iter_mut().zip(&*factors).for_each(|(mode, &f)| *mode = *mode * f);
            mirrored.iter_mut().rev().zip(&factors[1..]).for_each(|(mode, &f)| *mode = *mode * f);
            self.plans.inverse_columns.process_with_scratch(column, scratch);
        });
    }

    pub(crate) fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &mut [T], &mut S) + Sync) {
        let nx = self.shape[1];
        let half = nx / 2 + 1;
        let per_worker = self.used_rows.div_ceil(self.workers.len());
        let spectra = self.spectrum.chunks_mut(per_worker * half);
        let tasks = spectra.zip(sinks.chunks_mut(per_worker)).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, ((spectra, sinks), Worker { row, scratch, .. }))| {
            for (i, (spectrum, sink)) in spectra.chunks_exact_mut(half).zip(sinks).enumerate() {
                self.plans.inverse_row(spectrum, &mut row[..nx], scratch);
                store(task * per_worker + i, &mut row[..nx], sink);
            }
        });
    }
}

/// A spectrum of zeros. Its memory is first touched here, by all threads.
fn zeros<T: Real>(modes: usize) -> Vec<Complex<T>> {
    let zero = Complex::new(T::zero(), T::zero());
    repeat_n(zero, modes).with_min_len(WORTH_SHARING).collect()
}
