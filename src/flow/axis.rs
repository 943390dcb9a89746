//! The direction of a flow.

use crate::grid::Grid;
use serde::Serialize;
use strum::{EnumIter, EnumMessage, EnumString, IntoStaticStr};

/// The axis along which something flows, from one side of the cell to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, EnumIter, EnumMessage, EnumString, IntoStaticStr)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum FlowAxis {
    /// From the first column to the last one.
    X,
    /// From the first row to the last one.
    Y,
}

impl FlowAxis {
    /// Both axes.
    pub const ALL: [Self; 2] = [Self::X, Self::Y];

    /// Its name, `x` or `y`.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The place of the axis in pairs `[y, x]`.
    pub(super) fn index(self) -> usize {
        match self {
            Self::X => 1,
            Self::Y => 0,
        }
    }

    /// The grid cut open at the two sides between which something flows. Across the flow it stays as it is.
    pub(super) fn cut(self, grid: &Grid) -> Grid {
        let [y, x] = grid.periodic();
        match self {
            Self::X => grid.with_periodic([y, false]),
            Self::Y => grid.with_periodic([false, x]),
        }
    }

    /// Whether a node lies at the first and at the last side.
    pub(super) fn sides(self, grid: &Grid, node: usize) -> [bool; 2] {
        let nx = grid.shape()[1];
        let place = [node / nx, node % nx][self.index()];
        [place == 0, place + 1 == grid.shape()[self.index()]]
    }
}
