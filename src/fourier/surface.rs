//! The half spectrum of a field, filtered in place.

use super::Complex;
use super::columns::{band_len, for_each_column};
use super::plans::Plans;
use super::worker::{Worker, share};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// The transforms of the rows, `ny` rows of `nx/2 + 1` coefficients, and those of the columns in the same place.
///
/// Bands of columns are transformed, scaled and transformed back while they are in the cache.
pub(crate) struct SurfaceFilter {
    shape: [usize; 2],
    plans: Plans,
    /// `q_x` of each column and `q_y^2` of each row.
    qx: Vec<f64>,
    qy_squares: Vec<f64>,
    spectrum: Vec<Complex>,
    workers: Vec<Worker>,
}

impl SurfaceFilter {
    pub fn new(grid: &Grid) -> Self {
        let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
        let plans = Plans::new(grid);
        let workers = Worker::crew(grid.len(), ny, [nx, band_len(ny), plans.scratch_len()]);
        Self {
            shape: [ny, nx],
            plans,
            qx: (0..=nx / 2).map(|kx| TAU * kx as f64 / lx).collect(),
            qy_squares: (0..ny).map(|ky| (TAU * ky.min(ny - ky) as f64 / ly).powi(2)).collect(),
            spectrum: vec![Complex::default(); grid.modes()],
            workers,
        }
    }

    pub fn rows(&self) -> [usize; 2] {
        self.shape
    }

    pub fn load(&mut self, fill: impl Fn(usize, &mut [f64]) + Sync + Send) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        let per_worker = ny.div_ceil(self.workers.len());
        let tasks = self.spectrum.chunks_mut(per_worker * half).zip(&mut self.workers).enumerate();
        share(tasks, |(task, (spectra, Worker { row, scratch, .. }))| {
            for (i, spectrum) in spectra.chunks_exact_mut(half).enumerate() {
                fill(task * per_worker + i, row);
                self.plans.forward_row(row, spectrum, scratch);
            }
        });
    }

    pub fn scale(&mut self, factor: impl Fn(f64) -> f64 + Sync + Send) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        let norm = 1.0 / (ny * nx) as f64;
        for_each_column(&mut self.spectrum, half, &mut self.workers, |kx, column, scratch| {
            self.plans.forward_columns.process_with_scratch(column, scratch);
            let square = self.qx[kx].powi(2);
            for (mode, qy_square) in column.iter_mut().zip(&self.qy_squares) {
                *mode *= norm * factor((square + qy_square).sqrt());
            }
            self.plans.inverse_columns.process_with_scratch(column, scratch);
        });
    }

    pub fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &[f64], &mut S) + Sync + Send) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        let per_worker = ny.div_ceil(self.workers.len());
        let spectra = self.spectrum.chunks_mut(per_worker * half);
        let tasks = spectra.zip(sinks.chunks_mut(per_worker)).zip(&mut self.workers).enumerate();
        share(tasks, |(task, ((spectra, sinks), Worker { row, scratch, .. }))| {
            for (i, (spectrum, sink)) in spectra.chunks_exact_mut(half).zip(sinks).enumerate() {
                self.plans.inverse_row(spectrum, row, scratch);
                store(task * per_worker + i, row, sink);
            }
        });
    }
}
