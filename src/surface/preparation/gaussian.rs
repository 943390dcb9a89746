//! Filters of wavelengths.

use super::Scan;
use crate::chunks;
use std::f64::consts::{LN_2, PI};

/// Where the weights of the filter are cut off, in cut-off wavelengths: they are 1e-9 of the largest there.
const REACH: f64 = 1.2;

impl Scan {
    /// The long waves of the heights, by the Gaussian filter of ISO 16610-21 (profiles) and 16610-61 (maps).
    ///
    /// The weight at the distance `s` is `exp(-pi (s / (alpha lambda))^2)` with `alpha = sqrt(ln 2 / pi)`, along y and along x: a wave of
    /// the cut-off wavelength `lambda` along an axis keeps half of its amplitude. At the rim and beside voids the weights that there are
    /// are scaled to a sum of 1 (ISO 16610-28), and voids stay void.
    pub fn low_pass(&self, wavelength: f64) -> Self {
        let mut values = self.height.mapv(|h| if h.is_nan() { 0.0 } else { h });
        let mut weights = self.height.mapv(|h| if h.is_nan() { 0.0 } else { 1.0 });
        for field in [&mut values, &mut weights] {
            for axis in 0..2 {
                let kernel = kernel(self.spacing[axis], wavelength, self.shape()[axis]);
                let turned = if axis == 0 { field.t().as_standard_layout().into_owned() } else { field.clone() };
                let mut smooth = turned.clone();
                let width = turned.ncols();
                let from = turned.as_slice().expect("standard layout by construction");
                let into = smooth.as_slice_mut().expect("standard layout by construction");
                chunks::rows_mut(into, width, |row, into| convolve(&from[row * width..][..width], &kernel, into));
                *field = if axis == 0 { smooth.t().as_standard_layout().into_owned() } else { smooth };
            }
        }
        let mut height = values / weights;
        height.zip_mut_with(&self.height, |smooth, h| *smooth = if h.is_nan() { f64::NAN } else { *smooth });
        Self { height, spacing: self.spacing }
    }

    /// The short waves of the heights: what [`Scan::low_pass`] takes away.
    pub fn high_pass(&self, wavelength: f64) -> Self {
        Self { height: &self.height - self.low_pass(wavelength).height, spacing: self.spacing }
    }
}

/// Weights of the filter at 0, 1, 2, ... nodes distance, of an axis of so many nodes.
fn kernel(spacing: f64, wavelength: f64, nodes: usize) -> Vec<f64> {
    let alpha = (LN_2 / PI).sqrt();
    let reach = (REACH * wavelength / spacing).ceil().min((nodes - 1) as f64) as usize;
    (0..=reach).map(|i| (-PI * (i as f64 * spacing / (alpha * wavelength)).powi(2)).exp()).collect()
}

/// The sum of neighbours with their weights; beyond the ends there are none.
fn convolve(from: &[f64], kernel: &[f64], into: &mut [f64]) {
    into.iter_mut().zip(from).for_each(|(sum, value)| *sum = kernel[0] * value);
    for (distance, weight) in kernel.iter().enumerate().skip(1) {
        let inside = from.len() - distance;
        into[distance..].iter_mut().zip(from).for_each(|(sum, value)| *sum += weight * value);
        into[..inside].iter_mut().zip(&from[distance..]).for_each(|(sum, value)| *sum += weight * value);
    }
}
