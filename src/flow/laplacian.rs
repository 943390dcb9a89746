//! The matrix of groups of cells.

use super::balance::Balance;
use crate::chunks;

/// The balance of flows of groups of cells.
///
/// Links to earlier and to later groups are held apart, since a sweep that begins at zero needs one kind of them only.
pub(super) struct Laplacian {
    /// The conductances to the sides.
    to_sides: Vec<f64>,
    /// One over the sum of all conductances.
    inverse: Vec<f64>,
    /// Links to earlier and to later groups.
    earlier: Links,
    later: Links,
}

/// For each cell, other cells and the conductances to them.
struct Links {
    /// Where the links of each cell begin, and the end.
    starts: Vec<u32>,
    others: Vec<u32>,
    conductances: Vec<f64>,
}

impl Links {
    /// The links of no cell.
    fn none() -> Self {
        Self { starts: vec![0], others: Vec::new(), conductances: Vec::new() }
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

    /// `start + sum_j c_ij (x_i - x_j)` at a cell.
    #[inline(always)]
    fn add_flows(&self, cell: usize, x: &[f64], start: f64) -> f64 {
        self.links(cell).fold(start, |sum, (other, conductance)| sum + conductance * (x[cell] - x[other]))
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
    /// The matrix of `groups` of cells, where each cell is in the group `of` it: conductances between groups, and to the sides, are
    /// added up.
    pub(crate) fn new(fine: &impl Balance, of: &[u32], groups: usize) -> Self {
        let members = members(of, groups);
        let (mut to_sides, mut inverse) = (Vec::with_capacity(groups), Vec::with_capacity(groups));
        let [mut earlier, mut later] = [Links::none(), Links::none()];
        // links of a group, and where in this list the one to a group is
        let (mut links, mut places) = (Vec::<(u32, f64)>::new(), vec![0; groups]);
        for (group, cells) in members.chunks().enumerate() {
            links.clear();
            for &cell in cells {
                for (other, conductance) in fine.links(cell as usize) {
                    let other = of[other];
                    let place = &mut places[other as usize];
                    if other as usize == group {
                        continue;
                    }
                    if links.get(*place).is_some_and(|link| link.0 == other) {
                        links[*place].1 += conductance;
                    } else {
                        *place = links.len();
                        links.push((other, conductance));
                    }
                }
            }
            let sides = cells.iter().map(|&cell| fine.to_sides(cell as usize)).sum();
            inverse.push(1.0 / links.iter().fold(sides, |sum, link| sum + link.1));
            to_sides.push(sides);
            let is_earlier = |link: &(u32, f64)| (link.0 as usize) < group;
            earlier.push(links.iter().copied().filter(is_earlier));
            later.push(links.iter().copied().filter(|link| !is_earlier(link)));
        }
        Self { to_sides, inverse, earlier, later }
    }
}

impl Balance for Laplacian {
    fn cells(&self) -> usize {
        self.inverse.len()
    }

    fn to_sides(&self, cell: usize) -> f64 {
        self.to_sides[cell]
    }

    #[inline(always)]
    fn links(&self, cell: usize) -> impl Iterator<Item = (usize, f64)> + Clone {
        self.earlier.links(cell).chain(self.later.links(cell))
    }

    fn apply(&self, x: &[f64], product: &mut [f64]) {
        chunks::update(product, |range, product| {
            for (product, cell) in product.iter_mut().zip(range) {
                let to_sides = self.to_sides[cell] * x[cell];
                *product = self.later.add_flows(cell, x, self.earlier.add_flows(cell, x, to_sides));
            }
        });
    }

    fn sweep_from_zero(&self, b: &[f64], x: &mut [f64]) {
        for (cell, (&b, &inverse)) in b.iter().zip(&self.inverse).enumerate() {
            x[cell] = self.earlier.add(cell, x, b) * inverse;
        }
    }

    fn add_rest_of_sweep(&self, x: &[f64], groups: &[u32], sums: &mut [f64]) {
        for (cell, &group) in groups.iter().enumerate() {
            sums[group as usize] += self.later.add(cell, x, 0.0);
        }
    }

    fn sweep_back(&self, b: &[f64], x: &mut [f64]) {
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
