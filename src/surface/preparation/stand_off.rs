//! How far nodes stand off those on both sides of them.

use crate::formats::Scan;
use crate::surface::bends::{DEVIATION, median};

/// The most heights that a scale is found from: more of them hardly change it.
const MOST: usize = 1 << 16;
/// Heights that differ by less than this part of the range of all are equal.
const ROUNDING: f64 = 1e-9;

/// How far nodes stand off those at some distances on both sides along a direction, and how far chance lets them.
pub(super) struct StandOff<'a> {
    scan: &'a Scan,
    /// The step to the next node along the direction, in rows and columns.
    step: [isize; 2],
    /// The steps to the node before, and to the one behind.
    sides: [isize; 2],
    /// The standard deviation of the heights from the means of both sides, by the median of their magnitudes.
    pub scale: f64,
    /// The same of the differences from one side, which a cusp has on both sides.
    pub slope: f64,
}

/// The difference below which heights of a scan are equal.
pub(super) fn rounding(scan: &Scan) -> f64 {
    ROUNDING * scan.reach()
}

impl<'a> StandOff<'a> {
    /// The nodes of a scan and those at some numbers of steps on both sides, with the difference of heights below which they are equal; none
    /// where no node has both.
    pub(crate) fn new(scan: &'a Scan, step: [isize; 2], sides: [isize; 2], equal: f64) -> Option<Self> {
        let mut it = Self { scan, step, sides, scale: 0.0, slope: 0.0 };
        let [ny, nx] = scan.shape();
        let every = (ny * nx).div_ceil(MOST);
        let nodes = (0..ny * nx).step_by(every).map(|i| [i / nx, i % nx]);
        let mut deviations: Vec<f64> = nodes.clone().filter_map(|node| it.bend(node)).collect();
        let mut slopes: Vec<f64> =
            nodes.filter_map(|node| it.heights(node)).map(|[one, other, _]| (other - one).abs()).collect();
        it.slope = DEVIATION * median(&mut slopes)?;
        it.scale = (DEVIATION * median(&mut deviations)?).max(equal);
        Some(it)
    }

    /// The heights at a node and on both sides of it, if all of them are there.
    fn heights(&self, [y, x]: [usize; 2]) -> Option<[f64; 3]> {
        let at = |steps: isize| {
            let [row, column] =
                [y.checked_add_signed(steps * self.step[0])?, x.checked_add_signed(steps * self.step[1])?];
            self.scan.height.get([row, column]).copied().filter(|h| !h.is_nan())
        };
        Some([at(-self.sides[0])?, at(0)?, at(self.sides[1])?])
    }

    /// The magnitude of the difference between a node and the straight line through both sides.
    fn bend(&self, node: [usize; 2]) -> Option<f64> {
        let [near, far] = self.sides.map(|it| it as f64);
        self.heights(node).map(|[before, here, after]| (here - (far * before + near * after) / (near + far)).abs())
    }

    /// How far a node is above both sides, or below both of them (then negative): the lesser difference; 0 where it is between them. None
    /// where a height is not there.
    pub(crate) fn at(&self, node: [usize; 2]) -> Option<f64> {
        let [before, here, after] = self.heights(node)?;
        let [one, other] = [here - before, here - after];
        Some(if one * other <= 0.0 { 0.0 } else { one.signum() * one.abs().min(other.abs()) })
    }

    /// Whether a difference at a node is more than some standard deviations, both of all nodes and of those in the window
    /// that reaches some nodes to each side of it.
    pub(crate) fn is_beyond(&self, difference: f64, deviations: f64, [y, x]: [usize; 2], reach: usize) -> bool {
        let exceeds = |scale: f64| difference > deviations * scale;
        if !exceeds(self.scale) {
            return false;
        }
        let [rows, columns] = [(y, 0), (x, 1)].map(|(place, axis)| {
            let reach = if self.scan.shape()[axis] == 1 { 0 } else { reach };
            place.saturating_sub(reach)..(place + reach + 1).min(self.scan.shape()[axis])
        });
        // The median of the window is exceeded where at least half of its values are. They are counted and not sorted,
        // since a map with thousands of spikes asks this at each of them: its survey takes less than half the time so.
        let (mut known, mut exceeded) = (0, 0);
        for row in rows {
            for column in columns.clone() {
                let Some(bend) = self.bend([row, column]) else { continue };
                known += 1;
                exceeded += usize::from(exceeds(DEVIATION * bend));
            }
        }
        known == 0 || exceeded > (known - 1) / 2
    }
}
