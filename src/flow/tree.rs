//! A tree of wide channels, along which a flow is made free of sources.

use super::balance::Balance;
use super::network::Network;
use crate::forest::Forest;

/// A spanning tree of a network with the two sides as its one root, of faces that conduct as well as they can.
pub(super) struct ChannelTree {
    /// Cells, each before the one it drains to, with the face to that.
    drains: Vec<(u32, u32)>,
}

impl ChannelTree {
    /// The tree of the largest conductances (Kruskal), of which those within a sixteenth count as equal.
    pub(crate) fn new(network: &Network) -> Self {
        let mut order = by_conductance(network);
        let mut forest = Forest::new(network.cells() + 1);
        order.retain(|&face| {
            let [a, b] = joined(network, face);
            forest.join(a, b)
        });
        Self { drains: drains(network, &order) }
    }

    /// Sends the surplus of each cell under a flow along the tree to the sides.
    pub(crate) fn drain(&self, network: &Network, surplus: &[f64], flux: &mut [f64]) {
        let mut surplus = surplus.to_vec();
        surplus.resize(network.cells() + 2, 0.0);
        for &(cell, face) in &self.drains {
            let [from, to] = network.ends(face as usize);
            let sent = surplus[cell as usize];
            let (other, sign) = if from == cell as usize { (to, 1.0) } else { (from, -1.0) };
            flux[face as usize] += sign * sent;
            surplus[other] += sent;
        }
    }
}

/// The faces that conduct, from the largest conductance to the smallest, sorted by the leading bits of these: exponent and four bits behind it.
fn by_conductance(network: &Network) -> Vec<u32> {
    let key = |face: usize| ((u64::MAX - network.conductance(face).to_bits()) >> 48) as usize;
    let conducting = || (0..network.faces()).filter(|&face| network.conductance(face) > 0.0);
    let mut starts = vec![0; (1 << 16) + 1];
    conducting().for_each(|face| starts[key(face) + 1] += 1);
    (0..1 << 16).for_each(|key| starts[key + 1] += starts[key]);
    let mut order = vec![0; starts[1 << 16]];
    for face in conducting() {
        let place = &mut starts[key(face)];
        order[*place] = face as u32;
        *place += 1;
    }
    order
}

/// The ends of a face, with the two sides as one.
fn joined(network: &Network, face: u32) -> [usize; 2] {
    network.ends(face as usize).map(|end| end.min(network.cells()))
}

/// Cells from the leaves of the tree to its root. The number of the one face that a leaf has left is the exclusive or of the numbers of
/// its faces.
fn drains(network: &Network, tree: &[u32]) -> Vec<(u32, u32)> {
    let cells = network.cells();
    let (mut degree, mut mixed) = (vec![0_u32; cells + 1], vec![0_u32; cells + 1]);
    for &face in tree {
        for end in joined(network, face) {
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
            let [a, b] = joined(network, face);
            degree[cell] = 0;
            cell = if a == cell { b } else { a };
            degree[cell] -= 1;
            mixed[cell] ^= face;
        }
    }
    drains
}
