//! Peaks or valleys that were cut off.

use super::scales::{sample, usual};
use crate::formats::Scan;
use crate::surface::Detrend;
use ndarray::{Array2, Axis, Slice};

/// The shares of the heights at which peaks are cut off, and the fewest of these heights: with less they are no plateaus, and with more they
/// are the surface.
const SHARES: std::ops::Range<f64> = 5e-4..0.2;
const FEWEST: usize = 8;
/// Shapes of fewer heights, such as steps, have no peaks.
const FEWEST_LEVELS: usize = 64;
/// Heights are flat where the rms of their bends and slopes are below these parts of those that are usual without the form: a level plane
/// may have been subtracted.
const FLAT: [f64; 2] = [0.15, 0.3];
/// The fewest of the heights that may be called flat by chance.
const CHANCE: f64 = 2e-3;
/// Stencils of bends and slopes.
const STENCILS: [[f64; 3]; 2] = [[1.0, -2.0, 1.0], [-0.5, 0.0, 0.5]];
/// The share of the flat heights below the plateau that are not of it.
const BELOW: f64 = 0.1;
/// The least share of the nodes on a plateau and above it that are flat. Nothing lies above heights that were cut off, and they are flat but
/// for their noise; above heights that are flat by chance lie the peaks of the surface. Of 600 whole and 600
/// clipped profiles and maps, with and without a form, 22 and 376 are found with 0.3, and 35 and 398 with 0.2.
const FLAT_SHARE: f64 = 0.3;
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
    pub(crate) fn both(scan: &Scan) -> [Option<Self>; 2] {
        if levels(scan) <= FEWEST_LEVELS {
            return [None; 2];
        }
        let all = (scan.height.len() - scan.voids()).max(1) as f64;
        let plateaus = PlateauSearch::new(scan);
        [true, false].map(|is_top| {
            let nodes = equal(scan, is_top).max(plateaus.count(is_top));
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

/// What is needed to find heights that are flat more often than chance lets them be.
struct PlateauSearch {
    /// The heights without their plane.
    level: Scan,
    /// The flat nodes of these.
    flat: Array2<bool>,
    /// The nodes at which the form alone has so small a slope that roughness on it may be flat.
    can_be_flat: Array2<bool>,
    /// The share of nodes that are flat by chance: that in the middle of the heights without their form.
    chance: f64,
}

impl PlateauSearch {
    fn new(scan: &Scan) -> Self {
        let level = Detrend::Plane.apply(scan.clone());
        // Slopes of a ball or a cylinder vanish at its crest alone. Beside the slopes of the form, roughness there would look flat, so
        // usual slopes and the share of what is flat by chance are those of the heights without their form.
        let rough = Detrend::Curvature.apply(scan.clone());
        let limits = Limits::new(&rough);
        let mut form = level.clone();
        form.height -= &rough.height;
        let [low, high] = quarters(&rough);
        let (mut flat_in_middle, mut middle) = (0usize, 0usize);
        for (h, is_flat) in rough.height.iter().zip(&flat_nodes(&rough, &limits)) {
            if (low..=high).contains(h) {
                middle += 1;
                flat_in_middle += usize::from(*is_flat);
            }
        }
        let flat = flat_nodes(&level, &limits);
        let can_be_flat = limits.nodes_without_slope(&form);
        Self { level, flat, can_be_flat, chance: flat_in_middle as f64 / middle.max(1) as f64 }
    }

    /// The nodes of the plateaus among the highest or lowest heights; 0 if there are none.
    fn count(&self, is_top: bool) -> usize {
        let [low, high] = quarters(&self.level);
        let is_end = |h: f64| if is_top { h > high } else { h < low };
        let mut end = self.flat.clone();
        let mut can_be_flat = 0usize;
        for ((is_flat, h), can_be) in end.iter_mut().zip(&self.level.height).zip(&self.can_be_flat) {
            *is_flat &= is_end(*h);
            can_be_flat += usize::from(*can_be && is_end(*h));
        }
        let count = end.iter().filter(|it| **it).count() as f64;
        let is_more_often = count > OFTEN * self.chance * can_be_flat as f64;
        if is_more_often && count >= CHANCE * self.level.height.len() as f64 { self.beyond(&end, is_top) } else { 0 }
    }

    /// The nodes that are as high or as low as the plane through marked ones; 0 if most of them are not flat.
    fn beyond(&self, marked: &Array2<bool>, is_top: bool) -> usize {
        let sign = if is_top { 1.0 } else { -1.0 };
        let above = Detrend::plane_through(&self.level, marked).height.mapv(|h| sign * h);
        let mut plateau: Vec<f64> = above.iter().zip(marked).filter(|it| *it.1).map(|it| *it.0).collect();
        plateau.sort_unstable_by(f64::total_cmp);
        let least = plateau[(BELOW * plateau.len() as f64) as usize];
        let beyond = above.iter().filter(|h| **h >= least).count();
        let flat = plateau.iter().filter(|h| **h >= least).count();
        if flat as f64 >= FLAT_SHARE * beyond as f64 { beyond } else { 0 }
    }
}

/// The heights below and above which a quarter of them is.
fn quarters(scan: &Scan) -> [f64; 2] {
    let heights = sample(scan);
    [END, 1.0 - END].map(|share| heights.get((share * heights.len() as f64) as usize).copied().unwrap_or(0.0))
}

/// The bends and slopes along each axis up to which heights are flat.
struct Limits(Vec<(usize, [f64; 2])>);

impl Limits {
    /// Those of heights without a form.
    fn new(rough: &Scan) -> Self {
        let limits = |axis: usize| std::array::from_fn(|i| FLAT[i] * usual(rough, axis, &STENCILS[i]));
        Self(rough.axes().map(|axis| (axis, limits(axis))).collect())
    }

    /// The nodes at which a smooth form has a slope below that of flat heights along all axes. Nodes at the rim have none.
    fn nodes_without_slope(&self, form: &Scan) -> Array2<bool> {
        let is_level = |axis: usize, node: [usize; 2], most: f64| {
            stencil(form, axis, node).is_some_and(|[before, _, after]| (0.5 * (after - before)).abs() < most)
        };
        Array2::from_shape_fn(form.height.dim(), |(y, x)| {
            self.0.iter().all(|(axis, [_, slope])| is_level(*axis, [y, x], *slope))
        })
    }
}

/// Which nodes are flat: those of the stencils of a node and its neighbours, where these have hardly a bend or a slope on average.
fn flat_nodes(scan: &Scan, limits: &Limits) -> Array2<bool> {
    let square = Array2::from_shape_fn(scan.height.dim(), |(y, x)| {
        limits.0.iter().map(|(axis, most)| departure(scan, *axis, [y, x], *most)).sum::<f64>()
    });
    let around = |(y, x): (usize, usize)| -> f64 {
        let beside = |[row, column]: [usize; 2]| square.get([row, column]).copied().unwrap_or(0.0);
        let neighbours = [[y.wrapping_sub(1), x], [y + 1, x], [y, x.wrapping_sub(1)], [y, x + 1]];
        square[(y, x)] + neighbours.into_iter().map(beside).sum::<f64>()
    };
    let axes = limits.0.len() as f64;
    let flat = Array2::from_shape_fn(scan.height.dim(), |node| around(node) < axes * (1.0 + 2.0 * axes));
    if flat.iter().any(|it| *it) { spread(&spread(&flat, scan), scan) } else { flat }
}

/// The heights before, at and after a node along an axis; none at the rim.
fn stencil(scan: &Scan, axis: usize, [y, x]: [usize; 2]) -> Option<[f64; 3]> {
    let at = |i: usize| match axis {
        0 => scan.height.get([(y + i).wrapping_sub(1), x]),
        _ => scan.height.get([y, (x + i).wrapping_sub(1)]),
    };
    Some([*at(0)?, *at(1)?, *at(2)?])
}

/// How far a node departs from a level plane along an axis: the squares of bend and slope over those that flat heights may have.
fn departure(scan: &Scan, axis: usize, node: [usize; 2], most: [f64; 2]) -> f64 {
    let Some([before, here, after]) = stencil(scan, axis, node) else { return f64::NAN };
    let of = |[a, b, c]: [f64; 3], most: f64| match a * before + b * here + c * after {
        0.0 => 0.0,
        it => (it / most).powi(2),
    };
    (0..2).map(|i| of(STENCILS[i], most[i])).sum()
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
