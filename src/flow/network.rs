//! The cells through which something flows, as a network of conductances.

use super::FlowAxis;
use crate::forest::Forest;
use crate::grid::Grid;

/// A face between two cells, or between a cell and a side.
#[derive(Clone, Copy)]
pub(super) struct Face {
    /// The cells; behind the last cell come the inlet and the outlet.
    pub ends: [u32; 2],
    /// Flow through the face per difference of the pressures of its ends.
    pub conductance: f64,
}

impl Face {
    /// The ends as indices.
    pub fn ends(&self) -> [usize; 2] {
        self.ends.map(|end| end as usize)
    }
}

/// Cells and their faces, where cells that are not connected to both sides are left out.
pub(super) struct Network {
    /// Number of cells.
    pub cells: usize,
    /// The node of each cell.
    pub nodes: Vec<u32>,
    /// Faces with a conductance above zero.
    pub faces: Vec<Face>,
    /// The pressure of each cell if it falls linearly, from 1 at the inlet to 0 at the outlet.
    pub linear: Vec<f64>,
}

impl Network {
    /// The network of cells with the conductivities `k >= 0`, for flow along `axis` on a grid that is cut open there.
    ///
    /// The conductance of a face is the harmonic mean of the conductivities of its cells, times its width and over the distance of
    /// the cells. A side lies half a spacing from the first or last cells.
    pub fn new(grid: &Grid, axis: FlowAxis, conductivity: &[f64]) -> Self {
        let numbers = numbers(grid, axis, conductivity);
        let nodes: Vec<u32> = (0..grid.len() as u32).filter(|&node| numbers[node as usize] != u32::MAX).collect();
        let spacing = grid.spacing();
        let ratio = spacing[1 - axis.index()] / spacing[axis.index()];
        let cells = nodes.len();
        let [inlet, outlet] = [cells as u32, cells as u32 + 1];
        let points = grid.shape()[axis.index()] as f64;
        let (faces, linear) = (Vec::with_capacity(2 * cells), Vec::with_capacity(cells));
        let mut network = Self { cells, nodes: Vec::new(), faces, linear };
        for node in nodes.iter().map(|&node| node as usize) {
            for (other, along) in links(grid, node).filter(|&(other, _)| conductivity[other] > 0.0) {
                let stretch = if along == axis { ratio } else { 1.0 / ratio };
                let conductance = stretch * harmonic_mean(conductivity[node], conductivity[other]);
                network.faces.push(Face { ends: [numbers[node], numbers[other]], conductance });
            }
            let conductance = 2.0 * ratio * conductivity[node];
            let [is_first, is_last] = axis.sides(grid, node);
            network.faces.extend(is_first.then_some(Face { ends: [inlet, numbers[node]], conductance }));
            network.faces.extend(is_last.then_some(Face { ends: [numbers[node], outlet], conductance }));
            let place = if axis == FlowAxis::X { node % grid.shape()[1] } else { node / grid.shape()[1] };
            network.linear.push(1.0 - (place as f64 + 0.5) / points);
        }
        Self { nodes, ..network }
    }

    /// The pressure at an end of a face.
    pub fn pressure(&self, pressure: &[f64], end: usize) -> f64 {
        match end {
            cell if cell < self.cells => pressure[cell],
            inlet if inlet == self.cells => 1.0,
            _ => 0.0,
        }
    }

    /// The flow through each face from its first end to the second one.
    pub fn flux(&self, pressure: &[f64]) -> Vec<f64> {
        let drop = |face: &Face| {
            let [from, to] = face.ends().map(|end| self.pressure(pressure, end));
            from - to
        };
        self.faces.iter().map(|face| face.conductance * drop(face)).collect()
    }

    /// Inflow less outflow of each cell.
    pub fn surplus(&self, flux: &[f64]) -> Vec<f64> {
        let mut surplus = vec![0.0; self.cells + 2];
        for (face, flux) in self.faces.iter().zip(flux) {
            let [from, to] = face.ends();
            surplus[from] -= flux;
            surplus[to] += flux;
        }
        surplus.truncate(self.cells);
        surplus
    }

    /// The power that a flow dissipates.
    pub fn power(&self, flux: &[f64]) -> f64 {
        self.faces.iter().zip(flux).map(|(face, flux)| flux * flux / face.conductance).sum()
    }

    /// What flows in at the inlet.
    pub fn inflow(&self, flux: &[f64]) -> f64 {
        let at_inlet = self.faces.iter().zip(flux).filter(|(face, _)| face.ends()[0] == self.cells);
        at_inlet.map(|(_, flux)| flux).sum()
    }
}

/// The next neighbours along `x` and `y`, where there are any.
fn links(grid: &Grid, node: usize) -> impl Iterator<Item = (usize, FlowAxis)> {
    let [next, _, below, _] = grid.neighbours(node);
    [(next, FlowAxis::X), (below, FlowAxis::Y)].into_iter().filter(move |(other, _)| *other != node)
}

/// The mean `2 / (1/a + 1/b)` of positive values, also where they are tiny.
fn harmonic_mean(a: f64, b: f64) -> f64 {
    let (small, large) = (a.min(b), a.max(b));
    2.0 * small / (1.0 + small / large)
}

/// The number of each cell that is connected to both sides, and `u32::MAX` for all others.
fn numbers(grid: &Grid, axis: FlowAxis, conductivity: &[f64]) -> Vec<u32> {
    let conducts = |node: &usize| conductivity[*node] > 0.0;
    let mut forest = Forest::new(grid.len());
    for node in (0..grid.len()).filter(conducts) {
        links(grid, node).filter(|(other, _)| conducts(other)).for_each(|(other, _)| _ = forest.join(node, other));
    }
    let mut reaches = vec![[false; 2]; grid.len()];
    for node in (0..grid.len()).filter(conducts) {
        let (root, sides) = (forest.root(node), axis.sides(grid, node));
        (0..2).for_each(|side| reaches[root][side] |= sides[side]);
    }
    let mut next = 0;
    let number = |node| {
        let is_kept = conducts(&node) && reaches[forest.root(node)] == [true; 2];
        next += u32::from(is_kept);
        if is_kept { next - 1 } else { u32::MAX }
    };
    (0..grid.len()).map(number).collect()
}
