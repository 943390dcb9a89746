//! Stretches of scan lines that stand off the lines beside them.

use super::stand_off::{StandOff, rounding};
use crate::formats::Scan;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The fewest nodes of a scar.
const SHORTEST: usize = 8;
/// Standard deviations by which each node of a scar stands off, and by which half of them do.
const DEVIATIONS: [f64; 2] = [3.0, 6.0];
/// The largest share of the nodes that may be in scars: with more, scars are neighbours of scars, and what stands off is the surface.
const MOST: f64 = 0.07;

/// What becomes of scars: stretches of a scan line, where the probe lost the surface, that stand off the lines on both sides.
///
/// A scar has at least 8 nodes along the line. All of them are above both neighbouring lines, or below both of them, by three standard
/// deviations of such differences, and half of them by six. Where more than 7 % of the nodes are in scars, there are none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Scars {
    /// Those along rows become voids.
    ///
    /// Voids can be filled with the smoothest heights.
    Rows,
    /// Those along columns become voids.
    Columns,
}

impl Scars {
    /// The heights without scars.
    pub fn apply(self, mut scan: Scan) -> Scan {
        self.find(&scan).into_iter().for_each(|node| scan.height[node] = f64::NAN);
        scan
    }

    /// The nodes that are in scars, rows and columns.
    pub fn find(self, scan: &Scan) -> Vec<[usize; 2]> {
        let all = self.all(scan);
        if all.len() as f64 > MOST * scan.height.len() as f64 { Vec::new() } else { all }
    }

    /// The nodes of stretches that stand off the lines beside them, also where they are too many to be scars.
    pub(in crate::surface) fn all(self, scan: &Scan) -> Vec<[usize; 2]> {
        let step = if self == Self::Rows { [1, 0] } else { [0, 1] };
        // on a slope, no node is above both of its neighbours
        let scan = &*scan.without_tilt();
        let Some(off) = StandOff::new(scan, step, [1, 1], rounding(scan)).filter(|_| !scan.is_line()) else {
            return Vec::new();
        };
        let [ny, nx] = scan.shape();
        let (lines, nodes) = if self == Self::Rows { (ny, nx) } else { (nx, ny) };
        let place = |line: usize, node: usize| if self == Self::Rows { [line, node] } else { [node, line] };
        let mut found = Vec::new();
        for line in 0..lines {
            let signed = |node: usize| off.at(place(line, node)).unwrap_or(0.0) / off.scale;
            let along: Vec<f64> = (0..nodes).map(signed).collect();
            let is_same = |a: &f64, b: &f64| a.abs() > DEVIATIONS[0] && a * b > 0.0 && b.abs() > DEVIATIONS[0];
            let mut first = 0;
            for run in along.chunk_by(is_same) {
                if is_scar(run) {
                    found.extend((first..first + run.len()).map(|node| place(line, node)));
                }
                first += run.len();
            }
        }
        found
    }
}

/// Whether a run of nodes on one side of their neighbours is a scar.
fn is_scar(run: &[f64]) -> bool {
    run.len() >= SHORTEST && 2 * run.iter().filter(|it| it.abs() > DEVIATIONS[1]).count() >= run.len()
}
