//! The fast method: projected Newton steps in the gap, by conjugate gradients.

use super::gap_energy::{GapEnergy, GapState};
use super::search_limits::SearchLimits;
use crate::chunks::{self, dot};
use ndarray::aview1;

/// Most conjugate gradient iterations in one step.
const INNER: usize = 60;

/// Part of the fall that the slope promises, from which a step counts.
const ENOUGH: f64 = 1e-4;

/// Halvings of a step before it has failed.
const HALVINGS: usize = 25;

/// Steps after which `K u` is computed anew, so that rounding does not add up.
const REFRESH: usize = 5;

/// Most ranges of the attraction by which a node within its reach moves in one step, so that a step does not leap over a barrier.
const LONGEST_STEP: f64 = 4.0;

/// How a search in the gap ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GapEnd {
    /// The conditions hold to the tolerance.
    Found,
    /// No step lowers the energy, or there were too many.
    Failed,
    /// Nothing touches, and the load pulls more than the attraction: the surfaces part for good.
    Separated,
    /// The observer stopped it.
    Stopped,
}

/// Lowers the energy of a state until its [residual](GapEnergy::residual) is at most `tolerance`, or for some steps.
/// `watch` sees each state, and whether to go on.
///
/// A step solves `(K + V'') dg = -r` on the nodes that do not touch by conjugate gradients with the compliance as a preconditioner. They end at
/// the first direction of negative curvature. Then the step is shortened until the energy falls.
pub(super) fn lower(
    energy: &mut GapEnergy<'_>,
    state: &mut GapState,
    SearchLimits { tolerance, steps }: SearchLimits,
    watch: &mut dyn FnMut(&GapState, usize, u64) -> bool,
) -> (GapEnd, usize) {
    let strength = energy.attraction.strength();
    for step in 0..=steps {
        let violation = state.violation() / strength;
        if !watch(state, step, energy.transforms()) {
            return (GapEnd::Stopped, step);
        }
        if has_separated(energy, state) {
            return (GapEnd::Separated, step);
        }
        if violation <= tolerance || energy.is_hidden(state) {
            // what was updated step by step is computed once more before it counts
            *state = energy.state(std::mem::take(&mut state.gap));
            if energy.residual(state, tolerance) <= tolerance {
                return (GapEnd::Found, step);
            }
        }
        if step == steps {
            break;
        }
        let falls = chunks::in_pool(state.gap.len(), || {
            let direction = newton_direction(energy, state, violation);
            take_step(energy, state, direction)
        });
        if !falls {
            return (GapEnd::Failed, step);
        }
        if step % REFRESH == REFRESH - 1 {
            *state = energy.state(std::mem::take(&mut state.gap));
        }
    }
    (GapEnd::Failed, steps)
}

/// Whether nothing touches, and parting lowers the energy: the traction only falls with the gap, so it does so for good.
fn has_separated(energy: &GapEnergy<'_>, state: &GapState) -> bool {
    let super::AdhesiveControl::MeanPressure(pressure) = energy.control else { return false };
    let n = state.gap.len();
    (0..n).all(|i| state.gap[i] > 0.0)
        && pressure + chunks::sum(n, |i| energy.attraction.traction(state.gap[i])) / (n as f64) < 0.0
}

/// The Newton step on the open nodes, zero where the surfaces touch.
fn newton_direction(energy: &mut GapEnergy<'_>, state: &GapState, violation: f64) -> Vec<f64> {
    let n = state.gap.len();
    let open = OpenNodes::new(energy, state);
    let mut step = vec![0.0; n];
    let mut residual: Vec<f64> = (0..n).map(|i| -state.gradient[i]).collect();
    open.project(&mut residual);
    let goal = violation.sqrt().min(0.1) * norm(&residual);
    let (mut better, mut direction, mut image) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut before = 0.0;
    for inner in 0..INNER {
        energy.precondition(&residual, &mut better);
        // residual and direction are projected, so that products with them need no projection of the other vector
        let [square, off] = open.product(&residual, &better);
        if square.is_nan() || square <= 0.0 {
            break;
        }
        let factor = if inner == 0 { 0.0 } else { square / before };
        chunks::update(&mut direction, |range, direction| {
            let nodes = direction.iter_mut().zip(&better[range.clone()]).zip(&open.weights[range]);
            nodes.for_each(|((d, z), weight)| *d = weight * (z - off) + factor * *d);
        });
        energy.stiffness(&direction, &mut image);
        open.add_slopes(&direction, &mut image);
        let [curvature, off] = open.product(&direction, &image);
        if curvature.is_nan() || curvature <= 0.0 {
            if inner == 0 {
                step.copy_from_slice(&direction);
            }
            break;
        }
        let length = square / curvature;
        before = square;
        let left = chunks::update_both(&mut step, &mut residual, |range, step, residual| {
            let nodes = step.iter_mut().zip(&direction[range.clone()]);
            nodes.for_each(|(step, direction)| *step += length * direction);
            let nodes = residual.iter_mut().zip(&image[range.clone()]).zip(&open.weights[range]);
            nodes.for_each(|((residual, image), weight)| *residual -= length * weight * (image - off));
            aview1(residual).dot(&aview1(residual))
        });
        if left.iter().sum::<f64>().sqrt() <= goal {
            break;
        }
    }
    step
}

