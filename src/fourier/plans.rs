//! The one-dimensional transforms of a grid.

use super::Real;
use super::real::Planners;
use crate::grid::Grid;
use realfft::{ComplexToReal, RealToComplex};
use rustfft::Fft;
use rustfft::num_complex::Complex;
use std::sync::{Arc, PoisonError};

/// Plans of at most so many points are kept for the next grid. They take 32 bytes per point, and to make one takes as long as some
/// transforms. Longer ones would take memory that is missed elsewhere.
const LONGEST_KEPT: usize = 1 << 15;

/// Transforms of the rows of a real field and of the columns of their half spectra, without scale.
pub(super) struct Plans<T: Real = f64> {
    forward_rows: Arc<dyn RealToComplex<T>>,
    inverse_rows: Arc<dyn ComplexToReal<T>>,
    pub forward_columns: Arc<dyn Fft<T>>,
    pub inverse_columns: Arc<dyn Fft<T>>,
}

impl<T: Real> Plans<T> {
    pub(crate) fn new(grid: &Grid) -> Self {
        let [ny, nx] = grid.shape();
        if ny.max(nx) > LONGEST_KEPT {
            return Self::by(&mut Planners::new(), [ny, nx]);
        }
        let mut planners = T::planners().lock().unwrap_or_else(PoisonError::into_inner);
        Self::by(&mut planners, [ny, nx])
    }

    fn by(Planners { rows, columns }: &mut Planners<T>, [ny, nx]: [usize; 2]) -> Self {
        Self {
            forward_rows: rows.plan_fft_forward(nx),
            inverse_rows: rows.plan_fft_inverse(nx),
            forward_columns: columns.plan_fft_forward(ny),
            inverse_columns: columns.plan_fft_inverse(ny),
        }
    }

    /// Complex numbers of scratch that the largest of the transforms needs.
    pub(crate) fn scratch_len(&self) -> usize {
        let rows = self.forward_rows.get_scratch_len().max(self.inverse_rows.get_scratch_len());
        let columns = [&self.forward_columns, &self.inverse_columns].map(|fft| fft.get_inplace_scratch_len());
        rows.max(columns[0]).max(columns[1])
    }

    /// Transforms `row`, which is lost.
    pub(crate) fn forward_row(&self, row: &mut [T], spectrum: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        self.forward_rows.process_with_scratch(row, spectrum, scratch).expect("lengths were planned together");
    }

    /// Transforms `spectrum`, which is lost, back.
    ///
    /// The coefficients at 0 and Nyquist of a real row are real; what rounding left of their imaginary parts is dropped.
    pub(crate) fn inverse_row(&self, spectrum: &mut [Complex<T>], row: &mut [T], scratch: &mut [Complex<T>]) {
        spectrum[0].im = T::zero();
        if row.len().is_multiple_of(2) {
            spectrum[row.len() / 2].im = T::zero();
        }
        self.inverse_rows.process_with_scratch(spectrum, row, scratch).expect("lengths were planned together");
    }
}
