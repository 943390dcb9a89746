//! Scan lines brought to one level.

use super::least_squares::linear;
use crate::formats::Scan;
use crate::surface::bends::{bends, median};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// White offsets over the bends of the offsets, at the shortest distance that counts as above the white ones.
const ABOVE_WHITE: f64 = 0.5;

/// Bends of offsets that grow more than this from one line to two are those of the surface.
const MOST_GROWTH: f64 = 1.8;

/// Correlations of the levels with themselves, below which they have fallen, and above which they repeat.
const FALLEN: f64 = 0.3;
const REPEATED: f64 = 0.75;
/// Exponentials that decay within this part of the lines are looked for: a polynomial takes longer ones.
const LONGEST_DECAY: f64 = 0.2;
/// The factor between decay lengths that are tried.
const DECAY_STEP: f64 = 1.25;
/// The largest part of the mean square of the levels about their polynomial of third order that an exponential leaves. The levels of 150 random maps
/// left 0.12 to 1, half of them more than 0.76.
const LEFT_BY_SETTLING: f64 = 0.1;

/// What is subtracted from each scan line of a map, so that all of them are on one level. A profile has one scan line, which stays.
///
/// The offset of a line is the sum of the medians of the differences between neighbouring lines up to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum LineLevel {
    /// The part of the offsets that is independent from line to line.
    ///
    /// Waves of the surface across the lines are kept, as they differ little between neighbouring lines.
    Offsets,
    /// The whole offset of each line, by the medians of differences.
    ///
    /// Waves whose crests lie along the lines are subtracted as well.
    Median,
    /// The exponential by which the levels of the lines settle after the scan began.
    ///
    /// Creep of a scanner and warming make it; see [`LineOffsets::settling`].
    Settling,
    /// The straight line of least squares through each scan line.
    Line,
    /// The parabola of least squares through each scan line.
    Parabola,
}

/// Levels of scan lines that settle exponentially.
#[derive(Debug, Clone, PartialEq)]
pub struct Settling {
    /// How far the first line, or the last one, is off: the height of the exponential, a length.
    pub height: f64,
    /// The number of lines in which it falls to `1/e`.
    pub decay: f64,
    /// The exponential at each line.
    pub levels: Vec<f64>,
}

/// The offsets of the scan lines of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct LineOffsets {
    /// The offset of each line.
    pub offsets: Vec<f64>,
    /// The mean squares of their bends at one, two, four, ... lines.
    bends: Vec<f64>,
}

impl LineOffsets {
    /// The offsets of the lines of a map across an axis, 0 for rows and 1 for columns; none for less than 16 lines or a profile.
    pub fn new(scan: &Scan, axis: usize) -> Option<Self> {
        let lines = scan.shape()[axis];
        if scan.is_line() || lines < 16 {
            return None;
        }
        let mut level = 0.0;
        let mut offsets = vec![0.0; lines];
        for (place, offset) in offsets.iter_mut().enumerate().skip(1) {
            let (one, next) = (line(scan, axis, place - 1), line(scan, axis, place));
            let mut steps: Vec<f64> = next.iter().zip(&one).map(|(a, b)| a - b).filter(|it| !it.is_nan()).collect();
            level += median(&mut steps).unwrap_or(0.0);
            *offset = level;
        }
        Some(Self { bends: bends(&offsets), offsets })
    }

    /// The mean square of the offsets that are independent from line to line; 0 if they are not independent.
    ///
    /// Bends of independent offsets are as large over two lines as over one. Those of the medians of a rough surface grow twice, or more.
    pub fn white(&self) -> f64 {
        let [one, two] = [self.bends[0], self.bends[1]];
        if two < MOST_GROWTH * one { one / 6.0 } else { 0.0 }
    }

    /// Whether the levels repeat after some lines, as those of a turned surface or a blazed grating do.
    ///
    /// Their correlation with themselves falls below `FALLEN` and rises to `REPEATED` again after up to half of the lines. That of drift, a random
    /// walk, falls and stays low.
    pub fn repeat(&self) -> bool {
        let lines = self.offsets.len();
        let mut has_fallen = false;
        for lag in 2..=lines / 2 {
            let correlation = correlation(&self.offsets[lag..], &self.offsets[..lines - lag]);
            has_fallen |= correlation < FALLEN;
            if has_fallen && correlation > REPEATED {
                return true;
            }
        }
        false
    }

