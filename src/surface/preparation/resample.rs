//! Heights at uneven positions, or there several times, interpolated to even spacing.

use crate::formats::Scan;
use ndarray::Axis;
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The fewest different heights along an axis, if they are repeats.
const FEWEST_RUNS: usize = 8;
/// The most times that each height is there, if they are repeats: programs enlarge by small factors, and longer runs are terraces of the surface.
const MOST_REPEATS: usize = 4;

/// How heights are interpolated to the same number of even positions over the same length: those at uneven positions, or those of which every
/// one is there several times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Resample {
    /// Linear interpolation to the same number of evenly spaced positions.
    Linear,
    /// Cubic interpolation between the middles of heights that are there several times one after the other.
    ///
    /// Files that were enlarged by taking the nearest height have such ones.
    Repeats,
}

impl Resample {
    /// How many times each height is there one after the other along an axis; 1 where most are there once.
    pub(in crate::surface) fn repeats(scan: &Scan, axis: usize) -> usize {
        let nodes = scan.shape()[axis];
        let is_same = |(one, next): (&f64, &f64)| one == next || (one.is_nan() && next.is_nan());
        let pairs = scan.height.axis_windows(Axis(axis), 2).into_iter();
        let is_equal: Vec<bool> = pairs
            .map(|pair| {
                let [one, next] = [0, 1].map(|i| pair.index_axis(Axis(axis), i));
                one.iter().zip(next.iter()).all(is_same)
            })
            .collect();
        let runs = 1 + is_equal.iter().filter(|it| !**it).count();
        let times = (nodes as f64 / runs as f64).round() as usize;
        // some of a rim or of a flat part are no repeats of all heights
        let is_even = is_equal.split(|it| !*it).all(|run| run.len() < times + 1);
        if runs >= FEWEST_RUNS && times <= MOST_REPEATS && is_even { times } else { 1 }
    }

    /// The heights of which those that are there several times along an axis are interpolated between the middles of their repeats.
    pub(in crate::surface) fn without_repeats(mut scan: Scan) -> Scan {
        for axis in [0, 1].into_iter().filter(|axis| Self::repeats(&scan, *axis) > 1).collect::<Vec<_>>() {
            let nodes = scan.shape()[axis];
            let line = |i: usize| scan.height.index_axis(Axis(axis), i);
            let is_new = |i: &usize| line(*i).iter().zip(line(i - 1)).any(|(h, before)| h != before && !h.is_nan());
            let first: Vec<usize> = [0].into_iter().chain((1..nodes).filter(is_new)).collect();
            let beyond: Vec<usize> = first[1..].iter().copied().chain([nodes]).collect();
            let middle: Vec<f64> = first.iter().zip(&beyond).map(|(a, b)| 0.5 * (a + b - 1) as f64).collect();
            for mut line in scan.height.lanes_mut(Axis(axis)) {
                let heights: Vec<f64> = first.iter().map(|i| line[*i]).collect();
                line.iter_mut().enumerate().for_each(|(i, h)| *h = cubic(&middle, &heights, i as f64));
            }
        }
        scan
    }

    /// The heights at even positions, and their spacing, of heights at ever larger positions `x`, two at least.
    pub fn apply(self, x: &[f64], height: &[f64]) -> (Vec<f64>, f64) {
        let last = x.len() - 1;
        let spacing = (x[last] - x[0]) / last as f64;
        let at = |i: usize| {
            let place = (x[0] + i as f64 * spacing).clamp(x[0], x[last]);
            let right = x.partition_point(|x| *x < place).clamp(1, last);
            let share = (place - x[right - 1]) / (x[right] - x[right - 1]);
            height[right - 1] + share * (height[right] - height[right - 1])
        };
        ((0..=last).map(at).collect(), spacing)
    }
}

/// The cubic through heights at ever larger positions at a place: the one of Catmull and Rom, with the slopes of the neighbours on both sides;
/// level beyond the first and the last one.
fn cubic(positions: &[f64], heights: &[f64], place: f64) -> f64 {
    let last = positions.len() - 1;
    let place = place.clamp(positions[0], positions[last]);
    let right = positions.partition_point(|it| *it < place).clamp(1, last);
    let left = right - 1;
    let slope = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
        (heights[after] - heights[before]) / (positions[after] - positions[before])
    };
    let width = positions[right] - positions[left];
    let t = (place - positions[left]) / width;
    let (s, one) = (1.0 - t, heights[left] * (1.0 + 2.0 * t) + slope(left) * width * t);
    one * s * s + (heights[right] * (1.0 + 2.0 * s) - slope(right) * width * s) * t * t
}
