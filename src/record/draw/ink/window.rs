//! The part of a line that is shown, and the nodes of a grid in it.

use crate::record::scene::Scene;

/// Width of the window around a contact that is known beforehand, in widths of that contact.
const WIDTH: f64 = 2.5;

/// The nodes shown: `shown` of the `nodes` of the period, from node `start` on and across the period.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    start: usize,
    shown: usize,
    /// Nodes of the whole line.
    pub nodes: usize,
}

/// Every `stride`-th node of the period, as far as it lies in the window: the nodes of a coarser grid. Both ends count.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Samples {
    window: Window,
    stride: usize,
    first: usize,
    /// Nodes of the period.
    period: usize,
}

impl Window {
    /// The whole line, or the surroundings of a contact that is known to be single.
    pub(crate) fn around(scene: &Scene<'_>) -> Self {
        let height = scene.problem.height();
        let nodes = height.len();
        let Some(exact) = &scene.exact else { return Self { start: 0, shown: nodes, nodes } };
        let shown = ((WIDTH * exact.relative_area * nodes as f64) as usize).clamp(16.min(nodes), nodes);
        let peak = (0..nodes).fold(0, |peak, i| if height[i] > height[peak] { i } else { peak });
        Self { start: (peak + nodes - shown / 2) % nodes, shown, nodes }
    }

    /// First and last position; a window across the period starts at a negative one.
    pub(crate) fn ends(&self, spacing: f64) -> [f64; 2] {
        let start = self.start as f64 - if self.start + self.shown > self.nodes { self.nodes as f64 } else { 0.0 };
        [start * spacing, (start + self.shown as f64) * spacing]
    }

    /// The nodes of the grid with every `stride`-th node.
    pub(crate) fn every(self, stride: usize) -> Samples {
        Samples { window: self, stride, first: self.start.div_ceil(stride), period: self.nodes / stride }
    }
}

impl Samples {
    pub(crate) fn count(&self) -> usize {
        (self.window.start + self.window.shown) / self.stride + 1 - self.first
    }

    /// The node of its grid behind sample `i`.
    pub(crate) fn node(&self, i: usize) -> usize {
        let node = self.first + i;
        if node < self.period { node } else { node - self.period }
    }

    /// The sample at a node of its grid, if it lies in the window.
    pub(crate) fn sample(&self, node: usize) -> Option<usize> {
        let period = self.window.nodes / self.stride;
        let sample = (node + period - self.first % period) % period;
        (sample < self.count()).then_some(sample)
    }

    /// Nodes of the finest grid from the start of the window to sample `i`.
    pub(crate) fn offset(&self, i: usize) -> usize {
        (self.first + i) * self.stride - self.window.start
    }

    /// The place of sample `i` in the window, from 0 to 1.
    pub(crate) fn place(&self, i: usize) -> f32 {
        self.offset(i) as f32 / self.window.shown as f32
    }

    /// The share of the window between neighbours.
    pub(crate) fn spacing(&self) -> f32 {
        self.stride as f32 / self.window.shown as f32
    }

    /// The values of the window, in its order.
    pub(crate) fn values<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        (0..self.count()).map(|i| values[self.node(i)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(window: Window, stride: usize) -> Vec<(usize, usize)> {
        let samples = window.every(stride);
        (0..samples.count()).map(|i| (samples.node(i) * stride, samples.offset(i))).collect()
    }

    #[test]
    fn coarse_nodes_lie_where_the_fine_ones_do() {
        let whole = Window { start: 0, shown: 8, nodes: 8 };
        assert_eq!(nodes(whole, 2), [(0, 0), (2, 2), (4, 4), (6, 6), (0, 8)]);
        let across = Window { start: 13, shown: 7, nodes: 16 };
        assert_eq!(nodes(across, 1).len(), 8);
        assert_eq!(nodes(across, 2), [(14, 1), (0, 3), (2, 5), (4, 7)]);
        assert_eq!(nodes(across, 4), [(0, 3), (4, 7)]);
        assert!(nodes(Window { start: 9, shown: 4, nodes: 16 }, 8).is_empty());
        for (window, stride) in [(whole, 1), (whole, 2), (across, 1), (across, 2), (across, 4)] {
            let samples = window.every(stride);
            for i in 0..samples.count() {
                let at = samples.sample(samples.node(i)).unwrap();
                assert_eq!(samples.node(at), samples.node(i), "{stride}");
            }
        }
    }
}
