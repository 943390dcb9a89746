//! The window that takes fields to a coarse grid and back.

use crate::fourier::Real;
use std::f64::consts::PI;

/// Nodes along the side of a cell, which is the spacing of the coarse grid.
pub(super) const SIDE: usize = 4;

/// Shape parameter of the window over its width, for waves of at least four coarse spacings.
const BETA: f64 = 2.3;

/// Points of the quadrature over the window. With four times as many the transform of the waves of the far part changes by 4e-15 of
/// itself for 16 coarse nodes, and by 9e-12 for 8.
const POINTS: usize = 64;

/// The window `f(z) = exp(beta (sqrt(1 - z^2) - 1))`, `|z| < 1`, over `width` coarse nodes: a value at a node is spread over the coarse
/// nodes around it, and taken from them, with these weights.
///
/// # Source
/// Barnett, Magland & af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019).
#[derive(Debug, Clone, Copy)]
pub(in crate::elastic) struct CoarseWindow {
    width: usize,
}

impl CoarseWindow {
    pub(crate) fn new(width: usize) -> Self {
        Self { width }
    }

    fn beta(self) -> f64 {
        BETA * self.width as f64
    }

    /// Coarse nodes that a row of nodes is spread over.
    pub(crate) fn coarse(self, nodes: usize) -> usize {
        (nodes - 1) / SIDE + self.width
    }

    /// The weights of the coarse nodes `0..width` of a cell at each of its nodes: the node `i` of a cell lies `i / SIDE` spacings behind
    /// the coarse node `width / 2 - 1`.
    pub(crate) fn weights<T: Real>(self) -> Vec<[T; SIDE]> {
        let half = 0.5 * self.width as f64;
        let value = |z: f64| (self.beta() * ((1.0 - z * z).max(0.0).sqrt() - 1.0)).exp();
        let at = |coarse: usize, node: usize| (coarse as f64 - (half - 1.0) - node as f64 / SIDE as f64) / half;
        (0..self.width).map(|coarse| std::array::from_fn(|node| T::from_double(value(at(coarse, node))))).collect()
    }

    /// The transform `int f exp(-i k x) dx` at a wavenumber `k` per coarse spacing, by the substitution `z = sin(angle)`.
    pub(crate) fn transform(self, k: f64) -> f64 {
        let (half, step) = (0.5 * self.width as f64, PI / POINTS as f64);
        let term = |i: usize| {
            let (sine, cosine) = ((i as f64 + 0.5) * step - 0.5 * PI).sin_cos();
            (self.beta() * (cosine - 1.0)).exp() * cosine * (k * half * sine).cos()
        };
        half * step * (0..POINTS).map(term).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long waves that were taken to a coarse grid and back are as they were, once divided by both transforms.
    #[test]
    fn waves_survive_the_way_to_the_coarse_grid() {
        let window = CoarseWindow::new(16);
        let weights = window.weights::<f64>();
        for (k, allowed) in [(0.0, 1e-14), (0.4, 1e-14), (1.2, 1e-14), (0.5 * PI, 1e-13)] {
            let sum = |node: usize| {
                let centre = 7.0 + node as f64 / SIDE as f64;
                let terms =
                    weights.iter().enumerate().map(|(j, weights)| weights[node] * (k * (j as f64 - centre)).cos());
                terms.sum::<f64>()
            };
            assert!((0..SIDE).all(|node| (sum(node) / window.transform(k) - 1.0).abs() < allowed), "{k}");
        }
    }
}
