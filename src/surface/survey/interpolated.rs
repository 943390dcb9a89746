//! Heights between which a program has interpolated.

use crate::formats::Scan;
use ndarray::{ArrayView1, Axis};

/// The factors by which maps are enlarged, the largest first: a map that is enlarged four times has bends at every second node at most, as well.
const FACTORS: [usize; 4] = [5, 4, 3, 2];
/// The fewest nodes along an axis.
const FEWEST_NODES: usize = 32;
/// The most lines whose bends are looked at.
const MOST_LINES: usize = 64;
/// Bends between the heights that were measured, over the usual one at them, up to which they are rounding: linear interpolation has no bends there, and
/// heights in single precision have some. Of rough heights the usual bends at all nodes are the same but for chance.
const NO_BEND: f64 = 0.02;
/// The part of the nodes between measured heights that have no bend: in a map that was enlarged by another factor it is at most four fifths.
const NEARLY_ALL: f64 = 0.9;

/// By how many times a map or a profile was enlarged along an axis by linear interpolation: it bends at every second, third, ... node only.
pub(super) fn interpolated(scan: &Scan, axis: usize) -> Option<usize> {
    let nodes = scan.shape()[axis];
    if nodes < FEWEST_NODES {
        return None;
    }
    let lanes = scan.height.lanes(Axis(axis)).into_iter();
    let every = (scan.height.len() / nodes).div_ceil(MOST_LINES);
    let lines: Vec<_> = lanes.step_by(every).collect();
    FACTORS.into_iter().find(|factor| {
        let all: Vec<Vec<f64>> =
            (0..*factor).map(|first| bends(&lines, (1..nodes - 1).filter(|i| i % factor == first))).collect();
        let usual: Vec<f64> = all.iter().map(|it| quantile(it, 0.5)).collect();
        let most = usual.iter().copied().fold(0.0, f64::max);
        let between = all.iter().filter(|it| quantile(it, NEARLY_ALL) < NO_BEND * most).count();
        between == factor - 1
    })
}

/// The magnitudes of the bends of some lines at some nodes, rising.
fn bends(lines: &[ArrayView1<'_, f64>], nodes: impl Iterator<Item = usize>) -> Vec<f64> {
    let mut all = Vec::new();
    for i in nodes {
        all.extend(
            lines.iter().map(|line| (line[i - 1] - 2.0 * line[i] + line[i + 1]).abs()).filter(|it| !it.is_nan()),
        );
    }
    all.sort_unstable_by(f64::total_cmp);
    all
}

/// The value that a part of some rising ones does not exceed; 0 without any.
fn quantile(rising: &[f64], part: f64) -> f64 {
    rising.get((part * rising.len() as f64) as usize).copied().unwrap_or(0.0)
}
