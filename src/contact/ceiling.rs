//! The highest allowed pressure of each node.

use crate::contact::chunks;
use std::sync::Arc;

/// Relative distance from the ceiling up to which a pressure counts as being at it, because of rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The highest allowed pressure of each node, a pressure: `0 <= p <= H`.
///
/// A [`Law`](crate::contact::Law) with a hardness gives all nodes the same ceiling. With friction, the ceiling of the traction differs from
/// node to node, since it is proportional to the pressure, see [`crate::history::SlipHistory`].
#[derive(Debug, Clone, PartialEq)]
pub enum Ceiling {
    /// One ceiling for all nodes, a pressure; infinite for a hard wall.
    Uniform(f64),
    /// One value for each node, row by row. It may be zero: no pressure is allowed there.
    Field(Arc<[f64]>),
}

impl Ceiling {
    /// The ceiling of a node.
    #[inline]
    pub fn at(&self, node: usize) -> f64 {
        match self {
            Self::Uniform(ceiling) => *ceiling,
            Self::Field(ceilings) => ceilings[node],
        }
    }

    /// Whether the ceiling of any node is finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Uniform(ceiling) => ceiling.is_finite(),
            Self::Field(_) => true,
        }
    }

    /// The mean over `nodes` nodes: the highest mean pressure that is allowed.
    pub fn mean(&self, nodes: usize) -> f64 {
        match self {
            Self::Uniform(ceiling) => *ceiling,
            Self::Field(_) => self.total(nodes) / nodes as f64,
        }
    }

    /// The sum over the first `nodes` nodes.
    pub(super) fn total(&self, nodes: usize) -> f64 {
        match self {
            Self::Uniform(ceiling) => nodes as f64 * ceiling,
            Self::Field(ceilings) => chunks::sum(nodes, |i| ceilings[i]),
        }
    }

    /// The highest pressure of a node that is not at its ceiling: the next smaller number.
    #[inline]
    pub(super) fn below(&self, node: usize) -> f64 {
        self.at(node).next_down().max(0.0)
    }

    /// Whether a node is at its ceiling under this pressure, except for rounding: there it yields, or slips.
    #[inline]
    pub fn yields(&self, node: usize, pressure: f64) -> bool {
        pressure >= self.at(node) * (1.0 - ROUNDING)
    }

    /// The room of a pressure, `min(p, H - p)`, and none where it is at its ceiling except for rounding; for a hard wall, the pressure
    /// itself.
    #[inline]
    pub(super) fn room(&self, node: usize, pressure: f64) -> f64 {
        if self.yields(node, pressure) { 0.0 } else { pressure.min(self.at(node) - pressure) }
    }

    /// The pressure of a node divided by its ceiling; 1 where none is allowed and there is none.
    pub(super) fn share(&self, node: usize, pressure: f64) -> f64 {
        let ceiling = self.at(node);
        if ceiling > 0.0 || pressure > 0.0 { pressure / ceiling } else { 1.0 }
    }

    /// Whether a share of the ceiling reaches it, except for rounding.
    pub(super) fn is_reached(share: f64) -> bool {
        share >= 1.0 - ROUNDING
    }

    /// The excess of a share over 1; 0 within rounding.
    pub(super) fn excess(share: f64) -> f64 {
        if share - 1.0 > ROUNDING { share - 1.0 } else { 0.0 }
    }

    /// The ceilings of every node of a coarser grid, or of a set of nodes, as `choose` takes them from those of the field.
    pub(super) fn chosen(&self, choose: impl FnOnce(&[f64]) -> Vec<f64>) -> Self {
        match self {
            Self::Uniform(ceiling) => Self::Uniform(*ceiling),
            Self::Field(ceilings) => Self::Field(choose(ceilings).into()),
        }
    }
}
