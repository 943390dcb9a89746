//! A tree of wide channels, along which a flow is made free of sources.

use super::network::{Face, Network};
use crate::forest::Forest;

/// A spanning tree of a network with the two sides as its one root, of faces that conduct as well as they can.
pub(super) struct ChannelTree {
    /// Cells, each before the one it drains to, with the face to that.
    drains: Vec<(u32, u32)>,
}

impl ChannelTree {
    /// The tree of the largest conductances (Kruskal).
    pub fn new(network: &Network) -> Self {
        let Network { cells, faces, .. } = network;
        let mut order: Vec<u32> = (0..faces.len() as u32).collect();
        order.sort_unstable_by(|&a, &b| {
            let [a_conducts, b_conducts] = [a, b].map(|face| faces[face as usize].conductance);
            b_conducts.total_cmp(&a_conducts).then(a.cmp(&b))
        });
        let mut forest = Forest::new(cells + 1);
        order.retain(|&face| {
            let [a, b] = joined(&faces[face as usize], *cells);
            forest.join(a, b)
        });
        Self { drains: drains(network, &order) }
    }

    /// Sends the surplus of each cell under a flow along the tree to the sides.
    pub fn drain(&self, network: &Network, surplus: &[f64], flux: &mut [f64]) {
        let mut surplus = surplus.to_vec();
        surplus.resize(network.cells + 2, 0.0);
        for &(cell, face) in &self.drains {
            let [from, to] = network.faces[face as usize].ends();
            let sent = surplus[cell as usize];
            let (other, sign) = if from == cell as usize { (to, 1.0) } else { (from, -1.0) };
            flux[face as usize] += sign * sent;
            surplus[other] += sent;
        }
    }
}

/// The ends of a face, with the two sides as one.
fn joined(face: &Face, cells: usize) -> [usize; 2] {
    face.ends().map(|end| end.min(cells))
}

/// Cells from the leaves of the tree to its root. The number of the one face that a leaf has left is the exclusive or of the numbers of
/// its faces.
fn drains(network: &Network, tree: &[u32]) -> Vec<(u32, u32)> {
    let cells = network.cells;
    let (mut degree, mut mixed) = (vec![0_u32; cells + 1], vec![0_u32; cells + 1]);
    for &face in tree {
        for end in joined(&network.faces[face as usize], cells) {
            degree[end] += 1;
            mixed[end] ^= face;
        }
    }
    let mut drains = Vec::with_capacity(cells);
    for start in 0..cells {
        let mut cell = start;
        // up from a leaf, as long as that leaves another leaf
        while cell < cells && degree[cell] == 1 {
            let face = mixed[cell];
            drains.push((cell as u32, face));
            let [a, b] = joined(&network.faces[face as usize], cells);
            degree[cell] = 0;
            cell = if a == cell { b } else { a };
            degree[cell] -= 1;
            mixed[cell] ^= face;
        }
    }
    drains
}
