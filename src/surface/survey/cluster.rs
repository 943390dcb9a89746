//! Clusters of a few heights that stand far above those around them.

use super::scales::usual;
use crate::surface::Scan;
use crate::surface::bends::median;
use ndarray::{Array2, Axis};

/// Clusters are narrower than this many nodes along both axes: what a square of so many nodes fits below is a part of the surface.
const WIDTH: usize = 6;
/// How far above such squares the nodes of a cluster are at least, over the median of all heights there.
const ABOVE: f64 = 6.0;
/// The least drop from the lowest node of a cluster to the highest one around it, over the usual step between neighbours. Summits of a surface
/// go down in usual steps: of 400 random maps and profiles none has such a cliff all around.
const CLIFF: f64 = 6.0;

/// Clusters of up to 5 x 5 nodes that are above all nodes around them by a cliff.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clusters {
    /// How many there are.
    pub count: usize,
    /// Their nodes.
    pub nodes: usize,
}

impl Clusters {
    /// The clusters of some heights; none without.
    pub fn new(scan: &Scan) -> Option<Self> {
        let above = above_squares(scan);
        let mut known: Vec<f64> = above.iter().copied().filter(|it| !it.is_nan()).collect();
        let least = ABOVE * median(&mut known)?;
        let cliff = CLIFF * scan.axes().map(|axis| usual(scan, axis, &[-1.0, 1.0])).fold(0.0, f64::max);
        let marked = above.mapv(|it| it > least.max(cliff));
        let mut visited = Array2::from_elem(marked.dim(), false);
        let mut found = Self { count: 0, nodes: 0 };
        for (start, _) in marked.indexed_iter().filter(|(_, it)| **it) {
            if visited[start] {
                continue;
            }
            let (nodes, drop) = cluster(scan, &marked, &mut visited, start);
            if nodes < WIDTH * WIDTH && drop > cliff {
                found.count += 1;
                found.nodes += nodes;
            }
        }
        (found.count > 0).then_some(found)
    }
}

/// The number of nodes of the cluster at a node, and how far the lowest of them is above the highest one beside them.
fn cluster(scan: &Scan, marked: &Array2<bool>, visited: &mut Array2<bool>, start: (usize, usize)) -> (usize, f64) {
    let (mut nodes, mut next) = (vec![start], 0);
    let (mut lowest, mut highest_beside) = (f64::INFINITY, f64::NEG_INFINITY);
    visited[start] = true;
    while next < nodes.len() {
        let (y, x) = nodes[next];
        next += 1;
        lowest = lowest.min(scan.height[(y, x)]);
        for (dy, dx) in (0..3).flat_map(|dy| (0..3).map(move |dx| (dy, dx))) {
            let place = ((y + dy).wrapping_sub(1), (x + dx).wrapping_sub(1));
            match marked.get(place) {
                Some(true) if !visited[place] => {
                    visited[place] = true;
                    nodes.push(place);
                }
                Some(false) => highest_beside = highest_beside.max(scan.height[place]),
                _ => {}
            }
        }
    }
    (nodes.len(), lowest - highest_beside)
}

/// How far each height is above the highest level square of some nodes that fits below the heights there: the top hat of mathematical morphology.
fn above_squares(scan: &Scan) -> Array2<f64> {
    let mut level = scan.height.clone();
    for axis in scan.axes() {
        level = extreme(&level, axis, f64::min, WIDTH - 1, 0);
    }
    for axis in scan.axes() {
        level = extreme(&level, axis, f64::max, 0, WIDTH - 1);
    }
    &scan.height - &level
}

/// The least or largest of the heights from some nodes before each one to some nodes behind it along an axis; voids are left out.
fn extreme(height: &Array2<f64>, axis: usize, of: fn(f64, f64) -> f64, behind: usize, before: usize) -> Array2<f64> {
    let (axis, nodes) = (Axis(axis), height.len_of(Axis(axis)));
    let mut all = height.clone();
    for place in 0..nodes {
        let near = place.saturating_sub(before)..(place + behind + 1).min(nodes);
        for other in near.filter(|other| *other != place) {
            all.index_axis_mut(axis, place).zip_mut_with(&height.index_axis(axis, other), |it, h| *it = of(*it, *h));
        }
    }
    all
}
