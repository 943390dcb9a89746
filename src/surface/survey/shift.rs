//! Every second scan line shifted along the lines, as where trace and retrace are one map.

use crate::formats::Scan;
use ndarray::Axis;

/// The largest shift that is looked for, in nodes.
const FARTHEST: isize = 4;
/// The most that a shift leaves of the mean square difference between a line and the mean of the lines beside it.
const LEFT: f64 = 0.7;

/// Every second line across an axis is shifted by some nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LineShift {
    /// By how many nodes.
    pub nodes: usize,
    /// The part of the rms gradient that the shift makes.
    pub share: f64,
}

impl LineShift {
    /// The shift of every second row (axis 0) or column; none where none makes the lines fit better. Waves that run obliquely over the map shift
    /// each line by the same, so that the mean of the lines on both sides is not shifted.
    pub(crate) fn new(scan: &Scan, axis: usize) -> Option<Self> {
        let [ny, nx] = scan.shape();
        if ny.min(nx) < 16 {
            return None;
        }
        let left = |shift: isize| differences(scan, axis, shift);
        let here = left(0);
        let shifts = (-FARTHEST..=FARTHEST).filter(|shift| *shift != 0);
        let (best, least) = shifts.map(|it| (it, left(it))).min_by(|a, b| a.1.total_cmp(&b.1))?;
        // a pattern that repeats after some nodes fits as well when it is shifted by them
        let is_found = here > 0.0 && least < LEFT * here && least < LEFT * left(-best);
        if !is_found {
            return None;
        }
        let slopes = [0, 1].map(|axis| (scan.rms_step(axis) / scan.spacing[axis]).powi(2));
        // what neighbouring lines differ by is the difference to their mean and half of that of the lines beside them
        let by_shift = (here - least) / scan.spacing[axis].powi(2);
        let share = 1.0 - (1.0 - (by_shift / (slopes[0] + slopes[1])).min(1.0)).sqrt();
        Some(Self { nodes: best.unsigned_abs(), share })
    }
}

/// The mean square difference between every second line, shifted by some nodes, and the mean of the lines on both sides of it.
fn differences(scan: &Scan, axis: usize, shift: isize) -> f64 {
    let (lines, nodes) = (scan.shape()[axis], scan.shape()[1 - axis]);
    let (mut sum, mut count) = (0.0, 0usize);
    for place in (1..lines - 1).step_by(2) {
        let [before, here, after] = [place - 1, place, place + 1].map(|i| scan.height.index_axis(Axis(axis), i));
        for node in FARTHEST as usize..nodes - FARTHEST as usize {
            let off = here[node.wrapping_add_signed(shift)] - 0.5 * (before[node] + after[node]);
            if !off.is_nan() {
                sum += off * off;
                count += 1;
            }
        }
    }
    sum / count.max(1) as f64
}
