//! The filter of a line, on one core.

use super::Complex;
use super::pair::drop_rounding;
use crate::grid::Grid;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A line of any length, transformed as a whole. Memory: two fields and a half, and what FFTs of unusual length need.
pub(crate) struct LineFilter {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    q: Vec<f64>,
    values: Vec<f64>,
    spectrum: Vec<Complex>,
    scratch: Vec<Complex>,
}

impl LineFilter {
    pub fn new(grid: &Grid) -> Self {
        let n = grid.len();
        let mut planner = RealFftPlanner::new();
        let (forward, inverse) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
        let scratch = forward.get_scratch_len().max(inverse.get_scratch_len());
        Self {
            forward,
            inverse,
            q: (0..=n / 2).map(|k| TAU * k as f64 / grid.size()[1]).collect(),
            values: vec![0.0; n],
            spectrum: vec![Complex::default(); n / 2 + 1],
            scratch: vec![Complex::default(); scratch],
        }
    }

    pub fn rows(&self) -> [usize; 2] {
        [1, self.values.len()]
    }

    pub fn load(&mut self, fill: impl Fn(usize, &mut [f64])) {
        fill(0, &mut self.values);
        let Self { values, spectrum, scratch, .. } = self;
        self.forward.process_with_scratch(values, spectrum, scratch).expect("lengths were planned together");
    }

    pub fn scale(&mut self, factor: impl Fn(f64) -> f64) {
        let norm = 1.0 / self.values.len() as f64;
        self.spectrum.iter_mut().zip(&self.q).for_each(|(mode, &q)| *mode *= norm * factor(q));
    }

    pub fn store<S>(&mut self, sinks: &mut [S], store: impl Fn(usize, &[f64], &mut S)) {
        let Self { values, spectrum, scratch, .. } = self;
        drop_rounding(spectrum, values.len());
        self.inverse.process_with_scratch(spectrum, values, scratch).expect("lengths were planned together");
        store(0, values, &mut sinks[0]);
    }
}
