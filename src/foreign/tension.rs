//! Negative pressures.

use serde::Serialize;

/// The negative pressures of a field.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Tension {
    /// Nodes whose pressure is negative.
    pub nodes: usize,
    /// The smallest pressure if it is negative, or else 0.
    pub lowest: f64,
    /// The node of the smallest pressure, counted row by row.
    pub node: usize,
    /// Their sum over the sum of the magnitudes of all pressures: 0 without tension, 1 without compression.
    pub share: f64,
}

impl Tension {
    /// The tension of `pressure`, row by row.
    pub fn new(pressure: &[f64]) -> Self {
        let sum: f64 = pressure.iter().map(|p| p.abs()).sum();
        let mut tension = Self::default();
        for (node, &p) in pressure.iter().enumerate().filter(|(_, p)| **p < 0.0) {
            tension.nodes += 1;
            tension.share -= p / sum;
            if p < tension.lowest {
                (tension.lowest, tension.node) = (p, node);
            }
        }
        tension
    }
}
