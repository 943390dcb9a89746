//! The correction of the pressure on a fixed contact set.

use super::operator::SetOperator;
use super::support::Support;
use super::workspace::Workspace;
use crate::chunks;
use crate::contact::{Decision, Status};

/// Largest number of conjugate gradient steps.
const MOST_STEPS: usize = 100;

/// The correction `delta` on the nodes of a set, found by conjugate gradients; vectors live on the set.
///
/// Solves `(A delta)(x) + v(x) = lambda` on the set, with the compliance `A`. Either the load stays, `sum delta = 0` with
/// `lambda` to be found, or `lambda` is given. Where the preconditioner of the [`SetOperator`] does not see the mean, which a given
/// `lambda` needs as well, it gets the stiffness `1 / a` of the uniform pressure on the set.
pub(super) struct Correction<'a> {
    support: &'a Support,
    /// The nodes at which the displacement is asked for, the set among them.
    reach: &'a Support,
    pub delta: Vec<f64>,
    /// `A delta` at the nodes of `reach`, without what is uniform.
    pub moved: Vec<f64>,
    residual: Vec<f64>,
    /// The square of the norm of the first residual.
    first: f64,
    direction: Vec<f64>,
    steps: StepVectors,
    /// The last step.
    pub last: Decision,
    mean: MeanRule,
}

/// The vectors of a step: the preconditioned residual, and the displacement under the direction at the nodes of the set and of the
/// reach.
struct StepVectors {
    preconditioned: Vec<f64>,
    on_set: Vec<f64>,
    on_reach: Vec<f64>,
}

/// How a correction treats the mean of its residual.
#[derive(Clone, Copy)]
enum MeanRule {
    /// It is removed, since the load stays.
    Removed,
    /// It is multiplied by the stiffness of the uniform pressure.
    Multiplied(f64),
    /// The preconditioner sees it.
    Seen,
}

impl<'a> Correction<'a> {
    /// A zero correction, for the `residual` `lambda - v` on `support`, whose displacement is asked for at the nodes of `reach`.
    pub(crate) fn new(
        [support, reach]: [&'a Support; 2],
        residual: Vec<f64>,
        keeps_load: bool,
        operator: &mut (impl SetOperator + ?Sized),
        workspace: &mut Workspace,
    ) -> Self {
        let [delta, direction, preconditioned, on_set] = [(); 4].map(|()| workspace.zeros(residual.len()));
        let [moved, on_reach] = [(); 2].map(|()| workspace.zeros(reach.nodes()));
        let steps = StepVectors { preconditioned, on_set, on_reach };
        let last = Decision::Start;
        let mean = match keeps_load {
            true => MeanRule::Removed,
            false if operator.sees_mean() => MeanRule::Seen,
            false => MeanRule::Multiplied(uniform_stiffness(support, operator)),
        };
        let mut correction = Self { support, reach, delta, moved, direction, residual, first: 0.0, steps, last, mean };
        correction.project_residual();
        correction.first = dot(&correction.residual, &correction.residual);
        operator.prepare(support);
        correction
    }

    /// Iterates until the norm of the residual has fallen by `reduction`, showing each step to `watch`, which may end it, with the
    /// transforms of the operator so far.
    pub(crate) fn solve(
        &mut self,
        reduction: f64,
        operator: &mut (impl SetOperator + ?Sized),
        watch: &mut dyn FnMut(&Self, f64) -> Option<Status>,
    ) -> Option<Status> {
        self.solve_until(&mut |correction| correction.is_reduced(reduction), operator, watch)
    }

    /// Whether the norm of the residual has fallen by `reduction`.
    pub(crate) fn is_reduced(&self, reduction: f64) -> bool {
        dot(&self.residual, &self.residual) <= reduction * reduction * self.first
    }

    /// Iterates like [`Correction::solve`] until it `is_done`.
    pub(crate) fn solve_until(
        &mut self,
        is_done: &mut dyn FnMut(&Self) -> bool,
        operator: &mut (impl SetOperator + ?Sized),
        watch: &mut dyn FnMut(&Self, f64) -> Option<Status>,
    ) -> Option<Status> {
        let mut previous = None;
        for _ in 0..MOST_STEPS {
            self.precondition(operator);
            let Self { support, reach, residual, direction, steps, .. } = self;
            let z = &steps.preconditioned;
            let square = dot(residual, z);
            let beta = previous.map_or(0.0, |previous| square / previous);
            previous = Some(square);
            chunks::update(direction, |range, d| range.zip(d).for_each(|(i, d)| *d = z[i] + beta * *d));
            operator.comply(support, direction, reach, &mut steps.on_reach);
            reach.transfer(&steps.on_reach, support, &mut steps.on_set);
            let curvature = dot(direction, &steps.on_set);
            if !(square > 0.0 && curvature > 0.0) {
                return None;
            }
            self.step(square / curvature);
            self.last = Decision::Conjugate { length: square / curvature, share: beta };
            if let Some(status) = watch(self, operator.transforms()) {
                return Some(status);
            }
            if is_done(self) {
                return None;
            }
        }
        None
    }

    fn step(&mut self, alpha: f64) {
        let Self { delta, moved, residual, direction, steps: StepVectors { on_set, on_reach, .. }, .. } = self;
        chunks::update(moved, |range, moved| range.zip(moved).for_each(|(i, moved)| *moved += alpha * on_reach[i]));
        chunks::update_both(delta, residual, |range, delta, residual| {
            for ((i, delta), residual) in range.zip(delta).zip(residual) {
                *delta += alpha * direction[i];
                *residual -= alpha * on_set[i];
            }
        });
        self.project_residual();
    }

    /// Applies the preconditioner to the residual.
    fn precondition(&mut self, operator: &mut (impl SetOperator + ?Sized)) {
        let z = &mut self.steps.preconditioned;
        operator.precondition(self.support, &self.residual, z);
        if matches!(self.mean, MeanRule::Removed | MeanRule::Multiplied(_)) {
            remove_mean(z);
        }
        if let MeanRule::Multiplied(stiffness) = self.mean {
            let uniform = stiffness * mean(&self.residual);
            chunks::update(z, |_, z| z.iter_mut().for_each(|z| *z += uniform));
        }
    }

    /// Ends the iteration: `delta` and `moved` are left, and the other vectors go back to the workspace.
    pub(crate) fn finish(self, workspace: &mut Workspace) -> [Vec<f64>; 2] {
        let StepVectors { preconditioned, on_set, on_reach } = self.steps;
        workspace.keep([self.residual, self.direction, preconditioned, on_set, on_reach]);
        [self.delta, self.moved]
    }

    fn project_residual(&mut self) {
        if matches!(self.mean, MeanRule::Removed) {
            remove_mean(&mut self.residual);
        }
    }
}

/// `1 / a`, the stiffness of the uniform pressure on a set; zero if it displaces nothing.
fn uniform_stiffness(support: &Support, operator: &mut (impl SetOperator + ?Sized)) -> f64 {
    let ones = vec![1.0; support.nodes()];
    let mut displacement = vec![0.0; ones.len()];
    operator.comply(support, &ones, support, &mut displacement);
    let compliance = dot(&ones, &displacement) / ones.len() as f64;
    if compliance > 0.0 { 1.0 / compliance } else { 0.0 }
}

/// The scalar product, term by term: the order of summation is a part of the digits that the guide shows.
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
