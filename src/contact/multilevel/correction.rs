//! The correction of the pressure on a fixed contact set.

use crate::contact::chunks;
use crate::elastic::HalfSpace;

/// Conjugate gradient steps at the most.
const MOST_STEPS: usize = 100;

/// The correction `delta` on the nodes of a set, found by conjugate gradients; vectors live on the set.
pub(super) struct Correction {
    pub nodes: Vec<usize>,
    pub delta: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
}

impl Correction {
    /// A correction of nothing yet, for the residual `lambda - v` on the nodes with `is_in`.
    pub fn new(is_in: &[bool], displacement: &[f64], height: &[f64]) -> Self {
        let nodes: Vec<usize> = (0..is_in.len()).filter(|&i| is_in[i]).collect();
        let mut residual: Vec<f64> = nodes.iter().map(|&i| height[i] - displacement[i]).collect();
        remove_mean(&mut residual);
        let zeros = vec![0.0; nodes.len()];
        Self { delta: zeros.clone(), direction: zeros, nodes, residual }
    }

    /// Solves `(A delta)(x) + v(x) = const` on the set with `sum delta = 0`, where `A` is the compliance, until the norm of the
    /// residual (that of the preconditioner) has fallen by `reduction`, and adds `A delta` to the `displacement` of all nodes;
    /// `field` is scratch.
    pub fn solve(&mut self, reduction: f64, half_space: &mut HalfSpace, displacement: &mut [f64], field: &mut [f64]) {
        let mut previous = None;
        let mut first = 0.0;
        for _ in 0..MOST_STEPS {
            let z = self.apply(&self.residual, field, |field| half_space.stiffen(field));
            let square = dot(&self.residual, &z);
            first = if previous.is_none() { square } else { first };
            if square.is_nan() || square <= reduction * reduction * first && previous.is_some() || square <= 0.0 {
                return;
            }
            let beta = previous.map_or(0.0, |previous| square / previous);
            previous = Some(square);
            self.direction.iter_mut().zip(&z).for_each(|(d, z)| *d = z + beta * *d);
            let q = self.apply(&self.direction, field, |field| half_space.comply(field));
            let curvature = dot(&self.direction, &q);
            if curvature.is_nan() || curvature <= 0.0 {
                return;
            }
            self.step(square / curvature, &q);
            let (alpha, field) = (square / curvature, &*field);
            chunks::update(displacement, |range, u| range.zip(u).for_each(|(i, u)| *u += alpha * field[i]));
        }
    }

    /// Length of the step against the gradient on the set that minimises `f`, or 0 where there is no gradient.
    pub fn cauchy_length(&self, half_space: &mut HalfSpace, field: &mut [f64]) -> f64 {
        let q = self.apply(&self.residual, field, |field| half_space.comply(field));
        let (square, curvature) = (dot(&self.residual, &self.residual), dot(&self.residual, &q));
        if curvature > 0.0 { square / curvature } else { 0.0 }
    }

    fn step(&mut self, alpha: f64, q: &[f64]) {
        self.delta.iter_mut().zip(&self.direction).for_each(|(delta, d)| *delta += alpha * d);
        self.residual.iter_mut().zip(q).for_each(|(r, q)| *r -= alpha * q);
    }

    /// What `operator` makes of the field that is `values` on the set and zero elsewhere: on the set, less its mean.
    fn apply(&self, values: &[f64], field: &mut [f64], operator: impl FnOnce(&mut [f64])) -> Vec<f64> {
        chunks::update(field, |_, field| field.fill(0.0));
        self.nodes.iter().zip(values).for_each(|(&i, &value)| field[i] = value);
        operator(field);
        let mut on_set: Vec<f64> = self.nodes.iter().map(|&i| field[i]).collect();
        remove_mean(&mut on_set);
        on_set
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    chunks::sum(a.len(), |i| a[i] * b[i])
}

fn remove_mean(values: &mut [f64]) {
    let mean = chunks::sum(values.len(), |i| values[i]) / values.len() as f64;
    chunks::update(values, |_, values| values.iter_mut().for_each(|value| *value -= mean));
}