/// Moves along a direction as far as the energy falls; false where it does not.
fn take_step(energy: &mut GapEnergy<'_>, state: &mut GapState, direction: Vec<f64>) -> bool {
    let n = direction.len();
    let reach = LONGEST_STEP * energy.attraction.range();
    let near = (0..n).filter(|&i| state.gap[i] < reach).map(|i| direction[i].abs()).fold(0.0, f64::max);
    let mut length = if near > reach { reach / near } else { 1.0 };
    let mut stiff = vec![0.0; n];
    let noise = 1e-15 * energy.attraction.work();
    for _ in 0..HALVINGS {
        let mut gap: Vec<f64> = state.gap.iter().zip(&direction).map(|(g, d)| g + length * d).collect();
        energy.carry(&mut gap, |i| !state.touches(i));
        let by: Vec<f64> = gap.iter().zip(&state.gap).map(|(to, from)| to - from).collect();
        energy.stiffness(&by, &mut stiff);
        let change = energy.change(state, &by, &stiff);
        let slope = (dot(&state.gradient, &by) / n as f64).min(0.0);
        if change <= ENOUGH * slope || change.abs() <= noise {
            let force = state.force.iter().zip(&stiff).map(|(f, k)| f + k).collect();
            *state = energy.with_force(gap, force);
            return true;
        }
        length *= 0.5;
    }
    false
}

/// The nodes that do not touch. Where the mean gap is given, changes of the gap have the sum zero.
pub(super) struct OpenNodes {
    /// One at open nodes, and zero at closed ones: sums and products with this are fast.
    weights: Vec<f64>,
    /// The slope of the attraction at each node, a pressure per length.
    slopes: Vec<f64>,
    count: usize,
    keeps_mean: bool,
}

impl OpenNodes {
    pub(crate) fn new(energy: &GapEnergy<'_>, state: &GapState) -> Self {
        let weights: Vec<f64> = (0..state.gap.len()).map(|i| f64::from(u8::from(!state.touches(i)))).collect();
        let count = weights.iter().filter(|weight| **weight > 0.0).count();
        let mut slopes = vec![0.0; state.gap.len()];
        chunks::update(&mut slopes, |range, slopes| {
            slopes.iter_mut().zip(&state.gap[range]).for_each(|(slope, gap)| *slope = energy.attraction.slope(*gap));
        });
        Self { weights, slopes, count, keeps_mean: energy.keeps_mean() }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Sets closed nodes to zero, and takes the mean of the open ones off where it is kept.
    pub(crate) fn project(&self, x: &mut [f64]) {
        let off = self.kept_mean(dot(x, &self.weights));
        chunks::update(x, |range, x| {
            x.iter_mut().zip(&self.weights[range]).for_each(|(x, weight)| *x = weight * (*x - off));
        });
    }

    /// The product of a projected vector and another one, and what a projection takes off the other one.
    fn product(&self, projected: &[f64], other: &[f64]) -> [f64; 2] {
        let sums = chunks::visit(other.len(), |range| {
            let other = aview1(&other[range.clone()]);
            [&projected[range.clone()], &self.weights[range]].map(|of| aview1(of).dot(&other))
        });
        let [product, sum] = [0, 1].map(|of| sums.iter().map(|sums| sums[of]).sum());
        [product, self.kept_mean(sum)]
    }

    /// The mean of the open nodes by their sum, if it is kept, else zero.
    fn kept_mean(&self, sum: f64) -> f64 {
        if self.keeps_mean && self.count > 0 { sum / self.count as f64 } else { 0.0 }
    }

    /// `(K + V'') x` on the open nodes.
    pub(crate) fn curved(&self, energy: &mut GapEnergy<'_>, x: &[f64], result: &mut [f64]) {
        energy.stiffness(x, result);
        self.add_slopes(x, result);
        self.project(result);
    }

    /// Adds `V'' x`.
    fn add_slopes(&self, x: &[f64], result: &mut [f64]) {
        chunks::update(result, |range, result| {
            let nodes = result.iter_mut().zip(&x[range.clone()]).zip(&self.slopes[range]);
            nodes.for_each(|((result, x), slope)| *result += slope * x);
        });
    }
}

/// Adds a multiple of a vector to another one.
pub(super) fn add_scaled(to: &mut [f64], scale: f64, of: &[f64]) {
    chunks::update(to, |range, to| to.iter_mut().zip(&of[range]).for_each(|(to, of)| *to += scale * of));
}

pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
