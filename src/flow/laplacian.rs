//! The matrix of a network.

use super::network::Network;
use crate::chunks;

/// The balance of flows of the cells of a network, a symmetric positive matrix `A`:
/// `(A x)_i = d_i x_i - sum_j c_ij x_j` with the conductances `c_ij` between cells and their sum `d_i`, in which those to the sides count as well.
///
/// Links to earlier and to later cells are held apart, since a sweep that begins at zero needs one kind of them only.
pub(super) struct Laplacian {
    /// The diagonal `d`, and one over it.
    diagonal: Vec<f64>,
    inverse: Vec<f64>,
    /// Links to earlier and to later cells.
    earlier: Links,
    later: Links,
}

/// For each cell, other cells and the conductances to them.
#[derive(Default)]
struct Links {
    /// Where the links of each cell begin, and the end.
    starts: Vec<u32>,
    others: Vec<u32>,
    conductances: Vec<f64>,
}

impl Links {
    /// Links of cells to others, given as `[cell, other]` in any order; those of a cell stay in their order.
    fn new(cells: usize, given: impl Iterator<Item = ([u32; 2], f64)> + Clone) -> Self {
        let mut starts = vec![0; cells + 1];
        given.clone().for_each(|([cell, _], _)| starts[cell as usize + 1] += 1);
        (0..cells).for_each(|cell| starts[cell + 1] += starts[cell]);
        let mut next = starts.clone();
        let (mut others, mut conductances) = (vec![0; starts[cells] as usize], vec![0.0; starts[cells] as usize]);
        for ([cell, other], conductance) in given {
            let place = &mut next[cell as usize];
            (others[*place as usize], conductances[*place as usize]) = (other, conductance);
            *place += 1;
        }
        Self { starts, others, conductances }
    }

    /// The links of a cell.
    #[inline(always)]
    fn links(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        let links = self.others[range.clone()].iter().zip(&self.conductances[range]);
        links.map(|(&other, &conductance)| (other as usize, conductance))
    }

    /// `start + sum_j c_ij x_j` at a cell.
    #[inline(always)]
    fn add(&self, cell: usize, x: &[f64], start: f64) -> f64 {
        self.links(cell).fold(start, |sum, (other, conductance)| sum + conductance * x[other])
    }

    /// Appends a cell.
    fn push(&mut self, links: impl Iterator<Item = (u32, f64)>) {
        for (other, conductance) in links {
            self.others.push(other);
            self.conductances.push(conductance);
        }
        self.starts.push(self.others.len() as u32);
    }
}

impl Laplacian {
    /// The matrix of a network.
    pub fn from_network(network: &Network) -> Self {
        let cells = network.cells;
        let mut diagonal = vec![0.0; cells + 2];
        for face in &network.faces {
            face.ends().into_iter().for_each(|end| diagonal[end] += face.conductance);
        }
        diagonal.truncate(cells);
        let inside = network.faces.iter().filter(|face| face.ends().iter().all(|&end| end < cells));
        let pairs = inside.map(|face| {
            let [a, b] = face.ends;
            ([a.min(b), a.max(b)], face.conductance)
        });
        // the nearest cell is the last one of both lists: sweeps have just changed it, and wait for it least there
        let earlier = Links::new(cells, pairs.clone().map(|([first, second], it)| ([second, first], it)));
        let later = Links::new(cells, pairs.rev());
        Self::new(diagonal, earlier, later)
    }

    fn new(diagonal: Vec<f64>, earlier: Links, later: Links) -> Self {
        let inverse = diagonal.iter().map(|diagonal| 1.0 / diagonal).collect();
        Self { diagonal, inverse, earlier, later }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.diagonal.len()
    }

    /// The other cells and the conductances of a cell.
    pub fn links(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        self.earlier.links(cell).chain(self.later.links(cell))
    }

    /// The matrix of `groups` of cells, where each cell is in the group `of` it: conductances between groups, and to the sides, are
    /// added up.
    pub fn grouped(&self, of: &[u32], groups: usize) -> Self {
        let members = members(of, groups);
        let mut diagonal = vec![0.0; groups];
        let [mut earlier, mut later] = [(); 2].map(|()| Links { starts: vec![0], ..Links::default() });
        // links of a group, and where in this list the one to a group is
        let (mut links, mut places) = (Vec::<(u32, f64)>::new(), vec![0; groups]);
        for (group, cells) in members.chunks().enumerate() {
            links.clear();
            for &cell in cells {
                diagonal[group] += self.diagonal[cell as usize];
                for (other, conductance) in self.links(cell as usize) {
                    let other = of[other];
                    let place = &mut places[other as usize];
                    if other as usize == group {
                        diagonal[group] -= conductance;
                    } else if links.get(*place).is_some_and(|link| link.0 == other) {
                        links[*place].1 += conductance;
                    } else {
                        *place = links.len();
                        links.push((other, conductance));
                    }
                }
            }
            let is_earlier = |link: &(u32, f64)| (link.0 as usize) < group;
            earlier.push(links.iter().copied().filter(is_earlier));
            later.push(links.iter().copied().filter(|link| !is_earlier(link)));
        }
        Self::new(diagonal, earlier, later)
    }

    /// `A x`.
    pub fn apply(&self, x: &[f64], product: &mut [f64]) {
        chunks::update(product, |range, product| {
            for (product, cell) in product.iter_mut().zip(range) {
                *product = self.diagonal[cell] * x[cell] - self.later.add(cell, x, self.earlier.add(cell, x, 0.0));
            }
        });
    }

    /// One sweep of Gauss and Seidel of `A x = b` from zero, from the first cell to the last. What `x` holds before does not matter.
    pub fn sweep_from_zero(&self, b: &[f64], x: &mut [f64]) {
        for (cell, (&b, &inverse)) in b.iter().zip(&self.inverse).enumerate() {
            x[cell] = self.earlier.add(cell, x, b) * inverse;
        }
    }

    /// The residual `b - A x` at a cell after [`Laplacian::sweep_from_zero`]: what later cells have changed.
    pub fn rest_of_sweep(&self, cell: usize, x: &[f64]) -> f64 {
        self.later.add(cell, x, 0.0)
    }

    /// One sweep of Gauss and Seidel of `A x = b`, from the last cell to the first.
    pub fn sweep_back(&self, b: &[f64], x: &mut [f64]) {
        for cell in (0..b.len()).rev() {
            x[cell] = self.later.add(cell, x, self.earlier.add(cell, x, b[cell])) * self.inverse[cell];
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
