//! The correction of the pressure on a fixed contact set.

use super::extension::Extension;
use super::support::Support;
use crate::chunks;
use crate::contact::{Decision, Status};
use crate::elastic::Response;

/// Largest number of conjugate gradient steps.
const MOST_STEPS: usize = 100;

/// The correction `delta` on the nodes of a set, found by conjugate gradients; vectors live on the set.
///
/// Solves `(A delta)(x) + v(x) = lambda` on the set, with the compliance `A`. Either the load stays, `sum delta = 0` with
/// `lambda` to be found, or `lambda` is given. The preconditioner is `E' K E` with the stiffness `K`, the inverse of `A` on
/// the whole plane, and the [`Extension`] `E`: restricted to the set, the inverse of `A` is `E' K E` for the extension of least
/// energy (the Schur complement of `K`). A given `lambda` needs the mean as well, which `K` does not see; it gets the
/// stiffness `1 / a` of the uniform pressure on the set.
pub(super) struct Correction<'a> {
    support: &'a Support,
    pub delta: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    /// The last step.
    pub last: Decision,
    /// `1 / a`, where `lambda` is given and the load is free.
    uniform_stiffness: Option<f64>,
}

impl<'a> Correction<'a> {
    /// A zero correction, for the `residual` `lambda - v` on `support`.
    pub fn new(support: &'a Support, residual: Vec<f64>, keeps_load: bool, response: &mut Response) -> Self {
        let zeros = || vec![0.0; residual.len()];
        let (delta, direction) = (zeros(), zeros());
        let mut correction =
            Self { support, delta, direction, residual, last: Decision::Start, uniform_stiffness: None };
        if !keeps_load {
            let ones = vec![1.0; correction.residual.len()];
            let compliance = dot(&ones, &correction.comply(&ones, response)) / ones.len() as f64;
            let stiffness = if compliance > 0.0 { 1.0 / compliance } else { 0.0 };
            correction.uniform_stiffness = Some(stiffness);
        }
        correction.project_residual();
        correction
    }

    /// Iterates until the norm of the residual has fallen by `reduction`, showing each step to `watch`, which may end it;
    /// `field` is scratch.
    pub fn solve(
        &mut self,
        reduction: f64,
        extension: &mut Extension,
        response: &mut Response,
        field: &mut [f64],
        watch: &mut dyn FnMut(&Self, &mut Response) -> Option<Status>,
    ) -> Option<Status> {
        let goal = reduction * reduction * dot(&self.residual, &self.residual);
        let mut previous = None;
        for _ in 0..MOST_STEPS {
            let z = self.precondition(extension, response, field);
            let square = dot(&self.residual, &z);
            let beta = previous.map_or(0.0, |previous| square / previous);
            previous = Some(square);
            chunks::update(&mut self.direction, |range, d| range.zip(d).for_each(|(i, d)| *d = z[i] + beta * *d));
            let q = self.comply(&self.direction, response);
            let curvature = dot(&self.direction, &q);
            if !(square > 0.0 && curvature > 0.0) {
                return None;
            }
            self.step(square / curvature, &q);
            self.last = Decision::Conjugate { length: square / curvature, share: beta };
            if let Some(status) = watch(self, response) {
                return Some(status);
            }
            if dot(&self.residual, &self.residual) <= goal {
                return None;
            }
        }
        None
    }

    fn step(&mut self, alpha: f64, q: &[f64]) {
        let Self { delta, residual, direction, .. } = self;
        chunks::update_both(delta, residual, |range, delta, residual| {
            for ((i, delta), residual) in range.zip(delta).zip(residual) {
                *delta += alpha * direction[i];
                *residual -= alpha * q[i];
            }
        });
        self.project_residual();
    }

    /// The compliance on the set; what is uniform of the effect is for [`Correction::project_residual`] to remove.
    fn comply(&self, values: &[f64], response: &mut Response) -> Vec<f64> {
        let mut effect = vec![0.0; values.len()];
        response.displace_by_rows(
            |row, cause| {
                cause.fill(0.0);
                self.support.scatter(row, values, cause);
            },
            &mut self.support.pieces(&mut effect),
            |row, effect, piece| self.support.gather(row, effect, piece),
        );
        effect
    }

    /// The preconditioner applied to the residual.
    fn precondition(&self, extension: &mut Extension, response: &mut Response, field: &mut [f64]) -> Vec<f64> {
        let Self { support, residual, .. } = self;
        extension.extend(support, residual);
        let mut z = vec![0.0; residual.len()];
        let width = support.shape()[1];
        let mut sinks: Vec<_> = field.chunks_exact_mut(width).zip(support.pieces(&mut z)).collect();
        response.press_by_rows(
            |row, cause| {
                extension.fill(row, cause);
                support.scatter(row, residual, cause);
            },
            &mut sinks,
            |row, effect, (off_set, on_set)| {
                support.gather(row, effect, on_set);
                off_set.copy_from_slice(effect);
                support.runs(row).for_each(|(run, _)| off_set[run].fill(0.0));
            },
        );
        extension.restrict(field, support, &mut z);
        remove_mean(&mut z);
        if let Some(stiffness) = self.uniform_stiffness {
            let uniform = stiffness * mean(residual);
            chunks::update(&mut z, |_, z| z.iter_mut().for_each(|z| *z += uniform));
        }
        z
    }

    fn project_residual(&mut self) {
        if self.uniform_stiffness.is_none() {
            remove_mean(&mut self.residual);
        }
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    chunks::sum(a.len(), |i| a[i] * b[i])
}

pub(super) fn mean(values: &[f64]) -> f64 {
    chunks::sum(values.len(), |i| values[i]) / values.len() as f64
}

pub(super) fn remove_mean(values: &mut [f64]) {
    let mean = mean(values);
    chunks::update(values, |_, values| values.iter_mut().for_each(|value| *value -= mean));
}
