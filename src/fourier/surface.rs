//! The half spectrum of a field, filtered in place.

use super::Complex;
use super::columns::{band_len, for_each_column};
use super::pair::drop_rounding;
use super::worker::{Worker, share};
use crate::grid::Grid;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The transforms of the rows, `ny` rows of `nx/2 + 1` coefficients, and those of the columns in the same place.
///
/// Bands of columns are transformed, scaled and transformed back while they are in the cache.
pub(crate) struct SurfaceFilter {
    shape: [usize; 2],
    forward_rows: Arc<dyn RealToComplex<f64>>,
    inverse_rows: Arc<dyn ComplexToReal<f64>>,
    forward_columns: Arc<dyn Fft<f64>>,
    inverse_columns: Arc<dyn Fft<f64>>,
    /// `q_x` of each column and `q_y^2` of each row.
    qx: Vec<f64>,
    qy_squares: Vec<f64>,
    spectrum: Vec<Complex>,
    workers: Vec<Worker>,
}

impl SurfaceFilter {
    pub fn new(grid: &Grid) -> Self {
        let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
        let (mut rows, mut columns) = (RealFftPlanner::new(), FftPlanner::new());
        let (forward_rows, inverse_rows) = (rows.plan_fft_forward(nx), rows.plan_fft_inverse(nx));
        let (forward_columns, inverse_columns) = (columns.plan_fft_forward(ny), columns.plan_fft_inverse(ny));
        let scratch = [
            forward_rows.get_scratch_len(),
            inverse_rows.get_scratch_len(),
            forward_columns.get_inplace_scratch_len(),
            inverse_columns.get_inplace_scratch_len(),
        ];
        let scratch = scratch.into_iter().fold(0, usize::max);
        Self {
            shape: [ny, nx],
            forward_rows,
            inverse_rows,
            forward_columns,
            inverse_columns,
            qx: (0..=nx / 2).map(|kx| TAU * kx as f64 / lx).collect(),
            qy_squares: (0..ny).map(|ky| (TAU * ky.min(ny - ky) as f64 / ly).powi(2)).collect(),
            spectrum: vec![Complex::default(); grid.modes()],
            workers: Worker::crew(grid.len(), ny, [nx, band_len(ny), scratch]),
        }
    }

    pub fn rows(&self) -> [usize; 2] {
        self.shape
    }

    pub fn load(&mut self, fill: impl Fn(usize, &mut [f64]) + Sync + Send) {
        let [ny, nx] = self.shape;
        let (half, fft) = (nx / 2 + 1, &self.forward_rows);
        let per_worker = ny.div_ceil(self.workers.len());
        let tasks = self.spectrum.chunks_mut(per_worker * half).zip(&mut self.workers).enumerate();
        share(tasks, |(task, (spectra, Worker { row, scratch, .. }))| {
            for (i, spectrum) in spectra.chunks_exact_mut(half).enumerate() {
                fill(task * per_worker + i, row);
                fft.process_with_scratch(row, spectrum, scratch).expect("lengths were planned together");
            }
        });
    }

    pub fn scale(&mut self, factor: impl Fn(f64) -> f64 + Sync + Send) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        let norm = 1.0 / (ny * nx) as f64;
        for_each_column(&mut self.spectrum, half, &mut self.workers, |kx, column, scratch| {
            self.forward_columns.process_with_scratch(column, scratch);
            let square = self.qx[kx].powi(2);
            for (mode, qy_square) in column.iter_mut().zip(&self.qy_squares) {
                *mode *= norm * factor((square + qy_square).sqrt());
            }
            self.inverse_columns.process_with_scratch(column, scratch);
        });
    }

    pub fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &[f64], &mut S) + Sync + Send) {
        let [ny, nx] = self.shape;
        let (half, fft) = (nx / 2 + 1, &self.inverse_rows);
        let per_worker = ny.div_ceil(self.workers.len());
        let spectra = self.spectrum.chunks_mut(per_worker * half);
        let tasks = spectra.zip(sinks.chunks_mut(per_worker)).zip(&mut self.workers).enumerate();
        share(tasks, |(task, ((spectra, sinks), Worker { row, scratch, .. }))| {
            for (i, (spectrum, sink)) in spectra.chunks_exact_mut(half).zip(sinks).enumerate() {
                drop_rounding(spectrum, nx);
                fft.process_with_scratch(spectrum, row, scratch).expect("lengths were planned together");
                store(task * per_worker + i, row, sink);
            }
        });
    }
}
