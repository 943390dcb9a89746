//! The filter of a line, on one core.

use super::Real;
use super::plans::Plans;
use super::wave::Wave;
use crate::grid::Grid;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

/// A line of any length, transformed as a whole. Memory: two fields and a half, and what FFTs of unusual length need.
pub(crate) struct LineFilter<T: Real = f64> {
    plans: Plans<T>,
    q: Vec<f64>,
    values: Vec<T>,
    spectrum: Vec<Complex<T>>,
    scratch: Vec<Complex<T>>,
}

impl LineFilter {
    /// Wave numbers along y and x of each place.
    pub(crate) fn places(grid: &Grid) -> Vec<[usize; 2]> {
        (0..=grid.len() / 2).map(|k| [0, k]).collect()
    }
}

impl<T: Real> LineFilter<T> {
    pub(crate) fn new(grid: &Grid) -> Self {
        let n = grid.len();
        let plans = Plans::new(grid);
        Self {
            q: (0..=n / 2).map(|k| TAU * k as f64 / grid.size()[1]).collect(),
            values: vec![T::zero(); n],
            spectrum: vec![Complex::new(T::zero(), T::zero()); n / 2 + 1],
            scratch: vec![Complex::new(T::zero(), T::zero()); plans.scratch_len()],
            plans,
        }
    }

    pub(crate) fn rows(&self) -> [usize; 2] {
        [1, self.values.len()]
    }

    pub(crate) fn load(&mut self, fill: impl Fn(usize, &mut [T])) {
        fill(0, &mut self.values);
        self.plans.forward_row(&mut self.values, &mut self.spectrum, &mut self.scratch);
    }

    pub(crate) fn scale(&mut self, factor: impl Fn(Wave) -> f64) {
        let norm = 1.0 / self.values.len() as f64;
        let waves = self.q.iter().enumerate().map(|(place, &q)| Wave { q, place });
        self.spectrum
            .iter_mut()
            .zip(waves)
            .for_each(|(mode, wave)| *mode = *mode * T::from_double(norm * factor(wave)));
    }

    pub(crate) fn store<S>(&mut self, sinks: &mut [S], store: impl Fn(usize, &mut [T], &mut S)) {
        self.plans.inverse_row(&mut self.spectrum, &mut self.values, &mut self.scratch);
        store(0, &mut self.values, &mut sinks[0]);
    }
}
