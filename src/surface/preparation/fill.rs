//! Voids filled with heights.

use super::Scan;
use serde::{Deserialize, Serialize};

/// The residual of Laplace's equation, over that at the start, at which a filling is done.
const TOLERANCE: f64 = 1e-8;

/// How voids are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fill {
    /// By the smoothest heights that meet those around them: each is the mean of its neighbours, which solves Laplace's equation.
    Harmonic,
}

impl Fill {
    /// The ways by their names in scenes, in a few words.
    pub const WAYS: [(&str, &str); 1] = [("harmonic", "The smoothest heights that meet those around the void")];

    /// The heights without voids; none where all are void.
    pub fn of(self, mut scan: Scan) -> Option<Scan> {
        let there = scan.height.iter().filter(|h| !h.is_nan());
        let (count, sum) = there.fold((0usize, 0.0), |(n, sum), h| (n + 1, sum + h));
        let laplace = Laplace::new(&scan);
        scan.height.mapv_inplace(|h| if h.is_nan() { sum / count as f64 } else { h });
        let mut scan = Scan { height: scan.height.as_standard_layout().into_owned(), ..scan };
        laplace.solve(scan.height.as_slice_mut().expect("standard layout"));
        (count > 0).then_some(scan)
    }
}

/// Laplace's equation on the voids of a map, whose rim has no slope across it.
struct Laplace {
    shape: [usize; 2],
    /// Weights of neighbours along y and x.
    weights: [f64; 2],
    /// Nodes, counted row by row.
    voids: Vec<usize>,
}

impl Laplace {
    fn new(scan: &Scan) -> Self {
        let weights = scan.spacing.map(|spacing| (scan.spacing[1] / spacing).powi(2));
        let voids = scan.height.iter().enumerate().filter(|(_, h)| h.is_nan()).map(|(node, _)| node).collect();
        Self { shape: scan.shape(), weights, voids }
    }

    /// The neighbours of a node, with their weights.
    fn neighbours(&self, node: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let ([ny, nx], [along_y, along_x]) = (self.shape, self.weights);
        let (y, x) = (node / nx, node % nx);
        let above = (y > 0).then(|| (node - nx, along_y));
        let below = (y + 1 < ny).then(|| (node + nx, along_y));
        let left = (x > 0).then(|| (node - 1, along_x));
        let right = (x + 1 < nx).then(|| (node + 1, along_x));
        [above, below, left, right].into_iter().flatten()
    }

    /// What Laplace's operator makes of a field at each void: its height less that of each neighbour, by their weights.
    fn apply(&self, field: &[f64]) -> Vec<f64> {
        let at = |&node: &usize| self.neighbours(node).map(|(next, weight)| weight * (field[node] - field[next])).sum();
        self.voids.iter().map(at).collect()
    }

    /// Solves for the voids of a field by conjugate gradients, preconditioned by the sum of the weights.
    fn solve(&self, height: &mut [f64]) {
        let diagonal: Vec<f64> = self.voids.iter().map(|&node| self.neighbours(node).map(|it| it.1).sum()).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scaled = |rest: &[f64]| rest.iter().zip(&diagonal).map(|(r, d)| r / d).collect::<Vec<_>>();
        let mut rest: Vec<f64> = self.apply(height).into_iter().map(|it| -it).collect();
        let (mut along, mut before, mut z) = (vec![0.0; height.len()], 0.0, scaled(&rest));
        let goal = TOLERANCE.powi(2) * dot(&rest, &z);
        for _ in 0..self.voids.len() {
            let square = dot(&rest, &z);
            if square <= goal {
                break;
            }
            let share = if before > 0.0 { square / before } else { 0.0 };
            self.voids.iter().zip(&z).for_each(|(&node, z)| along[node] = z + share * along[node]);
            let response = self.apply(&along);
            let step = square / self.voids.iter().zip(&response).map(|(&node, r)| along[node] * r).sum::<f64>();
            self.voids.iter().for_each(|&node| height[node] += step * along[node]);
            rest.iter_mut().zip(&response).for_each(|(rest, r)| *rest -= step * r);
            (before, z) = (square, scaled(&rest));
        }
    }
}
