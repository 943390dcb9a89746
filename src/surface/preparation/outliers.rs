//! Single heights that stand off all their neighbours.

use super::Scan;
use super::stand_off::StandOff;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// Standard deviations by which an outlier stands off the nodes on both sides of it, in all directions.
const DEVIATIONS: f64 = 6.0;
/// The same of the differences between neighbours, which a cusp has on both sides.
const SLOPES: f64 = 3.0;
/// The most nodes of an outlier along an axis.
const WIDEST: isize = 3;
/// The nodes to each side among which the scale is also found.
const REACH: usize = 5;
/// The largest share of the nodes that may be outliers: more of them are no exception.
const MOST: f64 = 0.02;
/// The most times that what was behind outliers is looked for.
const PASSES: usize = 3;

/// What becomes of heights that stand off all their neighbours, such as dead pixels and spikes.
///
/// An outlier is of at most 3 x 3 nodes. It is above the nodes on both sides of it in all directions, or below all of them, by six standard
/// deviations of such differences on the map and near the node, and by three of those of neighbours. Where more than 2 % of the nodes are so, none of them is an outlier.
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
        let (mut left, mut all) = (scan.clone(), Vec::new());
        for _ in 0..PASSES {
            let found = standing_off(&left);
            if found.is_empty() {
                break;
            }
            found.iter().for_each(|node| left.height[*node] = f64::NAN);
            all.extend(found);
        }
        if all.len() as f64 > MOST * scan.height.len() as f64 { Vec::new() } else { all }
    }
}

/// The nodes that stand off at some distance in all directions.
fn standing_off(scan: &Scan) -> Vec<[usize; 2]> {
    let directions: &[[isize; 2]] = if scan.is_line() { &[[0, 1]] } else { &[[0, 1], [1, 0], [1, 1], [1, -1]] };
    let at = |distance: isize| -> Vec<StandOff<'_>> {
        directions.iter().filter_map(|step| StandOff::new(scan, step.map(|it| distance * it))).collect()
    };
    let distances: Vec<Vec<StandOff<'_>>> = (1..=WIDEST).map(at).collect();
    let [ny, nx] = scan.shape();
    let nodes = (0..ny).flat_map(|y| (0..nx).map(move |x| [y, x]));
    nodes.filter(|node| distances.iter().any(|directions| stands_off(directions, *node))).collect()
}

/// Whether a node stands off in all directions in which there are nodes on both sides.
fn stands_off(directions: &[StandOff<'_>], node: [usize; 2]) -> bool {
    let known = || directions.iter().filter_map(|direction| Some((direction, direction.at(node)?)));
    let is_far = |sign: f64| {
        known().all(|(direction, off)| sign * off > (DEVIATIONS * direction.scale).max(SLOPES * direction.slope))
            && known().all(|(direction, off)| sign * off > DEVIATIONS * direction.scale_near(node, REACH))
    };
    known().next().is_some_and(|(_, first)| first != 0.0 && is_far(first.signum()))
}
