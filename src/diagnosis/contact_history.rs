//! For how many steps each node has kept its state.

use crate::contact::Step;
use crate::grid::Grid;

/// The contact of a run, node by node: since which step each node has been in contact or out of contact, and how often
/// it changed.
///
/// A node of a coarser grid represents the nodes of the finest grid around it. Steps inside an outer one do not count:
/// their contact is not what the solver holds for the contact set.
#[derive(Debug, Clone)]
pub struct ContactHistory {
    grid: Grid,
    /// Whether nodes touch; empty before the first step.
    touches: Vec<bool>,
    /// Number of the step since which each node is as it is; none of those that never changed.
    since: Vec<Option<u32>>,
    flips: Vec<u32>,
    now: u32,
    /// Nodes of the last grid.
    nodes: usize,
}

/// Nodes that entered or left the contact by a step, on the grid of that step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ContactChange {
    /// Nodes that entered.
    pub entered: usize,
    /// Nodes that left.
    pub left: usize,
}

impl ContactHistory {
    /// No steps yet, on a grid.
    pub fn new(grid: &Grid) -> Self {
        let (since, flips) = (vec![None; grid.len()], vec![0; grid.len()]);
        Self { grid: *grid, touches: Vec::new(), since, flips, now: 0, nodes: 0 }
    }

    /// Adds a step; none changes from grid to grid, and steps on a grid that is no coarser version of the finest one are left out.
    pub fn add(&mut self, step: &Step<'_>) -> ContactChange {
        self.now = step.index() as u32;
        let grid = step.problem().surface().grid();
        let Some(stride) = self.grid.stride(grid).filter(|_| step.phase().inner == 0) else {
            return ContactChange::default();
        };
        let pressure = step.pressure();
        let is_new = self.touches.is_empty();
        self.touches.resize(self.grid.len(), false);
        let counts = !is_new && self.nodes == grid.len();
        self.nodes = grid.len();
        let mut change = ContactChange::default();
        let [_, nx] = grid.shape();
        for (node, &p) in pressure.iter().enumerate() {
            let (first, touches) = ([node / nx * stride[0], node % nx * stride[1]], p > 0.0);
            if self.touches[self.at(first)] == touches {
                if stride != [1, 1] {
                    self.set(first, stride, touches, false);
                }
                continue;
            }
            self.set(first, stride, touches, counts);
            if counts {
                *(if touches { &mut change.entered } else { &mut change.left }) += 1;
            }
        }
        if is_new {
            self.since.fill(None);
        }
        change
    }

    fn at(&self, [y, x]: [usize; 2]) -> usize {
        y * self.grid.shape()[1] + x
    }

    /// Sets the nodes that a node of a coarser grid represents.
    fn set(&mut self, [y, x]: [usize; 2], [along_y, along_x]: [usize; 2], touches: bool, counts: bool) {
        for row in y..y + along_y {
            let first = self.at([row, x]);
            for node in first..first + along_x {
                if self.touches[node] != touches {
                    self.touches[node] = touches;
                    self.since[node] = Some(self.now);
                    self.flips[node] += u32::from(counts);
                }
            }
        }
    }

    /// The grid of its nodes.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Whether a node touches.
    pub fn touches(&self, node: usize) -> bool {
        self.touches.get(node).copied().unwrap_or(false)
    }

    /// Steps for which a node has been as it is, if it ever changed.
    pub fn age(&self, node: usize) -> Option<u32> {
        self.since[node].map(|since| self.now - since)
    }

    /// How often each node entered or left the contact on one grid.
    pub fn flips(&self) -> &[u32] {
        &self.flips
    }

    /// Position `[y, x]` of a node.
    pub fn position(&self, node: usize) -> [f64; 2] {
        let ([_, nx], [dy, dx]) = (self.grid.shape(), self.grid.spacing());
        [(node / nx) as f64 * dy, (node % nx) as f64 * dx]
    }
}
