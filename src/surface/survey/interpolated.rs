//! Heights between which a program has interpolated.

use crate::surface::Scan;
use crate::surface::bends::median;
use ndarray::Axis;

/// The factors by which maps are enlarged, the largest first: every sixth of the heights of a map that is enlarged three times would be one of two as well.
const FACTORS: [usize; 4] = [5, 4, 3, 2];
/// The fewest nodes along an axis.
const FEWEST: usize = 32;
/// The most lines whose bends are looked at.
const LINES: usize = 64;
/// The usual bend between the heights that were measured, over that at them, up to which it is rounding: linear interpolation has no bends there, and
/// heights in single precision have some. Of rough heights the usual bends at all nodes are the same but for chance.
const NO_BEND: f64 = 0.02;

/// By how many times a map or a profile was enlarged along an axis by linear interpolation: it bends at every second, third, ... node only.
pub(super) fn interpolated(scan: &Scan, axis: usize) -> Option<usize> {
    let nodes = scan.shape()[axis];
    if nodes < FEWEST {
        return None;
    }
    let lanes = scan.height.lanes(Axis(axis)).into_iter();
    let every = (scan.height.len() / nodes).div_ceil(LINES);
    let lines: Vec<_> = lanes.step_by(every).collect();
    FACTORS.into_iter().find(|factor| {
        let usual: Vec<f64> = (0..*factor)
            .map(|first| {
                let inner = (1..nodes - 1).filter(|i| i % factor == first);
                let bend =
                    |(line, i): (&ndarray::ArrayView1<f64>, usize)| (line[i - 1] - 2.0 * line[i] + line[i + 1]).abs();
                let mut bends: Vec<f64> = inner
                    .flat_map(|i| lines.iter().map(move |line| (line, i)))
                    .map(bend)
                    .filter(|it| !it.is_nan())
                    .collect();
                median(&mut bends).unwrap_or(0.0)
            })
            .collect();
        let most = usual.iter().copied().fold(0.0, f64::max);
        usual.iter().filter(|it| **it > NO_BEND * most).count() == 1
    })
}
