//! Hills and dales of a surface that are significant: their number and the heights of the largest.

use crate::grid::Grid;
use crate::surface::Surface;

/// The least height of a hill above the highest saddle to a higher one, over the peak to valley height: the Wolf pruning of 5 % that ISO 25178-2
/// takes for S5z and Spd.
const PRUNING: f64 = 0.05;
/// The hills, and the dales, over which S5z takes the mean.
const FIVE: usize = 5;
/// No node.
const NONE: u32 = u32::MAX;

/// The significant hills and dales of a surface.
///
/// A hill is a node that is higher than its eight neighbours, with what drains from it. It is merged with a higher one where it rises by less than
/// 5 % of the peak to valley height above the highest saddle between both (Wolf pruning), and dales likewise. Hills at free rims count.
///
/// Source: ISO 25178-2:2021, feature parameters; the order in which hills merge follows from sinking water (the merge tree), which
/// leaves the same hills as pruning the smallest one first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SignificantHills {
    /// Mean height of the five highest peaks plus mean depth of the five deepest pits; none if there are fewer.
    pub ten_point_height: Option<f64>,
    /// Number of hills over the area of the cell.
    pub peak_density: f64,
}

impl SignificantHills {
    /// The hills and dales of a surface, not of a line.
    pub(crate) fn new(surface: &Surface, peak_to_valley: f64) -> Self {
        let grid = surface.grid();
        let heights = surface.heights();
        let least = PRUNING * peak_to_valley;
        let peaks = significant_peaks(heights, grid, least);
        let pits = significant_peaks(&heights.iter().map(|height| -height).collect::<Vec<_>>(), grid, least);
        let [ly, lx] = grid.size();
        Self {
            ten_point_height: mean_of_five(&peaks).zip(mean_of_five(&pits)).map(|(peaks, pits)| peaks + pits),
            peak_density: peaks.len() as f64 / (ly * lx),
        }
    }
}

/// The mean of the first five heights.
fn mean_of_five(heights: &[f64]) -> Option<f64> {
    heights.get(..FIVE).map(|highest| highest.iter().sum::<f64>() / FIVE as f64)
}

/// The heights of the peaks, the highest first, that rise by at least `least` above the highest saddle to a higher one; none of a flat.
fn significant_peaks(heights: &[f64], grid: &Grid, least: f64) -> Vec<f64> {
    let mut order: Vec<u32> = (0..heights.len() as u32).collect();
    order.sort_unstable_by(|one, other| {
        heights[*other as usize].total_cmp(&heights[*one as usize]).then(one.cmp(other))
    });
    let mut hills = Hills { parent: vec![NONE; heights.len()] };
    let mut peaks = Vec::new();
    // water that sinks uncovers the nodes from the highest one on: a node beside no other begins a hill, and one between two hills is their saddle
    for node in order {
        hills.parent[node as usize] = node;
        for neighbour in neighbours(grid, node as usize) {
            if hills.parent[neighbour] == NONE {
                continue;
            }
            let [one, other] = [hills.top(neighbour as u32), hills.top(node)];
            if one == other {
                continue;
            }
            let is_lower = |one: u32, other: u32| (heights[one as usize], other) < (heights[other as usize], one);
            let (lower, higher) = if is_lower(one, other) { (one, other) } else { (other, one) };
            let rise = heights[lower as usize] - heights[node as usize];
            if rise > 0.0 && rise >= least {
                peaks.push(heights[lower as usize]);
            }
            hills.parent[lower as usize] = higher;
        }
    }
    // the highest hill has no saddle to a higher one
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least > 0.0 {
        peaks.push(highest);
    }
    peaks.sort_unstable_by(|one, other| other.total_cmp(one));
    peaks
}

/// The eight nodes around a node, fewer at free rims.
fn neighbours(grid: &Grid, node: usize) -> impl Iterator<Item = usize> {
    let steps = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [dy, dx])).filter(|step| *step != [0, 0]);
    let ([y, x], [ny, nx], periodic) = (grid.place(node), grid.shape(), grid.periodic());
    let is_there =
        move |i: usize, step: isize, n: usize, round: bool| round || (0..n as isize).contains(&(i as isize + step));
    let inside = steps.filter(move |[dy, dx]| is_there(y, *dy, ny, periodic[0]) && is_there(x, *dx, nx, periodic[1]));
    inside.map(move |step| grid.neighbour(node, step))
}

/// Hills that merge: each node knows one above it on the same hill, and a top itself.
struct Hills {
    parent: Vec<u32>,
}

impl Hills {
    /// The top of the hill of a node. Paths are halved on the way, so that they stay short.
    fn top(&mut self, mut node: u32) -> u32 {
        while self.parent[node as usize] != node {
            let above = self.parent[node as usize];
            self.parent[node as usize] = self.parent[above as usize];
            node = above;
        }
        node
    }
}
