//! Contact patches: connected sets of nodes in contact.

use crate::chunks;
use crate::contact::Problem;
use crate::forest::Forest;
use crate::grid::Grid;
use serde::Serialize;
use std::ops::Range;

/// The contact patches of a pressure field: sets of nodes with `p > 0` that are connected along rows or columns, across
/// the period if there is one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patches {
    sizes: Vec<usize>,
}

impl Patches {
    /// Finds the patches of `pressure` (row by row) on a grid.
    pub fn new(pressure: &[f64], grid: &Grid) -> Self {
        let mut sizes: Vec<usize> =
            members(pressure, grid, grid.shape()).iter().map(|runs| runs.iter().map(Range::len).sum()).collect();
        sizes.sort_unstable_by(|a, b| b.cmp(a));
        Self { sizes }
    }

    /// Number of patches.
    pub fn count(&self) -> usize {
        self.sizes.len()
    }

    /// Nodes of each patch, largest first.
    pub fn sizes(&self) -> &[usize] {
        &self.sizes
    }
}

/// The nodes of each patch as runs along rows, by their numbers on the grid, within its first rows and columns. Where these are not all, no patch
/// goes on across the period.
///
/// Runs of contact along rows are joined with overlapping runs of the next row. The cost is one pass over the nodes,
/// and the work for the runs.
fn members(pressure: &[f64], grid: &Grid, [ny, nx]: [usize; 2]) -> Vec<Vec<Range<usize>>> {
    let ([whole_y, width], [periodic_y, periodic_x]) = (grid.shape(), grid.periodic());
    let [round_y, round_x] = [periodic_y && ny == whole_y, periodic_x && nx == width];
    let rows: Vec<Vec<Range<usize>>> =
        chunks::rows(ny, nx, |y| chunks::positive_runs(&pressure[y * width..][..nx], 0..nx));
    let count_before = |count: &mut usize, row: &Vec<Range<usize>>| {
        *count += row.len();
        Some(*count - row.len())
    };
    let first: Vec<usize> = rows.iter().scan(0, count_before).collect();
    let runs_in_all = rows.iter().map(Vec::len).sum();
    let mut forest = Forest::new(runs_in_all);
    for (row, &at) in rows.iter().zip(&first) {
        if let [head, .., tail] = row.as_slice()
            && round_x
            && head.start == 0
            && tail.end == nx
        {
            forest.join(at, at + row.len() - 1);
        }
    }
    for y in 0..if ny == 1 {
        0
    } else if round_y {
        ny
    } else {
        ny - 1
    } {
        let next = (y + 1) % ny;
        for (a, b) in overlaps(&rows[y], &rows[next]) {
            forest.join(first[y] + a, first[next] + b);
        }
    }
    let mut patches = vec![Vec::new(); runs_in_all];
    let runs = rows
        .into_iter()
        .enumerate()
        .flat_map(|(y, row)| row.into_iter().map(move |run| y * width + run.start..y * width + run.end));
    runs.enumerate().for_each(|(run, nodes)| patches[forest.root(run)].push(nodes));
    patches.retain(|runs| !runs.is_empty());
    patches
}

/// One contact patch, measured by its own nodes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Patch {
    /// Nodes in contact.
    pub nodes: usize,
    /// The node of the largest pressure.
    pub peak: usize,
    /// Area, or length of a line, of its nodes.
    pub area: f64,
    /// Force, or force per length of a line.
    pub load: f64,
    /// `kappa_r = gbar_r E* area / load` with the gradient of its own nodes.
    pub kappa_r: f64,
    /// Mean position of its nodes along y and x, lengths from the first node on. Across a period, nodes are taken where they are nearest to the
    /// peak.
    pub centre: [f64; 2],
    /// Mean curvature of the surface over its nodes, an inverse length, positive where it bulges towards the solid, see
    /// [`Surface::curvature`](crate::Surface::curvature).
    pub curvature: f64,
}

impl Patch {
    /// The patches of nodes with `pressure > 0` (row by row), the largest first.
    pub fn all(problem: &Problem, pressure: &[f64]) -> Vec<Self> {
        Self::with_nodes(problem, pressure).into_iter().map(|(patch, _)| patch).collect()
    }

    /// The patches of nodes with `pressure > 0` (row by row), the largest first, each with its nodes as runs along rows, by their numbers on
    /// the grid.
    pub fn with_nodes(problem: &Problem, pressure: &[f64]) -> Vec<(Self, Vec<Range<usize>>)> {
        Self::within(problem, pressure, problem.surface().grid().shape())
    }

    /// The same of the first rows and columns of the grid, such as those of which the others are mirror images. A patch ends where they end.
    pub fn within(problem: &Problem, pressure: &[f64], part: [usize; 2]) -> Vec<(Self, Vec<Range<usize>>)> {
        let (surface, grid) = (problem.surface(), problem.surface().grid());
        let [dy, dx] = grid.spacing();
        let cell = if grid.is_line() { dx } else { dy * dx };
        let square_gradient = surface.square_gradient();
        let (curvature, modulus) = (surface.curvature(), problem.effective_modulus(pressure));
        let measure = |runs: Vec<Range<usize>>| {
            let nodes = || runs.iter().cloned().flatten();
            let count = nodes().count();
            let load = cell * nodes().map(|node| pressure[node]).sum::<f64>();
            let gradient = (nodes().map(&square_gradient).sum::<f64>() / count as f64).sqrt();
            let area = cell * count as f64;
            let peak = nodes().max_by(|&a, &b| pressure[a].total_cmp(&pressure[b])).unwrap_or_default();
            let kappa_r = gradient * modulus * area / load;
            let centre = centre(grid, peak, nodes());
            let curvature = nodes().map(&curvature).sum::<f64>() / count as f64;
            (Self { nodes: count, peak, area, load, kappa_r, centre, curvature }, runs)
        };
        let mut patches: Vec<_> = members(pressure, grid, part).into_iter().map(measure).collect();
        patches.sort_by_key(|(patch, _)| std::cmp::Reverse(patch.nodes));
        patches
    }
}

/// The mean position of some nodes, each taken where it is nearest to the `peak`.
fn centre(grid: &Grid, peak: usize, nodes: impl Iterator<Item = usize>) -> [f64; 2] {
    let (shape, spacing, periodic) = (grid.shape(), grid.spacing(), grid.periodic());
    let place = |node: usize| [node / shape[1], node % shape[1]].map(|it| it as f64);
    let (from, mut sum, mut count) = (place(peak), [0.0; 2], 0.0);
    for at in nodes.map(place) {
        count += 1.0;
        for axis in 0..2 {
            let (apart, period) = (at[axis] - from[axis], shape[axis] as f64);
            sum[axis] += if periodic[axis] { apart - period * (apart / period).round() } else { apart };
        }
    }
    let mean = |axis: usize| spacing[axis] * (from[axis] + sum[axis] / count).rem_euclid(shape[axis] as f64);
    [mean(0), mean(1)]
}

/// Pairs of runs that share a column, both lists being in order.
fn overlaps(a: &[Range<usize>], b: &[Range<usize>]) -> Vec<(usize, usize)> {
    let (mut i, mut j) = (0, 0);
    let mut pairs = Vec::new();
    while i < a.len() && j < b.len() {
        if a[i].start < b[j].end && b[j].start < a[i].end {
            pairs.push((i, j));
        }
        if a[i].end < b[j].end { i += 1 } else { j += 1 }
    }
    pairs
}
