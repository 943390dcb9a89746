//! Peaks or valleys that were cut off.

use crate::surface::Scan;
use crate::surface::bends::{DEVIATION, median};
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
    /// The plateaus at the top or at the bottom.
    pub fn new(scan: &Scan, is_top: bool) -> Option<Self> {
        let all = scan.height.len() - scan.voids();
        let nodes = equal(scan, is_top).max(flat(scan, is_top));
        let share = nodes as f64 / all.max(1) as f64;
        let is_cut = nodes >= FEWEST && SHARES.contains(&share);
        (is_cut && super::artefact::levels(scan) > FEWEST_LEVELS).then_some(Self { nodes, share })
    }
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
fn flat(scan: &Scan, is_top: bool) -> usize {
    let [low, high] = quarters(scan);
    let sign = if is_top { 1.0 } else { -1.0 };
    let is_end = |h: f64| if is_top { h > high } else { h < low };
    let nodes = flat_nodes(scan);
    let flat = || scan.height.iter().zip(&nodes).filter(|(_, is_flat)| **is_flat).map(|(h, _)| *h);
    let mut end: Vec<f64> = flat().filter(|h| is_end(*h)).map(|h| sign * h).collect();
    let middle = flat().filter(|h| (low..=high).contains(h)).count();
    // half of the heights are in the middle
    let is_more_often = end.len() as f64 / END > OFTEN * middle as f64 / (1.0 - 2.0 * END);
    if !is_more_often || (end.len() as f64) < CHANCE * scan.height.len() as f64 {
        return 0;
    }
    end.sort_unstable_by(f64::total_cmp);
    let least = end[(BELOW * end.len() as f64) as usize];
    scan.height.iter().filter(|h| sign * **h >= least).count()
}

/// The heights below and above which a quarter of them is.
fn quarters(scan: &Scan) -> [f64; 2] {
    let heights = super::artefact::sample(scan);
    [END, 1.0 - END].map(|share| heights.get((share * heights.len() as f64) as usize).copied().unwrap_or(0.0))
}

/// Which nodes are flat: those of the stencils of a node and its neighbours, where these have hardly a bend or a slope on average.
fn flat_nodes(scan: &Scan) -> Array2<bool> {
    let mut square = Array2::<f64>::zeros(scan.height.dim());
    for axis in scan.axes() {
        for (stencil, part) in STENCILS.into_iter().zip(FLAT) {
            let found = differences(scan, axis, stencil);
            let mut known: Vec<f64> = found.iter().copied().filter(|it| !it.is_nan()).collect();
            let most = part * DEVIATION * median(&mut known).unwrap_or(0.0);
            square.zip_mut_with(&found, |sum, it| *sum += if *it == 0.0 { 0.0 } else { (it / most).powi(2) });
        }
    }
    let (mut around, axes) = (square.clone(), scan.axes().count() as f64);
    each_neighbour(scan, &square, &mut around, |sum, beside| *sum += beside);
    let flat = around.mapv(|sum| sum < axes * (1.0 + 2.0 * axes));
    spread(&spread(&flat, scan), scan)
}

/// The marked nodes and their neighbours along the axes.
fn spread(marked: &Array2<bool>, scan: &Scan) -> Array2<bool> {
    let mut all = marked.clone();
    each_neighbour(scan, marked, &mut all, |it, beside| *it |= beside);
    all
}

/// Does something for each node with each of its neighbours along the axes.
fn each_neighbour<T>(scan: &Scan, of: &Array2<T>, all: &mut Array2<T>, mut with: impl FnMut(&mut T, &T)) {
    let (first, last) = (Slice::from(..-1), Slice::from(1..));
    for (axis, [from, to]) in scan.axes().flat_map(|axis| [[first, last], [last, first]].map(|it| (Axis(axis), it))) {
        all.slice_axis_mut(axis, to).zip_mut_with(&of.slice_axis(axis, from), &mut with);
    }
}

/// The magnitudes of the sums of three successive heights along an axis times the factors of a stencil; NaN where one of them is not there.
fn differences(scan: &Scan, axis: usize, stencil: [f64; 3]) -> Array2<f64> {
    let mut all = Array2::from_elem(scan.height.dim(), f64::NAN);
    let count = scan.shape()[axis];
    if count > 2 {
        let part = |i: usize| {
            let part = scan.height.slice_axis(Axis(axis), Slice::from(i..i + count - 2));
            &part * stencil[i]
        };
        let found = (part(0) + part(1) + part(2)).mapv(f64::abs);
        all.slice_axis_mut(Axis(axis), Slice::from(1..count - 1)).assign(&found);
    }
    all
}
