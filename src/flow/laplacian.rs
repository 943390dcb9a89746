//! The matrix of a network.

use super::network::Network;
use crate::chunks;

/// The balance of flows of the cells of a network, a symmetric positive matrix `A`:
/// `(A x)_i = d_i x_i - sum_j c_ij x_j` with the conductances `c_ij` between cells and their sum `d_i`, in which those to the sides count as well.
pub(super) struct Laplacian {
    /// The diagonal `d`.
    pub diagonal: Vec<f64>,
    /// Where the links of each cell begin, and the end.
    starts: Vec<usize>,
    /// For each link, the other cell and the conductance.
    links: Vec<(u32, f64)>,
}

impl Laplacian {
    /// The matrix of a network.
    pub fn from_network(network: &Network) -> Self {
        let cells = network.cells;
        let (mut diagonal, mut starts) = (vec![0.0; cells + 2], vec![0; cells + 1]);
        let is_inside = |ends: &[usize; 2]| ends.iter().all(|&end| end < cells);
        for face in &network.faces {
            face.ends().into_iter().for_each(|end| diagonal[end] += face.conductance);
            if is_inside(&face.ends()) {
                face.ends().into_iter().for_each(|end| starts[end + 1] += 1);
            }
        }
        diagonal.truncate(cells);
        (0..cells).for_each(|cell| starts[cell + 1] += starts[cell]);
        let (mut next, mut links) = (starts.clone(), vec![(0, 0.0); starts[cells]]);
        for face in network.faces.iter().filter(|face| is_inside(&face.ends())) {
            let [a, b] = face.ends;
            for (from, to) in [(a as usize, b), (b as usize, a)] {
                links[next[from]] = (to, face.conductance);
                next[from] += 1;
            }
        }
        Self { diagonal, starts, links }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.diagonal.len()
    }

    /// The other cells and the conductances of a cell.
    pub fn links(&self, cell: usize) -> &[(u32, f64)] {
        &self.links[self.starts[cell]..self.starts[cell + 1]]
    }

    /// The matrix of `groups` of cells, where each cell is in the group `of` it: conductances between groups, and to the sides, are
    /// added up.
    pub fn grouped(&self, of: &[u32], groups: usize) -> Self {
        let members = members(of, groups);
        let mut coarse = Self { diagonal: vec![0.0; groups], starts: vec![0], links: Vec::new() };
        // where the link to a group is in the list
        let mut places = vec![usize::MAX; groups];
        for (group, cells) in members.chunks().enumerate() {
            let start = coarse.links.len();
            for &cell in cells {
                coarse.diagonal[group] += self.diagonal[cell as usize];
                for &(other, conductance) in self.links(cell as usize) {
                    let other = of[other as usize];
                    let place = places[other as usize];
                    if other as usize == group {
                        coarse.diagonal[group] -= conductance;
                    } else if place >= start && place < coarse.links.len() {
                        coarse.links[place].1 += conductance;
                    } else {
                        places[other as usize] = coarse.links.len();
                        coarse.links.push((other, conductance));
                    }
                }
            }
            coarse.starts.push(coarse.links.len());
        }
        coarse
    }

    /// `A x` at a cell.
    fn at(&self, cell: usize, x: &[f64]) -> f64 {
        let from_others = self.links(cell).iter().map(|&(other, conductance)| conductance * x[other as usize]);
        self.diagonal[cell] * x[cell] - from_others.sum::<f64>()
    }

    /// `A x`.
    pub fn apply(&self, x: &[f64], product: &mut [f64]) {
        chunks::update(product, |range, product| {
            product.iter_mut().zip(range).for_each(|(product, cell)| *product = self.at(cell, x));
        });
    }

    /// One sweep of Gauss and Seidel of `A x = b` over the cells in the given order.
    pub fn sweep(&self, order: impl Iterator<Item = usize>, b: &[f64], x: &mut [f64]) {
        for cell in order {
            x[cell] += (b[cell] - self.at(cell, x)) / self.diagonal[cell];
        }
    }
}

/// The members of each group.
struct Members {
    cells: Vec<u32>,
    starts: Vec<usize>,
}

impl Members {
    /// The members, group by group.
    fn chunks(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|ends| &self.cells[ends[0]..ends[1]])
    }
}

fn members(of: &[u32], groups: usize) -> Members {
    let mut starts = vec![0; groups + 1];
    of.iter().for_each(|&group| starts[group as usize + 1] += 1);
    (0..groups).for_each(|group| starts[group + 1] += starts[group]);
    let (mut next, mut cells) = (starts.clone(), vec![0; of.len()]);
    for (cell, &group) in of.iter().enumerate() {
        cells[next[group as usize]] = cell as u32;
        next[group as usize] += 1;
    }
    Members { cells, starts }
}
