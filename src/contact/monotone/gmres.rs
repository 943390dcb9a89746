//! The correction of the pressure on a set of nodes, by GMRES.

use crate::chunks::{self, dot};
use crate::contact::multilevel::operator::SetOperator;
use crate::contact::multilevel::support::Support;

/// Steps after which GMRES starts again from its residual, and the largest number of starts.
const STEPS: usize = 40;
const STARTS: usize = 5;

/// What a correction keeps.
#[derive(Clone, Copy)]
enum KeptMean {
    /// The load: means of residuals do not count, and corrections have none.
    Load,
    /// A given datum. A uniform residual asks for a pressure by this stiffness, which the preconditioner does not see.
    Datum(f64),
}

/// Solves `(A delta)(x) = residual(x) + lambda` on a set, either with `sum delta = 0` and some `lambda`, or with `lambda = 0`.
///
/// The operator need not be symmetric. Preconditioned from the right, with one vector and one preconditioned vector of the set for each
/// of 40 steps, after which it starts again.
///
/// Source: Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986).
pub(super) struct Gmres<'a, O> {
    support: &'a Support,
    operator: &'a mut O,
    kept: KeptMean,
}

impl<'a, O: SetOperator> Gmres<'a, O> {
    pub(crate) fn new(support: &'a Support, operator: &'a mut O, keeps_load: bool) -> Self {
        operator.prepare(support);
        let kept = if keeps_load {
            KeptMean::Load
        } else {
            let ones = vec![1.0; support.nodes()];
            let mut displacement = vec![0.0; ones.len()];
            operator.comply(support, &ones, support, &mut displacement);
            let compliance = mean(&displacement);
            KeptMean::Datum(if compliance > 0.0 { compliance.recip() } else { 0.0 })
        };
        Self { support, operator, kept }
    }

    /// The correction for a residual, whose norm falls by `reduction`, unless it takes too many steps. `watch` is called at each step,
    /// and may end it.
    pub(crate) fn solve(
        &mut self,
        mut residual: Vec<f64>,
        reduction: f64,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> Vec<f64> {
        let mut delta = vec![0.0; residual.len()];
        self.project(&mut residual);
        let goal = reduction * norm(&residual);
        for start in 0..STARTS {
            if start > 0 && norm(&residual) <= goal {
                break;
            }
            let before = norm(&residual);
            let goes_on = self.cycle(&mut delta, &mut residual, goal, watch);
            if !goes_on || norm(&residual) > 0.9 * before {
                break;
            }
        }
        delta
    }

    /// One cycle; returns whether another one may follow.
    fn cycle(
        &mut self,
        delta: &mut [f64],
        residual: &mut [f64],
        goal: f64,
        watch: &mut dyn FnMut(f64) -> bool,
    ) -> bool {
        let length = norm(residual);
        if !(length > 0.0 && length.is_finite()) {
            return false;
        }
        let (mut basis, mut images, mut columns) = (vec![scaled(residual, length.recip())], Vec::new(), Vec::new());
        let (mut rotations, mut right): (Vec<[f64; 2]>, Vec<f64>) = (Vec::new(), vec![length]);
        let mut goes_on = true;
        for step in 0..STEPS {
            let image = self.precondition(&basis[step]);
            let mut next = vec![0.0; image.len()];
            self.operator.comply(self.support, &image, self.support, &mut next);
            self.project(&mut next);
            images.push(image);
            let mut column = vec![0.0; step + 1];
            // orthogonalised twice: then the basis is orthogonal to rounding
            for _ in 0..2 {
                for (vector, entry) in basis.iter().zip(&mut column) {
                    let share = dot(vector, &next);
                    *entry += share;
                    add(&mut next, -share, vector);
                }
            }
            let below = norm(&next);
            for (i, [c, s]) in rotations.iter().enumerate() {
                (column[i], column[i + 1]) = (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
            }
            let radius = column[step].hypot(below);
            if !(radius > 0.0 && radius.is_finite()) {
                images.pop();
                goes_on = false;
                break;
            }
            let [c, s] = [column[step] / radius, below / radius];
            rotations.push([c, s]);
            column[step] = radius;
            columns.push(column);
            let last = right[step];
            right[step] = c * last;
            right.push(-s * last);
            goes_on = watch(self.operator.transforms());
            if !goes_on || (s * last).abs() <= goal || below <= f64::EPSILON * radius {
                break;
            }
            basis.push(scaled(&next, below.recip()));
        }
        let mut weights = vec![0.0; columns.len()];
        for i in (0..columns.len()).rev() {
            let known: f64 = (i + 1..columns.len()).map(|j| columns[j][i] * weights[j]).sum();
            weights[i] = (right[i] - known) / columns[i][i];
        }
        let mut change = vec![0.0; delta.len()];
        weights.iter().zip(&images).for_each(|(&weight, image)| add(&mut change, weight, image));
        add(delta, 1.0, &change);
        if goes_on && right.last().is_some_and(|rest| rest.abs() > goal) {
            let mut moved = vec![0.0; change.len()];
            self.operator.comply(self.support, &change, self.support, &mut moved);
            add(residual, -1.0, &moved);
            self.project(residual);
        } else {
            residual.fill(0.0);
        }
        goes_on
    }

    fn precondition(&mut self, vector: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; vector.len()];
        self.operator.precondition(self.support, vector, &mut image);
        if !self.operator.sees_mean() || matches!(self.kept, KeptMean::Load) {
            let mean = mean(&image);
            let uniform = match self.kept {
                KeptMean::Load => 0.0,
                KeptMean::Datum(stiffness) => stiffness * self::mean(vector),
            };
            chunks::update(&mut image, |_, image| image.iter_mut().for_each(|value| *value += uniform - mean));
        }
        image
    }

    fn project(&self, values: &mut [f64]) {
        if matches!(self.kept, KeptMean::Load) {
            let mean = mean(values);
            chunks::update(values, |_, values| values.iter_mut().for_each(|value| *value -= mean));
        }
    }
}

fn norm(values: &[f64]) -> f64 {
    dot(values, values).sqrt()
}

fn mean(values: &[f64]) -> f64 {
    chunks::sum(values.len(), |i| values[i]) / values.len() as f64
}

fn scaled(values: &[f64], scale: f64) -> Vec<f64> {
    values.iter().map(|value| scale * value).collect()
}

/// `to <- to + weight * values`.
fn add(to: &mut [f64], weight: f64, values: &[f64]) {
    chunks::update(to, |range, to| to.iter_mut().zip(&values[range]).for_each(|(to, value)| *to += weight * value));
}
