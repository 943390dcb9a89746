//! The plain transform pair.

use super::Complex;
use super::plans::Plans;
use super::worker::Worker;
use crate::chunks::spread;
use crate::grid::Grid;

/// Columns (forward) or rows (inverse) that are gathered and transformed together: eight complex numbers span two cache
/// lines, so each gather reads whole lines.
const BAND: usize = 8;

/// A planned transform pair for one grid, with its scratch.
///
/// Memory: some rows and columns per thread; [`Fourier::forward`] of a surface takes one half spectrum more while it runs.
pub struct Fourier {
    shape: [usize; 2],
    plans: Plans,
    workers: Vec<Worker>,
}

impl Fourier {
    /// Plans the transforms of fields on `grid`.
    pub fn new(grid: &Grid) -> Self {
        let [ny, nx] = grid.shape();
        let plans = Plans::new(grid);
        let workers = Worker::crew(grid.len(), ny, [nx, BAND.min(ny) * (nx / 2 + 1), plans.scratch_len()]);
        Self { shape: [ny, nx], plans, workers }
    }

    /// Writes the coefficients of `field` (`ny * nx` values, row by row) to `spectrum`.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn forward(&mut self, field: &[f64], spectrum: &mut [Complex]) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        assert_eq!((field.len(), spectrum.len()), (ny * nx, ny * half), "field and spectrum must fit the grid");
        if ny == 1 {
            return self.forward_line(field, spectrum);
        }
        let mut by_rows = vec![Complex::default(); ny * half];
        let per_worker = ny.div_ceil(self.workers.len());
        let tasks = field.chunks(per_worker * nx).zip(by_rows.chunks_mut(per_worker * half)).zip(&mut self.workers);
        spread(tasks, |((field, spectra), Worker { row, scratch, .. })| {
            for (values, spectrum) in field.chunks_exact(nx).zip(spectra.chunks_exact_mut(half)) {
                row.copy_from_slice(values);
                self.plans.forward_row(row, spectrum, scratch);
            }
        });
        let scale = 1.0 / (ny * nx) as f64;
        let per_worker = half.div_ceil(self.workers.len());
        let tasks = spectrum.chunks_mut(per_worker * ny).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, (spectrum, worker))| {
            for (band, columns) in spectrum.chunks_mut(BAND * ny).enumerate() {
                gather(&by_rows, half, task * per_worker + band * BAND, columns, ny, scale);
                self.plans.forward_columns.process_with_scratch(columns, &mut worker.scratch);
            }
        });
    }

    /// Writes the field with the coefficients `spectrum` to `field`; `spectrum` serves as scratch and is lost.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn inverse(&mut self, spectrum: &mut [Complex], field: &mut [f64]) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        assert_eq!((field.len(), spectrum.len()), (ny * nx, ny * half), "field and spectrum must fit the grid");
        if ny == 1 {
            return self.plans.inverse_row(spectrum, field, &mut self.workers[0].scratch);
        }
        let per_worker = half.div_ceil(self.workers.len());
        spread(spectrum.chunks_mut(per_worker * ny).zip(&mut self.workers), |(spectrum, worker)| {
            self.plans.inverse_columns.process_with_scratch(spectrum, &mut worker.scratch);
        });
        let spectrum = &*spectrum;
        let per_worker = ny.div_ceil(self.workers.len());
        let tasks = field.chunks_mut(per_worker * nx).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, (field, Worker { band, scratch, .. }))| {
            for (i, rows) in field.chunks_mut(BAND * nx).enumerate() {
                let band = &mut band[..rows.len() / nx * half];
                gather(spectrum, ny, task * per_worker + i * BAND, band, half, 1.0);
                for (spectrum, row) in band.chunks_exact_mut(half).zip(rows.chunks_exact_mut(nx)) {
                    self.plans.inverse_row(spectrum, row, scratch);
                }
            }
        });
    }

    /// A line is one row, which needs no columns.
    fn forward_line(&mut self, field: &[f64], spectrum: &mut [Complex]) {
        let Worker { row, scratch, .. } = &mut self.workers[0];
        row.copy_from_slice(field);
        self.plans.forward_row(row, spectrum, scratch);
        let scale = 1.0 / field.len() as f64;
        spectrum.iter_mut().for_each(|mode| *mode *= scale);
    }
}

/// `to[c][r] = scale * from[r][first + c]`, for `from` with rows of `width` and `to` with rows of `length`.
fn gather(from: &[Complex], width: usize, first: usize, to: &mut [Complex], length: usize, scale: f64) {
    let count = to.len() / length;
    for (r, row) in from.chunks_exact(width).enumerate() {
        for (c, &value) in row[first..first + count].iter().enumerate() {
            to[c * length + r] = value * scale;
        }
    }
}