    /// The exponential `d exp(-i / decay)`, from the first line or the last one on, that explains the levels beside a polynomial of third order; none where it
    /// leaves more than a tenth of their mean square.
    pub fn settling(&self) -> Option<Settling> {
        let lines = self.offsets.len();
        let place = |i: usize| 2.0 * i as f64 / (lines - 1) as f64 - 1.0;
        let fit = |levels: &[f64]| {
            let terms = |i: usize| [1.0, place(i), place(i).powi(2), place(i).powi(3), levels[i]];
            let factors = linear((0..lines).map(|i| (terms(i), self.offsets[i])));
            let sum = |i: usize| terms(i).iter().zip(factors).map(|(term, factor)| term * factor).sum::<f64>();
            ((0..lines).map(|i| (self.offsets[i] - sum(i)).powi(2)).sum::<f64>(), factors[4])
        };
        let (before, _) = fit(&vec![0.0; lines]);
        let (mut best, mut least) = (None, LEFT_BY_SETTLING * before);
        let mut decay = 1.0;
        while decay < LONGEST_DECAY * lines as f64 {
            let falling: Vec<f64> = (0..lines).map(|i| (-(i as f64) / decay).exp()).collect();
            let rising: Vec<f64> = falling.iter().rev().copied().collect();
            for levels in [falling, rising] {
                let (left, height) = fit(&levels);
                if left < least {
                    least = left;
                    let levels = levels.iter().map(|it| height * it).collect();
                    best = Some(Settling { height, decay, levels });
                }
            }
            decay *= DECAY_STEP;
        }
        best
    }

    /// The part that is independent from line to line: the offsets without their waves that are longer than the distance at which white
    /// offsets make half of the bends.
    pub fn independent(&self) -> Vec<f64> {
        let white = self.white();
        if white == 0.0 {
            return vec![0.0; self.offsets.len()];
        }
        let above = self.bends.iter().position(|it| 6.0 * white <= ABOVE_WHITE * it).unwrap_or(self.bends.len() - 1);
        let height = ndarray::Array2::from_shape_fn((1, self.offsets.len()), |(_, i)| self.offsets[i]);
        let short = Scan { height, spacing: [1.0; 2] }.high_pass(2f64.powi(above as i32 + 1));
        short.height.iter().copied().collect()
    }
}

impl LineLevel {
    /// The heights without the level of each line across an axis, 0 for rows and 1 for columns.
    pub fn apply(self, mut scan: Scan, axis: usize) -> Scan {
        let level = if self == Self::Median { Cow::Borrowed(&scan) } else { scan.without_tilt() };
        let offsets = LineOffsets::new(&level, axis);
        match (self, offsets) {
            (_, None) => scan,
            (Self::Offsets, Some(found)) => less(scan, axis, &found.independent()),
            (Self::Median, Some(found)) => less(scan, axis, &found.offsets),
            (Self::Settling, Some(found)) => match found.settling() {
                Some(settling) => less(scan, axis, &settling.levels),
                None => scan,
            },
            (Self::Line | Self::Parabola, Some(_)) => {
                let order = if self == Self::Line { 1 } else { 2 };
                let lines = scan.height.axis_iter_mut(ndarray::Axis(axis));
                lines.for_each(|line| subtract_polynomial(line, order));
                scan
            }
        }
    }
}

/// Pearson's correlation of two sequences; 0 where one is constant.
fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let count = one.len() as f64;
    let means = [one, other].map(|it| it.iter().sum::<f64>() / count);
    let mut sums = [0.0; 3];
    for (a, b) in one.iter().zip(other) {
        let (a, b) = (a - means[0], b - means[1]);
        sums = [sums[0] + a * a, sums[1] + b * b, sums[2] + a * b];
    }
    let scale = (sums[0] * sums[1]).sqrt();
    if scale > 0.0 { sums[2] / scale } else { 0.0 }
}

/// The heights along a line across an axis.
fn line(scan: &Scan, axis: usize, place: usize) -> ndarray::ArrayView1<'_, f64> {
    scan.height.index_axis(ndarray::Axis(axis), place)
}

/// The heights less an offset of each line, whose mean is kept.
fn less(mut scan: Scan, axis: usize, offsets: &[f64]) -> Scan {
    let mean = offsets.iter().sum::<f64>() / offsets.len() as f64;
    for (mut line, offset) in scan.height.axis_iter_mut(ndarray::Axis(axis)).zip(offsets) {
        line.mapv_inplace(|h| h - (offset - mean));
    }
    scan
}

/// Subtracts the polynomial of least squares through the heights of a line that are there.
fn subtract_polynomial(mut line: ndarray::ArrayViewMut1<'_, f64>, order: usize) {
    let half = 0.5 * (line.len() as f64 - 1.0);
    let terms = |i: usize| {
        let x = (i as f64 - half) / half.max(1.0);
        [1.0, x, if order > 1 { x * x - 1.0 / 3.0 } else { 0.0 }]
    };
    let there = line.iter().enumerate().filter(|(_, h)| !h.is_nan());
    let factors = linear(there.map(|(i, h)| (terms(i), *h)));
    line.iter_mut().enumerate().for_each(|(i, h)| {
        *h -= terms(i).iter().zip(factors).map(|(term, factor)| term * factor).sum::<f64>();
    });
}
