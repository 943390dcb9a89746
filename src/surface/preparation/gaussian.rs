//! Filters of wavelengths.

use crate::formats::Scan;
use crate::fourier::{Complex, Filter, Fourier, Padded, smooth};
use crate::grid::Grid;
use crate::surface::Field;
use std::f64::consts::{LN_2, PI};

/// The distance at which the weights of the filter are cut off, in cut-off wavelengths; they are 1e-9 of the largest
/// weight there.
const REACH: f64 = 1.2;

impl Scan {
    /// The long waves of the heights, by the Gaussian filter of ISO 16610-21 (profiles) and 16610-61 (maps).
    ///
    /// The weight at the distance `s` is `exp(-pi (s / (alpha lambda))^2)` with `alpha = sqrt(ln 2 / pi)`, along y and
    /// along x: a wave of the cut-off wavelength `lambda` along an axis keeps half of its amplitude. At the rim and
    /// beside voids, the available weights are scaled to a sum of 1 (ISO 16610-28), and voids stay void.
    pub fn low_pass(&self, wavelength: f64) -> Self {
        let there = self.height.iter().filter(|h| !h.is_nan());
        let (count, sum) = there.fold((0usize, 0.0), |(n, sum), h| (n + 1, sum + h));
        let mean = sum / count.max(1) as f64;
        let mut gaussian = Gaussian::new(self, wavelength);
        let deviations = gaussian.sums(self.height.mapv(|h| if h.is_nan() { 0.0 } else { h - mean }));
        let weights = gaussian.sums(self.height.mapv(|h| if h.is_nan() { 0.0 } else { 1.0 }));
        let mut height = mean + deviations / weights;
        height.zip_mut_with(&self.height, |smooth, h| *smooth = if h.is_nan() { f64::NAN } else { *smooth });
        Self { height, spacing: self.spacing }
    }

    /// The short waves of the heights, which [`Scan::low_pass`] removes.
    pub fn high_pass(&self, wavelength: f64) -> Self {
        Self { height: &self.height - self.low_pass(wavelength).height, spacing: self.spacing }
    }
}

/// The weights of the filter, transformed over a grid that is padded by their reach.
struct Gaussian {
    fields: Padded,
    weights: Vec<f64>,
}

impl Gaussian {
    fn new(scan: &Scan, wavelength: f64) -> Self {
        let kernels = [0, 1].map(|axis| kernel(scan.spacing[axis], wavelength, scan.shape()[axis]));
        let points = [0, 1].map(|axis| smooth(Grid::MIN_POINTS.max(scan.shape()[axis] + kernels[axis].len() - 1)));
        let padded = match scan.shape()[0] {
            1 => Grid::line(points[1], 1.0),
            _ => Grid::surface(points, [1.0; 2]),
        };
        let padded = padded.expect("heights that are there have a grid, and one that is padded as well");
        let [along_y, along_x] = [0, 1].map(|axis| transformed(&kernels[axis], points[axis]));
        let along_y = if padded.is_line() { vec![1.0] } else { along_y };
        let weights = Filter::places(&padded).into_iter().map(|[ky, kx]| along_y[ky] * along_x[kx]).collect();
        Self { fields: Padded::new(scan.shape(), &padded), weights }
    }

    /// The weighted sums of neighbours; there are no neighbours beyond the rims.
    fn sums(&mut self, field: Field) -> Field {
        let mut field = field.as_standard_layout().into_owned();
        let values = field.as_slice_mut().expect("standard layout by construction");
        self.fields.scale(values, |place| self.weights[place]);
        field
    }
}

/// Weights of the filter at 0, 1, 2, ... nodes distance, of an axis of `nodes` nodes.
fn kernel(spacing: f64, wavelength: f64, nodes: usize) -> Vec<f64> {
    let alpha = (LN_2 / PI).sqrt();
    let reach = (REACH * wavelength / spacing).ceil().min((nodes - 1) as f64) as usize;
    (0..=reach).map(|i| (-PI * (i as f64 * spacing / (alpha * wavelength)).powi(2)).exp()).collect()
}

/// The transform of weights to both sides on a line of `points` points, for the wavenumbers up to Nyquist.
fn transformed(kernel: &[f64], points: usize) -> Vec<f64> {
    let line = Grid::line(points, 1.0).expect("an axis of a grid is a line");
    let at = |i: usize| kernel.get(i.min(points - i)).copied().unwrap_or(0.0);
    let mut spectrum = vec![Complex::default(); line.modes()];
    Fourier::new(&line).forward(&(0..points).map(at).collect::<Vec<_>>(), &mut spectrum);
    spectrum.into_iter().map(|mode| points as f64 * mode.re).collect()
}
