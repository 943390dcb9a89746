//! Parts of a map that are higher than the rest by one height, as jumps of an interferometer by half a wavelength make them.

use super::scales::usual;
use crate::formats::Scan;
use crate::surface::bends::median;
use ndarray::{Array2, Axis, Slice};

/// Steps between neighbours above this many usual ones are edges.
const EDGE: f64 = 8.0;
/// Edges are of one height where most of them, `MOST_ALIKE`, differ from their median by less than this many usual steps.
const WITHIN: f64 = 4.0;
const MOST_ALIKE: f64 = 0.6;
/// The most steps between a third and two thirds of that height, over the edges of that height: where a surface has steps of all sizes, as heights
/// with long tails have, its largest ones are no edges.
const MOST_BETWEEN: f64 = 0.1;
/// The fewest edges, and the largest part of the nodes that may be at one.
const FEWEST: usize = 64;
const MOST: f64 = 0.1;
/// The largest part of the edges that go on straight beside them: those of gratings, posts and scan lines do, and are of the surface or told by
/// another name. The outlines of parts that an interferometer puts too high are as irregular as the surface.
const STRAIGHT: f64 = 0.85;

/// The height, a length, by which parts of a map are higher than the rest behind irregular edges; none where there are no such parts.
pub(super) fn jump_of_parts(scan: &Scan) -> Option<f64> {
    if scan.is_line() {
        return None;
    }
    let usual_step = [0, 1].map(|axis| usual(scan, axis, &[-1.0, 1.0])).into_iter().fold(0.0, f64::max);
    let steps = [0, 1].map(|axis| {
        let (before, after) = (Slice::from(..-1), Slice::from(1..));
        let [before, after] = [before, after].map(|part| scan.height.slice_axis(Axis(axis), part));
        (&after - &before).mapv(f64::abs)
    });
    let mut edges: Vec<f64> = steps.iter().flatten().copied().filter(|step| *step > EDGE * usual_step).collect();
    let count = edges.len();
    if usual_step == 0.0 || count < FEWEST || count as f64 > MOST * scan.height.len() as f64 {
        return None;
    }
    let height = median(&mut edges)?;
    let is_alike = |step: &f64| (step - height).abs() < WITHIN * usual_step;
    let alike = edges.iter().filter(|step| is_alike(step)).count();
    let is_between = |step: &&f64| (height / 3.0..2.0 * height / 3.0).contains(*step);
    let between = steps.iter().flatten().filter(is_between).count();
    let (mut on_straight, mut all) = (0usize, 0usize);
    for (axis, steps) in steps.iter().enumerate() {
        let marked = steps.mapv(|step| is_alike(&step));
        all += marked.iter().filter(|it| **it).count();
        on_straight += straight(&marked, 1 - axis);
    }
    let is_irregular = (on_straight as f64) < STRAIGHT * all as f64;
    let is_of_one_height = alike as f64 > MOST_ALIKE * count as f64 && (between as f64) < MOST_BETWEEN * alike as f64;
    (is_of_one_height && is_irregular).then_some(height)
}

/// The number of marked places whose neighbour behind them along an axis is marked, too.
fn straight(marked: &Array2<bool>, axis: usize) -> usize {
    let pairs = marked.axis_windows(Axis(axis), 2).into_iter();
    pairs
        .map(|pair| {
            let [one, next] = [0, 1].map(|i| pair.index_axis(Axis(axis), i));
            one.iter().zip(next.iter()).filter(|(one, next)| **one && **next).count()
        })
        .sum()
}
