//! Single heights that stand off all their neighbours.

use super::cluster::clusters;
use super::stand_off::{StandOff, rounding};
use crate::formats::Scan;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Standard deviations by which an outlier stands off the nodes on both sides of it, in all directions.
const DEVIATIONS: f64 = 6.0;
/// The same of the differences between neighbours, which a cusp has on both sides.
const SLOPES: f64 = 3.0;
/// The steps to the nodes before and behind: those beside one node, and beside one or the other of two.
const SIDES: [[isize; 2]; 3] = [[1, 1], [1, 2], [2, 1]];
/// The nodes to each side among which the scale is also found.
const REACH: usize = 5;
/// The largest share of the nodes that may be outliers: with more, outliers are neighbours of outliers, and what stands off is the surface.
const MOST: f64 = 0.1;
/// The most nodes of an outlier.
const LARGEST: usize = 4;
/// The most times that what was behind outliers is looked for: where a tenth of the nodes are outliers, half of them have another one as a
/// neighbour, which hides them until it is void.
const PASSES: usize = 6;

/// What becomes of heights that stand off all their neighbours, such as dead pixels and spikes.
///
/// An outlier is of at most 2 x 2 nodes, so that larger particles are kept. It is above the nodes on both sides of it in all directions, or
/// below all of them, by six standard deviations of such differences on the map and near the node, and by three of those of neighbours.
/// Where more than 10 % of the nodes are so, none of them is an outlier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Outliers {
    /// They become voids.
    ///
    /// Voids can be filled with the smoothest heights.
    Void,
}

impl Outliers {
    /// The heights without outliers.
    pub fn apply(self, mut scan: Scan) -> Scan {
        Self::find(&scan).into_iter().for_each(|node| scan.height[node] = f64::NAN);
        scan
    }

    /// The nodes that are outliers, rows and columns.
    pub fn find(scan: &Scan) -> Vec<[usize; 2]> {
        let all = Self::all(scan);
        if all.len() as f64 > MOST * scan.height.len() as f64 { Vec::new() } else { all }
    }

    /// The nodes that stand off all their neighbours, also where they are too many to be outliers.
    pub(in crate::surface) fn all(scan: &Scan) -> Vec<[usize; 2]> {
        let (mut left, mut all) = (scan.without_tilt().into_owned(), Vec::new());
        for _ in 0..PASSES {
            let found = standing_off(&left);
            if found.is_empty() {
                break;
            }
            found.iter().for_each(|node| left.height[*node] = f64::NAN);
            all.extend(found);
        }
        if !all.is_empty() {
            // an outlier beside those that are void has no neighbours left to stand off, but is above the rest of them by a cliff
            let small = clusters(&left).into_iter().filter(|nodes| nodes.len() <= LARGEST);
            all.extend(small.flatten().map(|(y, x)| [y, x]));
        }
        all
    }
}

/// The nodes that stand off in all directions.
fn standing_off(scan: &Scan) -> Vec<[usize; 2]> {
    let directions: &[[isize; 2]] = if scan.is_line() { &[[0, 1]] } else { &[[0, 1], [1, 0], [1, 1], [1, -1]] };
    let equal = rounding(scan);
    let both = |step: &[isize; 2]| SIDES.iter().filter_map(|sides| StandOff::new(scan, *step, *sides, equal)).collect();
    let directions: Vec<Vec<StandOff<'_>>> = directions.iter().map(both).collect();
    let [ny, nx] = scan.shape();
    let nodes = (0..ny).flat_map(|y| (0..nx).map(move |x| [y, x]));
    nodes.filter(|node| [1.0, -1.0].iter().any(|sign| stands_off(&directions, *node, *sign))).collect()
}

/// Whether a node stands off to one side in all directions in which there are nodes before and behind it, and there are such.
fn stands_off(directions: &[Vec<StandOff<'_>>], node: [usize; 2], sign: f64) -> bool {
    let is_far = |it: &StandOff<'_>| {
        let off = it.at(node).map(|off| sign * off).filter(|off| *off > SLOPES * it.slope);
        off.is_some_and(|off| it.is_beyond(off, DEVIATIONS, node, REACH))
    };
    let is_known = |sides: &&Vec<StandOff<'_>>| sides.iter().any(|it| it.at(node).is_some());
    let mut known = directions.iter().filter(is_known).peekable();
    known.peek().is_some() && known.all(|sides| sides.iter().any(is_far))
}
