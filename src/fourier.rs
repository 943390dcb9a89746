//! The real Fourier transform of fields on a [`Grid`], with both cores and without allocation after planning.
//!
//! # Conventions
//! For a field `f` of `n = ny nx` points
//!
//! - forward: `f_q = (1/n) sum_x f(x) exp(-i q x)`, so the coefficient of `q = 0` is the mean;
//! - inverse: `f(x) = sum_q f_q exp(i q x)`, so the pair is the identity.
//!
//! Since `f` is real, only `q_x >= 0` is stored: `(nx/2 + 1) * ny` coefficients, **`q_x` outside, `q_y` inside** (index
//! `kx * ny + ky`), which saves one of two transposes per transform. For a line that is just `kx`.

use crate::grid::Grid;
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// A complex Fourier coefficient.
pub type Complex = rustfft::num_complex::Complex<f64>;

/// Columns (forward) or rows (inverse) that are transposed and transformed together: eight complex numbers span two cache
/// lines, so each gather reads whole lines; more would leave the second-level cache sooner.
const BAND: usize = 8;

/// A planned transform pair for one grid, with its scratch.
///
/// Memory: one half spectrum (about one real field) for surfaces, one row for lines, and `BAND` rows and columns per thread.
pub struct Fourier {
    shape: [usize; 2],
    forward_rows: Arc<dyn RealToComplex<f64>>,
    inverse_rows: Arc<dyn ComplexToReal<f64>>,
    columns: Option<Columns>,
    workers: Vec<Worker>,
    transforms: u64,
}

/// What a surface needs beyond its rows.
struct Columns {
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    row_spectra: Vec<Complex>,
}

/// The scratch of one thread.
struct Worker {
    row: Vec<f64>,
    band: Vec<Complex>,
    scratch: Vec<Complex>,
}

impl Fourier {
    /// Plans the transforms of fields on `grid`.
    pub fn new(grid: &Grid) -> Self {
        let [ny, nx] = grid.shape();
        let mut rows = RealFftPlanner::new();
        let forward_rows = rows.plan_fft_forward(nx);
        let inverse_rows = rows.plan_fft_inverse(nx);
        let columns = (ny > 1).then(|| {
            let mut planner = FftPlanner::new();
            Columns {
                forward: planner.plan_fft_forward(ny),
                inverse: planner.plan_fft_inverse(ny),
                row_spectra: vec![Complex::default(); grid.modes()],
            }
        });
        let scratch = [
            forward_rows.get_scratch_len(),
            inverse_rows.get_scratch_len(),
            columns.as_ref().map_or(0, |c| c.forward.get_inplace_scratch_len()),
            columns.as_ref().map_or(0, |c| c.inverse.get_inplace_scratch_len()),
        ];
        let scratch = scratch.into_iter().max().unwrap_or(0);
        let threads = if ny > 1 { rayon::current_num_threads().min(ny) } else { 1 };
        let workers = (0..threads)
            .map(|_| Worker {
                row: vec![0.0; nx],
                band: vec![Complex::default(); BAND.min(ny) * (nx / 2 + 1)],
                scratch: vec![Complex::default(); scratch],
            })
            .collect();
        Self { shape: [ny, nx], forward_rows, inverse_rows, columns, workers, transforms: 0 }
    }

    /// Transforms made so far, forward and inverse counted alike: the unit of work of this crate.
    pub fn transforms(&self) -> u64 {
        self.transforms
    }

