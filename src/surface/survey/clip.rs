//! Peaks or valleys that were cut off.

use super::scales::{sample, usual};
use crate::surface::{Detrend, Scan};
use ndarray::{Array2, Axis, Slice};

/// The shares of the heights at which peaks are cut off, and the fewest of these heights: with less they are no plateaus, and with more they
/// are the surface.
const SHARES: std::ops::Range<f64> = 5e-4..0.2;
const FEWEST: usize = 8;
/// Shapes of fewer heights, such as steps, have no peaks.
const FEWEST_LEVELS: usize = 64;
/// Heights are flat where the rms of their bends and slopes are below these parts of the usual ones: a level plane may have been subtracted.
const FLAT: [f64; 2] = [0.15, 0.3];
/// The fewest of the heights that may be called flat by chance.
const CHANCE: f64 = 2e-3;
/// Stencils of bends and slopes.
const STENCILS: [[f64; 3]; 2] = [[1.0, -2.0, 1.0], [-0.5, 0.0, 0.5]];
/// The share of the flat heights below the plateau that are not of it.
const BELOW: f64 = 0.1;
/// The share of the highest heights among which plateaus are, and how many times more often heights are flat there than in the middle.
const END: f64 = 0.25;
const OFTEN: f64 = 4.0;

/// Plateaus at the highest heights, or at the lowest: equal heights, or, where they carry a little noise or a slope, heights without bends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clip {
    /// Their nodes.
    pub nodes: usize,
    /// Their share of all nodes.
    pub share: f64,
}

impl Clip {
    /// The plateaus at the top and at the bottom.
    pub fn both(scan: &Scan) -> [Option<Self>; 2] {
        if levels(scan) <= FEWEST_LEVELS {
            return [None; 2];
        }
        let all = (scan.height.len() - scan.voids()).max(1) as f64;
        let level = Detrend::Plane.apply(scan.clone());
        let flat_nodes = flat_nodes(&level);
        [true, false].map(|is_top| {
            let nodes = equal(scan, is_top).max(flat(&level, &flat_nodes, is_top));
            let share = nodes as f64 / all;
            (nodes >= FEWEST && SHARES.contains(&share)).then_some(Self { nodes, share })
        })
    }
}

/// The number of different heights, of some of the nodes.
fn levels(scan: &Scan) -> usize {
    let mut heights = sample(scan);
    heights.dedup();
    heights.len()
}

/// The nodes of the highest or lowest height with neighbours of the same height along all axes.
fn equal(scan: &Scan, is_top: bool) -> usize {
    let there = scan.height.iter().copied().filter(|h| !h.is_nan());
    let end = there.fold(f64::NAN, if is_top { f64::max } else { f64::min });
    let at = |node: [usize; 2]| scan.height.get(node).is_some_and(|h| *h == end);
    let has_equal = |[y, x]: [usize; 2], axis: usize| {
        let step =
            |sign: isize| if axis == 0 { [y.wrapping_add_signed(sign), x] } else { [y, x.wrapping_add_signed(sign)] };
        at(step(-1)) || at(step(1))
    };
    let nodes = scan.height.indexed_iter().map(|(node, _)| <[usize; 2]>::from(node));
    nodes.filter(|node| at(*node) && scan.axes().all(|axis| has_equal(*node, axis))).count()
}

/// The nodes that are as high or as low as those among the highest or lowest heights that are flat, if heights in the middle are not.
fn flat(scan: &Scan, nodes: &Array2<bool>, is_top: bool) -> usize {
    let [low, high] = quarters(scan);
    let is_end = |h: f64| if is_top { h > high } else { h < low };
    let (mut end, mut middle) = (nodes.clone(), 0);
    end.zip_mut_with(&scan.height, |it, h| {
        middle += usize::from(*it && (low..=high).contains(h));
        *it &= is_end(*h);
    });
    let count = end.iter().filter(|it| **it).count() as f64;
    // half of the heights are in the middle
    let is_more_often = count / END > OFTEN * middle as f64 / (1.0 - 2.0 * END);
    if is_more_often && count >= CHANCE * scan.height.len() as f64 { beyond(scan, &end, is_top) } else { 0 }
}

/// The nodes that are as high or as low as the plane through marked ones.
fn beyond(scan: &Scan, marked: &Array2<bool>, is_top: bool) -> usize {
    let sign = if is_top { 1.0 } else { -1.0 };
    let above = Detrend::plane_through(scan, marked).height.mapv(|h| sign * h);
    let mut plateau: Vec<f64> = above.iter().zip(marked).filter(|it| *it.1).map(|it| *it.0).collect();
    plateau.sort_unstable_by(f64::total_cmp);
    let least = plateau[(BELOW * plateau.len() as f64) as usize];
    above.iter().filter(|h| **h >= least).count()
}

/// The heights below and above which a quarter of them is.
fn quarters(scan: &Scan) -> [f64; 2] {
    let heights = sample(scan);
    [END, 1.0 - END].map(|share| heights.get((share * heights.len() as f64) as usize).copied().unwrap_or(0.0))
}

/// Which nodes are flat: those of the stencils of a node and its neighbours, where these have hardly a bend or a slope on average.
fn flat_nodes(scan: &Scan) -> Array2<bool> {
    let most = |axis: usize| STENCILS.map(|stencil| usual(scan, axis, &stencil));
    let most: Vec<(usize, [f64; 2])> = scan.axes().map(|axis| (axis, most(axis))).collect();
    let square = Array2::from_shape_fn(scan.height.dim(), |(y, x)| {
        most.iter().map(|(axis, most)| departure(scan, *axis, [y, x], *most)).sum::<f64>()
    });
    let around = |(y, x): (usize, usize)| -> f64 {
        let beside = |[row, column]: [usize; 2]| square.get([row, column]).copied().unwrap_or(0.0);
        let neighbours = [[y.wrapping_sub(1), x], [y + 1, x], [y, x.wrapping_sub(1)], [y, x + 1]];
        square[(y, x)] + neighbours.into_iter().map(beside).sum::<f64>()
    };
    let axes = most.len() as f64;
    let flat = Array2::from_shape_fn(scan.height.dim(), |node| around(node) < axes * (1.0 + 2.0 * axes));
    if flat.iter().any(|it| *it) { spread(&spread(&flat, scan), scan) } else { flat }
}

/// How far a node departs from a level plane along an axis: the squares of bend and slope over those that flat heights may have.
fn departure(scan: &Scan, axis: usize, [y, x]: [usize; 2], usual: [f64; 2]) -> f64 {
    let at = |i: usize| match axis {
        0 => scan.height.get([(y + i).wrapping_sub(1), x]),
        _ => scan.height.get([y, (x + i).wrapping_sub(1)]),
    };
    let [Some(before), Some(here), Some(after)] = [at(0), at(1), at(2)] else { return f64::NAN };
    let of = |[a, b, c]: [f64; 3], most: f64| match a * before + b * here + c * after {
        0.0 => 0.0,
        it => (it / most).powi(2),
    };
    (0..2).map(|i| of(STENCILS[i], FLAT[i] * usual[i])).sum()
}

/// The marked nodes and their neighbours along the axes.
fn spread(marked: &Array2<bool>, scan: &Scan) -> Array2<bool> {
    let mut all = marked.clone();
    let (first, last) = (Slice::from(..-1), Slice::from(1..));
    for (axis, [from, to]) in scan.axes().flat_map(|axis| [[first, last], [last, first]].map(|it| (Axis(axis), it))) {
        all.slice_axis_mut(axis, to).zip_mut_with(&marked.slice_axis(axis, from), |it, beside| *it |= beside);
    }
    all
}
