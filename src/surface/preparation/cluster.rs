//! Clusters of a few heights that stand far above those around them.

use crate::formats::Scan;
use crate::surface::bends::median;
use ndarray::{Array2, Axis};

/// Clusters are narrower than this many nodes along both axes: what a square of so many nodes fits below is a part of the surface.
const WIDTH: usize = 6;
/// How far above such squares the nodes of a cluster are at least, over the median of all heights there.
const ABOVE: f64 = 6.0;
/// The least drop from the lowest node of a cluster to the highest one around it, over the step between neighbours that only `1 - LARGE` of them
/// exceed. Summits of a surface go down in usual steps, also those of heights with long tails; an artefact goes down at once.
const CLIFF: f64 = 3.5;
const LARGE: f64 = 0.97;
/// The most steps of which the large ones are found.
const SAMPLE: usize = 1 << 16;

/// The nodes of each cluster of up to 5 x 5 heights that is above all heights around it by a cliff.
pub(in crate::surface) fn clusters(scan: &Scan) -> Vec<Vec<(usize, usize)>> {
    let above = above_squares(scan);
    let mut known: Vec<f64> = above.iter().copied().filter(|it| !it.is_nan()).collect();
    let Some(middle) = median(&mut known) else { return Vec::new() };
    let cliff = CLIFF * scan.axes().map(|axis| large_step(scan, axis)).fold(0.0, f64::max);
    let least = cliff.max(ABOVE * middle);
    let marked = above.mapv(|it| it > least);
    let mut visited = Array2::from_elem(marked.dim(), false);
    let mut found = Vec::new();
    for (start, _) in marked.indexed_iter().filter(|(_, it)| **it) {
        if visited[start] {
            continue;
        }
        let (nodes, drop) = cluster(scan, &marked, &mut visited, start);
        if nodes.len() < WIDTH * WIDTH && drop > cliff {
            found.push(nodes);
        }
    }
    found
}

/// The step between neighbours along an axis that only a few exceed.
fn large_step(scan: &Scan, axis: usize) -> f64 {
    let pairs = scan.height.axis_windows(Axis(axis), 2).into_iter();
    let steps = pairs.flat_map(|pair| &pair.index_axis(Axis(axis), 1) - &pair.index_axis(Axis(axis), 0));
    let every = scan.height.len().div_ceil(SAMPLE);
    let mut steps: Vec<f64> = steps.step_by(every).filter(|it| !it.is_nan()).map(f64::abs).collect();
    let place = (LARGE * steps.len() as f64) as usize;
    if place < steps.len() { *steps.select_nth_unstable_by(place, f64::total_cmp).1 } else { 0.0 }
}

/// The nodes of the cluster at a node, and how far the lowest of them is above the highest one beside them.
fn cluster(
    scan: &Scan,
    marked: &Array2<bool>,
    visited: &mut Array2<bool>,
    start: (usize, usize),
) -> (Vec<(usize, usize)>, f64) {
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
    (nodes, lowest - highest_beside)
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