    /// Writes the coefficients of `field` (`ny * nx` values, row by row) to `spectrum`.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn forward(&mut self, field: &[f64], spectrum: &mut [Complex]) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        assert_eq!((field.len(), spectrum.len()), (ny * nx, ny * half), "field and spectrum must fit the grid");
        self.transforms += 1;
        let scale = 1.0 / (ny * nx) as f64;
        let rows = &self.forward_rows;
        let Some(columns) = &mut self.columns else {
            let worker = &mut self.workers[0];
            forward_row(rows.as_ref(), field, spectrum, worker);
            spectrum.iter_mut().for_each(|c| *c *= scale);
            return;
        };
        let per_worker = ny.div_ceil(self.workers.len());
        field
            .par_chunks(per_worker * nx)
            .zip(columns.row_spectra.par_chunks_mut(per_worker * half))
            .zip(&mut self.workers)
            .for_each(|((field, spectra), worker)| {
                for (row, spectrum) in field.chunks_exact(nx).zip(spectra.chunks_exact_mut(half)) {
                    forward_row(rows.as_ref(), row, spectrum, worker);
                }
            });
        let (fft, row_spectra) = (&columns.forward, &columns.row_spectra);
        let per_worker = half.div_ceil(self.workers.len());
        spectrum.par_chunks_mut(per_worker * ny).zip(&mut self.workers).enumerate().for_each(
            |(task, (spectrum, worker))| {
                for (band, columns) in spectrum.chunks_mut(BAND * ny).enumerate() {
                    gather(row_spectra, half, task * per_worker + band * BAND, columns, ny, scale);
                    for column in columns.chunks_exact_mut(ny) {
                        fft.process_with_scratch(column, &mut worker.scratch);
                    }
                }
            },
        );
    }

    /// Writes the field with the coefficients `spectrum` to `field`; `spectrum` serves as scratch and is lost.
    ///
    /// # Panics
    /// If a length does not fit the grid.
    pub fn inverse(&mut self, spectrum: &mut [Complex], field: &mut [f64]) {
        let [ny, nx] = self.shape;
        let half = nx / 2 + 1;
        assert_eq!((field.len(), spectrum.len()), (ny * nx, ny * half), "field and spectrum must fit the grid");
        self.transforms += 1;
        let rows = &self.inverse_rows;
        let Some(columns) = &self.columns else {
            inverse_row(rows.as_ref(), spectrum, field, &mut self.workers[0].scratch);
            return;
        };
        let fft = &columns.inverse;
        let per_worker = half.div_ceil(self.workers.len());
        spectrum.par_chunks_mut(per_worker * ny).zip(&mut self.workers).for_each(|(spectrum, worker)| {
            for column in spectrum.chunks_exact_mut(ny) {
                fft.process_with_scratch(column, &mut worker.scratch);
            }
        });
        let spectrum = &*spectrum;
        let per_worker = ny.div_ceil(self.workers.len());
        field.par_chunks_mut(per_worker * nx).zip(&mut self.workers).enumerate().for_each(|(task, (field, worker))| {
            for (i, rows_of_band) in field.chunks_mut(BAND * nx).enumerate() {
                let band = &mut worker.band[..rows_of_band.len() / nx * half];
                gather(spectrum, ny, task * per_worker + i * BAND, band, half, 1.0);
                for (spectrum, row) in band.chunks_exact_mut(half).zip(rows_of_band.chunks_exact_mut(nx)) {
                    inverse_row(rows.as_ref(), spectrum, row, &mut worker.scratch);
                }
            }
        });
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

fn forward_row(fft: &dyn RealToComplex<f64>, row: &[f64], spectrum: &mut [Complex], worker: &mut Worker) {
    worker.row.copy_from_slice(row);
    fft.process_with_scratch(&mut worker.row, spectrum, &mut worker.scratch).expect("lengths were planned together");
}

/// The coefficients at 0 and Nyquist of a real row are real; what rounding left of their imaginary parts is dropped.
fn inverse_row(fft: &dyn ComplexToReal<f64>, spectrum: &mut [Complex], row: &mut [f64], scratch: &mut [Complex]) {
    spectrum[0].im = 0.0;
    if row.len().is_multiple_of(2) {
        spectrum[row.len() / 2].im = 0.0;
    }
    fft.process_with_scratch(spectrum, row, scratch).expect("lengths were planned together");
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn noise(n: usize) -> Vec<f64> {
        (0..n).map(|i| ((i * i) as f64 * 0.7).sin()).collect()
    }

    /// The definition, term by term.
    fn direct(field: &[f64], [ny, nx]: [usize; 2]) -> Vec<Complex> {
        let coefficient = |kx: usize, ky: usize| {
            let mut sum = Complex::default();
            for (i, &f) in field.iter().enumerate() {
                let phase = TAU * ((kx * (i % nx)) as f64 / nx as f64 + (ky * (i / nx)) as f64 / ny as f64);
                sum += Complex::from_polar(f, -phase);
            }
            sum / (nx * ny) as f64
        };
        (0..=nx / 2).flat_map(|kx| (0..ny).map(move |ky| coefficient(kx, ky))).collect()
    }

    #[test]
    fn forward_is_the_definition_and_inverse_undoes_it_on_awkward_grids() {
        let grids = [[1, 4], [1, 5], [1, 31], [4, 4], [7, 5], [12, 16], [5, 12], [17, 9], [33, 4], [4, 37]];
        for shape in grids {
            let grid = if shape[0] == 1 {
                Grid::line(shape[1], 1.0).unwrap()
            } else {
                Grid::surface(shape, [1.0, 2.0]).unwrap()
            };
            let field = noise(grid.len());
            let mut fourier = Fourier::new(&grid);
            let mut spectrum = vec![Complex::default(); grid.modes()];
            fourier.forward(&field, &mut spectrum);
            for (fast, slow) in spectrum.iter().zip(direct(&field, shape)) {
                assert!((fast - slow).norm() < 1e-14, "{shape:?}: {fast} against {slow}");
            }
            let mut back = vec![0.0; grid.len()];
            fourier.inverse(&mut spectrum, &mut back);
            for (a, b) in field.iter().zip(&back) {
                assert!((a - b).abs() < 1e-14, "{shape:?}: {a} against {b}");
            }
            assert_eq!(fourier.transforms(), 2);
        }
    }
}
