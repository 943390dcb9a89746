//! The compliance on contact sets, and its preconditioner.

use super::extension::Extension;
use super::support::Support;
use crate::chunks;
use crate::contact::Problem;
use crate::elastic::Convolution;
use crate::fourier::Real;

/// The part to which an inner iteration in single precision brings the certificate, well above the rounding of its displacements.
const SINGLE_ACCURACY: f64 = 1e-4;

/// The compliance of a solid, applied to vectors on contact sets.
///
/// Inner steps use it. What it loses in precision is made up for by outer steps, whose displacements are computed in double precision
/// by [`crate::elastic::Response`].
pub(super) trait SetOperator {
    /// The displacement at the nodes of `to` under a pressure on the nodes of `from`.
    fn comply(&mut self, from: &Support, pressure: &[f64], to: &Support) -> Vec<f64>;

    /// Prepares [`SetOperator::precondition`] for a set.
    fn prepare(&mut self, support: &Support);

    /// An approximate inverse of the compliance on the set, without the mean: symmetric and positive.
    fn precondition(&mut self, support: &Support, residual: &[f64]) -> Vec<f64>;

    /// The part to which an inner iteration can bring the certificate before the error of displacements shows.
    fn accuracy(&self) -> f64;

    /// Frees memory until the operator is used again.
    fn release(&mut self);

    /// Transforms so far, in those of the whole grid.
    fn transforms(&self) -> f64;
}

/// The compliance by transforms of the whole grid, in the precision `T`.
///
/// The preconditioner is `E' K E` with the stiffness `K`, the inverse of the compliance `A` on the whole plane, and the [`Extension`]
/// `E`: restricted to the set, the inverse of `A` is `E' K E` for the extension of least energy (the Schur complement of `K`).
///
/// Memory: a half spectrum, a field, and the extension, all of the precision `T`.
pub(super) struct Spectral<T: Real> {
    waves: Convolution<T>,
    shape: [usize; 2],
    /// The unit of stiffness of `waves`.
    unit: f64,
    extension: Option<Extension<T>>,
    /// The pressure off the set.
    off_set: Vec<T>,
    transforms: u64,
}

impl<T: Real> Spectral<T> {
    pub fn new(problem: &Problem) -> Self {
        let (compliance, shape) = (problem.shared_compliance(), problem.surface().grid().shape());
        let unit = power_of_two(compliance.stiffness_range()[0]);
        let waves = Convolution::new(compliance.clone(), unit);
        Self { waves, shape, unit, extension: None, off_set: Vec::new(), transforms: 0 }
    }
}

impl<T: Real> SetOperator for Spectral<T> {
    fn comply(&mut self, from: &Support, pressure: &[f64], to: &Support) -> Vec<f64> {
        self.transforms += 2;
        let largest = power_of_two(largest(pressure));
        let (down, up) = (largest.recip(), largest / self.unit);
        let mut displacement = vec![0.0; to.nodes()];
        self.waves.displace(
            |row, cause| {
                cause.fill(T::zero());
                from.scatter(row, pressure, down, cause);
            },
            &mut to.pieces(&mut displacement),
            |row, effect, piece| to.gather(row, effect, up, piece),
        );
        displacement
    }

    fn prepare(&mut self, support: &Support) {
        self.off_set.resize(self.shape[0] * self.shape[1], T::zero());
        // the memory of an earlier one is free for this one
        self.extension = None;
        self.extension = Some(Extension::new(support, self.shape, 2));
    }

    fn precondition(&mut self, support: &Support, residual: &[f64]) -> Vec<f64> {
        let extension = self.extension.as_mut().expect("the operator is prepared for the set");
        self.transforms += 2;
        let largest = power_of_two(largest(residual));
        let (down, up) = (largest.recip(), largest * self.unit);
        extension.extend(support, |node| T::from_double(down * residual[node]));
        let mut pressure = vec![0.0; residual.len()];
        let width = support.shape()[1];
        let mut sinks: Vec<_> = self.off_set.chunks_exact_mut(width).zip(support.pieces(&mut pressure)).collect();
        self.waves.press(
            |row, cause| {
                extension.fill(row, cause);
                support.scatter(row, residual, down, cause);
            },
            &mut sinks,
            |row, effect, (off_set, on_set)| {
                support.gather(row, effect, up, on_set);
                off_set.copy_from_slice(effect);
                support.runs(row).for_each(|(run, _)| off_set[run].fill(T::zero()));
            },
        );
        extension.restrict(&self.off_set, support, &mut pressure, up);
        pressure
    }

    fn release(&mut self) {
        self.waves.release();
        (self.off_set, self.extension) = (Vec::new(), None);
    }

    fn accuracy(&self) -> f64 {
        SINGLE_ACCURACY
    }

    fn transforms(&self) -> f64 {
        self.transforms as f64
    }
}

/// The largest magnitude of some values.
pub(super) fn largest(values: &[f64]) -> f64 {
    let parts = chunks::visit(values.len(), |range| values[range].iter().fold(0.0, |most: f64, v| most.max(v.abs())));
    parts.into_iter().fold(0.0, f64::max)
}

/// The next power of two above a positive value, by which numbers are scaled without rounding; 1 for other values.
pub(super) fn power_of_two(value: f64) -> f64 {
    if value.is_normal() && value > 0.0 { value.log2().ceil().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}
