//! Plateaus that a surface had before its heights were interpolated.

use crate::grid::Grid;
use std::sync::Arc;

/// Which nodes of a surface lay on plateaus before its heights were interpolated on a finer grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Plateaus {
    /// Rows and columns before.
    pub shape: [usize; 2],
    /// Points along a side of the finer grid for each point.
    pub factor: usize,
    /// Whether each node lay on a plateau, row by row.
    pub nodes: Arc<[bool]>,
}

impl Plateaus {
    /// No plateaus, of a shape that is known between its nodes, too.
    pub(super) fn none() -> Self {
        Self { shape: [1, 1], factor: 1, nodes: [].into() }
    }

    /// Whether the nearest node that there was to one of the grid `fine` lay on a plateau.
    pub(super) fn has(&self, fine: &Grid, node: usize) -> bool {
        let [ny, nx] = self.shape;
        let factor = self.factor.max(1);
        let nearest = |i: usize, n: usize| (i + factor / 2) / factor % n.max(1);
        let columns = fine.shape()[1];
        self.nodes.get(nearest(node / columns, ny) * nx + nearest(node % columns, nx)).is_some_and(|&is_level| is_level)
    }
}
