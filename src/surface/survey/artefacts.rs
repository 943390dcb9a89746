//! The artefacts that are found in measured heights, and what mends them.

use super::Artefact;
use super::clip::Clip;
use super::interpolated::interpolated;
use super::jump::jump_of_parts;
use super::scales::sample;
use super::shift::LineShift;
use super::waves::{Alone, WavePower};
use crate::formats::Scan;
use crate::surface::bends::{DEVIATION, median};
use crate::surface::preparation::clusters;
use crate::surface::{Fill, LineLevel, LineOffsets, Outliers, Preparation, Resample, Scars};
use std::borrow::Cow;

/// Offsets of lines are an artefact where those that are independent make this share of the mean square gradient.
const OFFSETS: f64 = 0.01;
/// Offsets that are larger than the heights along the lines by this factor may be grooves of the surface.
const GROOVES: f64 = 5.0;
/// A step between lines is larger than the usual one by this many standard deviations, and stands alone or nearly so.
const STEP: f64 = 12.0;
const MOST_STEPS: usize = 2;
/// The share of the mean square gradient from which on waves that stand alone, and levels that wander, are told.
const TOLD: f64 = 0.02;
/// Rounded heights are told of where the mean square of rounding makes this share of that of the steps.
const ROUNDED: f64 = 0.05;

/// The largest share of the heights that is told as scars: more of them are the surface.
const MOST_SCARS: f64 = 0.3;
/// Levels settle where their exponential is higher than this many rms heights along the lines.
const SETTLING: f64 = 2.0;
/// Heights that stand off are alike where most of them, `MOST_ALIKE`, are within this part of their median; spikes and dead pixels differ by more.
const ALIKE: f64 = 0.25;
const MOST_ALIKE: f64 = 0.7;
/// The fewest heights that are alike by more than chance.
const FEWEST_ALIKE: usize = 40;
/// The part of a line that is mended, if it is a wire and not a scar.
const WIRE: f64 = 0.5;
/// The least effect on areas of heights that are mended as single ones or scars: with less they stay. A worn or pitted surface has a few nodes that
/// stand off all others, which no contact notices.
const LEAST_EFFECT: f64 = 0.02;
/// The part of the rms difference from a level line at the rim to the second line that the first one has at most, if the surface opens from there: a
/// sine at its zero has a half, and rough heights beside a line that was not measured have about 1.
const OPENS: f64 = 0.75;
/// The least share of the mean square gradient that is told as left of scars and offsets.
const LEAST_LEFT: f64 = 0.05;
/// Offsets of lines are those of all lines where the usual one, by the median, is at least this part of their root mean square. That of normally
/// distributed ones is 1; wires and grooves leave most lines without an offset.
const OF_ALL_LINES: f64 = 0.5;

/// The artefacts of some heights, and the heights without those that can be mended.
#[derive(Debug, Clone, PartialEq)]
pub struct Artefacts {
    /// The artefacts, those that can be mended first.
    pub all: Vec<Artefact>,
    /// The steps that mend them; they leave voids.
    pub steps: Preparation,
    /// The heights after these steps.
    pub rest: Scan,
    /// The largest relative error of areas that the artefacts which can be mended may cause, by the rms gradient with and without them; 1 where
    /// they are above all the rest, so that the contact begins at them.
    pub area_error: f64,
}

impl Artefact {
    /// The offsets of the lines across an axis, if they are independent from line to line.
    fn of_lines(scan: &Scan, axis: usize) -> Option<Self> {
        let found = LineOffsets::new(scan, axis)?;
        let slopes = [0, 1].map(|axis| scan.rms_step(axis) / scan.spacing[axis]);
        let (rms, along) = (found.white().sqrt(), rms_along(scan, axis));
        let share = 2.0 * (rms / scan.spacing[axis]).powi(2) / (slopes[0].powi(2) + slopes[1].powi(2));
        let axis = ["y", "x"][axis];
        if share.is_nan() || share < OFFSETS || !are_of_all_lines(&found) {
            None
        } else if rms > GROOVES * along {
            // where heights hardly differ along the lines, these are the surface
            Some(Self::Grooves { axis, rms })
        } else {
            Some(Self::Offsets { axis, rms, share })
        }
    }
}

impl Artefacts {
    /// Relative errors of areas below this one are not told.
    pub const TOLD: f64 = 0.01;

    /// The artefacts of some heights, some of which may be void.
    pub fn new(scan: &Scan) -> Self {
        // beside the slope of a tilted map, everything else is small, so that artefacts are looked for without it
        let level = scan.without_tilt();
        let mut it = Self::mended(&level);
        it.tell_of_rest();
        it.all.extend(Self::of_equal_heights(if it.steps.resample.is_some() { &it.rest } else { scan }));
        if let (Cow::Owned(_), Ok(prepared)) = (&level, it.steps.apply(scan.clone())) {
            it.rest = prepared.scan;
        }
        it
    }

    /// The artefacts of heights without a tilt that can be mended, and how.
    fn mended(scan: &Scan) -> Self {
        let mut it = Self { all: Vec::new(), steps: Preparation::default(), rest: scan.clone(), area_error: 0.0 };
        it.mend_repeats();
        it.mend_settling();
        it.mend_offsets();
        let before = it.rest.clone();
        it.mend_outliers();
        it.all.extend(alike(&before, &it.rest, false));
        let before = it.rest.clone();
        it.mend_scars();
        it.all.extend(alike(&before, &it.rest, true));
        if it.all.iter().any(Artefact::can_be_mended) {
            it.area_error = effect(scan, &it.rest);
        }
        it
    }

    /// Adds the artefacts of what is left that no step mends.
    fn tell_of_rest(&mut self) {
        let left: Vec<Artefact> = [0, 1].into_iter().filter_map(|axis| self.left_across(axis)).collect();
        self.all.extend(left);
        let found = clusters(&self.rest);
        if !found.is_empty() {
            self.all.push(Artefact::Clusters { count: found.len(), nodes: found.iter().map(Vec::len).sum() });
        }
        self.all.extend(jump_of_parts(&self.rest).map(|height| Artefact::RaisedParts { height }));
        self.all.extend([0, 1].into_iter().filter_map(|axis| {
            let LineShift { nodes, share } = LineShift::new(&self.rest, axis)?;
            Some(Artefact::Shifted { axis: ["y", "x"][axis], nodes, share })
        }));
        if self.steps.resample.is_none() {
            self.all.extend([0, 1].into_iter().filter_map(|axis| {
                let times = interpolated(&self.rest, axis)?;
                Some(Artefact::Interpolated { axis: ["y", "x"][axis], times })
            }));
        }
        let steps: Vec<Artefact> = [0, 1].into_iter().flat_map(|axis| step(&self.rest, axis)).collect();
        self.all.extend(steps);
        self.all.extend(self.waves());
    }

    /// Artefacts by which heights are equal. A preparation hides them, so that they are looked for in the heights of the file.
    pub fn of_equal_heights(scan: &Scan) -> Vec<Artefact> {
        let clipped = |(clip, is_top): (Option<Clip>, bool)| {
            clip.map(|Clip { nodes, share }| Artefact::Clipped { nodes, share, is_top })
        };
        let cut = Clip::both(scan).into_iter().zip([true, false]).map(clipped);
        cut.chain([border(scan), rounded(scan)]).flatten().collect()
    }

    /// Interpolates heights that are there several times.
    fn mend_repeats(&mut self) {
        let times = [0, 1].map(|axis| Resample::repeats(&self.rest, axis));
        for axis in (0..2).filter(|axis| times[*axis] > 1) {
            self.all.push(Artefact::Repeated { axis: ["y", "x"][axis], times: times[axis] });
            self.steps.resample = Some(Resample::Repeats);
        }
        if self.steps.resample.is_some() {
            self.rest = Resample::without_repeats(self.rest.clone());
        }
    }

    /// Takes off the exponentials by which the levels of lines settle, if they are larger than the roughness along the lines. A profile is left alone: half a
    /// wave of it looks the same.
    fn mend_settling(&mut self) {
        for axis in [0, 1] {
            let Some(found) = LineOffsets::new(&self.rest, axis).and_then(|it| it.settling()) else { continue };
            if found.height.abs() < SETTLING * rms_along(&self.rest, axis) {
                continue;
            }
            self.all.push(Artefact::Settling {
                axis: ["y", "x"][axis],
                height: found.height.abs(),
                lines: found.decay,
            });
            *self.level(axis) = Some(LineLevel::Settling);
            self.rest = LineLevel::Settling.apply(self.rest.clone(), axis);
        }
    }

    /// The step that levels the lines across an axis.
    fn level(&mut self, axis: usize) -> &mut Option<LineLevel> {
        if axis == 0 { &mut self.steps.level_rows } else { &mut self.steps.level_columns }
    }

    /// Takes single heights that stand off for voids, unless they are too many.
    fn mend_outliers(&mut self) {
        let nodes = Outliers::find(&self.rest).len();
        if nodes > 0 {
            let rest = Outliers::Void.apply(self.rest.clone());
            if effect(&self.rest, &rest) >= LEAST_EFFECT {
                self.all.push(Artefact::Outliers { nodes });
                self.steps.outliers = Some(Outliers::Void);
                self.rest = rest;
            }
            return;
        }
        let share = Outliers::all(&self.rest).len() as f64 / self.rest.height.len() as f64;
        if share > 0.0 {
            self.all.push(Artefact::ManyOutliers { share });
        }
    }

    /// Levels the lines across each axis along which their offsets are independent.
    fn mend_offsets(&mut self) {
        let found: Vec<(usize, Artefact)> =
            [0, 1].into_iter().filter_map(|axis| Some((axis, Artefact::of_lines(&self.rest, axis)?))).collect();
        for (axis, artefact) in found {
            match artefact {
                // one step levels the lines across an axis, and it is taken: the offsets stay, and are told as levels that wander
                Artefact::Offsets { axis: name, rms, share } if self.level(axis).is_some() => {
                    self.all.push(Artefact::Wander { axis: name, rms, share });
                    continue;
                }
                Artefact::Offsets { .. } => {
                    *self.level(axis) = Some(LineLevel::Offsets);
                    self.rest = LineLevel::Offsets.apply(self.rest.clone(), axis);
                }
                _ => {}
            }
            self.all.push(artefact);
        }
    }

    /// Takes scars for voids, along the axis that has more of them, unless they are too many.
    fn mend_scars(&mut self) {
        let along = [Scars::Rows, Scars::Columns].map(|it| (it, it.all(&self.rest).len()));
        let (scars, all) = if along[0].1 >= along[1].1 { along[0] } else { along[1] };
        // ridges that come back after some lines are those of a grating, or turned
        if all == 0
            || LineOffsets::new(&self.rest, if scars == Scars::Rows { 0 } else { 1 }).is_some_and(|it| it.repeat())
        {
            return;
        }
        let nodes = scars.find(&self.rest).len();
        let axis = if scars == Scars::Rows { "y" } else { "x" };
        let share = all as f64 / self.rest.height.len() as f64;
        if nodes > 0 {
            let rest = scars.apply(self.rest.clone());
            if effect(&self.rest, &rest) >= LEAST_EFFECT {
                self.all.push(Artefact::Scars { axis, nodes });
                self.steps.scars = Some(scars);
                self.rest = rest;
            }
        } else if share < MOST_SCARS {
            self.all.push(Artefact::ManyScars { axis, share });
        }
    }

    /// What is left of offsets and scars across an axis, if some were found: by how much more heights differ across the lines than along them.
    fn left_across(&self, number: usize) -> Option<Artefact> {
        let name = ["y", "x"][number];
        let is_of_lines = |it: &Artefact| match it {
            Artefact::Offsets { axis, .. } | Artefact::Scars { axis, .. } | Artefact::ManyScars { axis, .. } => {
                *axis == name
            }
            _ => false,
        };
        let slopes = [0, 1].map(|axis| (self.rest.rms_step(axis) / self.rest.spacing[axis]).powi(2));
        let share = (slopes[number] - slopes[1 - number]) / (slopes[0] + slopes[1]);
        let is_told = share > LEAST_LEFT && self.all.iter().any(is_of_lines);
        is_told.then_some(Artefact::LeftAcross { axis: name, share })
    }

    /// Levels of lines that wander, where they are not told already, and waves that stand alone.
    fn waves(&self) -> Vec<Artefact> {
        let Some(waves) = WavePower::new(&self.rest) else { return Vec::new() };
        // the harmonics of a turned surface or a grating are waves that stand alone, and its levels wander
        let repeats = [0, 1].map(|axis| LineOffsets::new(&self.rest, axis).is_some_and(|it| it.repeat()));
        let wander = [(0, "y"), (1, "x")].into_iter().filter_map(|(number, name)| {
            let is_told = |it: &Artefact| {
                matches!(it, Artefact::Offsets { axis, .. } | Artefact::Grooves { axis, .. } | Artefact::Step { axis, .. } if *axis == name)
            };
            let found = waves.wander(number).filter(|_| !self.all.iter().any(is_told) && !repeats[number]);
            found.map(|[rms, share]| (share, Artefact::Wander { axis: name, rms, share }))
        });
        let alone = waves
            .alone(repeats)
            .map(|Alone { count, wavelength, rms, share }| (share, Artefact::Waves { count, wavelength, rms, share }));
        wander.chain(alone).filter(|it| it.0 > TOLD).map(|it| it.1).collect()
    }
}

/// The largest relative difference of areas between heights and what mending leaves of them, see [`Artefacts`].
fn effect(scan: &Scan, rest: &Scan) -> f64 {
    let highest = |it: &Scan| it.height.iter().copied().filter(|h| !h.is_nan()).fold(f64::NEG_INFINITY, f64::max);
    let (before, after) = (scan.rms_gradient(), rest.rms_gradient());
    if highest(scan) > highest(rest) { 1.0 } else { (1.0 - after / before).abs() }
}

/// Whether the offsets are those of all lines, and not of a few that stand off.
fn are_of_all_lines(found: &LineOffsets) -> bool {
    let offsets = found.independent();
    let rms = (offsets.iter().map(|it| it * it).sum::<f64>() / offsets.len() as f64).sqrt();
    let mut magnitudes: Vec<f64> = offsets.iter().map(|it| it.abs()).collect();
    DEVIATION * median(&mut magnitudes).unwrap_or(0.0) >= OF_ALL_LINES * rms
}

/// The root mean square of the heights about the mean of their line, of the lines across an axis.
fn rms_along(scan: &Scan, axis: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0usize);
    for line in scan.height.axis_iter(ndarray::Axis(axis)) {
        let there: Vec<f64> = line.iter().copied().filter(|h| !h.is_nan()).collect();
        let mean = there.iter().sum::<f64>() / there.len().max(1) as f64;
        sum += there.iter().map(|h| (h - mean).powi(2)).sum::<f64>();
        count += there.len();
    }
    (sum / count.max(1) as f64).sqrt()
}

/// Single large steps between neighbouring lines across an axis.
fn step(scan: &Scan, axis: usize) -> Vec<Artefact> {
    let Some(LineOffsets { offsets, .. }) = LineOffsets::new(scan, axis) else { return Vec::new() };
    let steps: Vec<f64> = offsets.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut magnitudes: Vec<f64> = steps.iter().map(|it| it.abs()).collect();
    let usual = DEVIATION * median(&mut magnitudes).unwrap_or(0.0);
    let least = STEP * usual.max(0.1 * scan.rms_step(axis));
    let far: Vec<usize> = (0..steps.len()).filter(|i| steps[*i].abs() > least).collect();
    if far.len() > MOST_STEPS {
        return Vec::new();
    }
    let slopes = [0, 1].map(|axis| (scan.rms_step(axis) / scan.spacing[axis]).powi(2));
    let of_step = |height: f64| {
        let share = (height / scan.spacing[axis]).powi(2) / steps.len() as f64 / (slopes[0] + slopes[1]);
        (height, share)
    };
    let found = far.into_iter().map(|line| (line, of_step(steps[line])));
    found.map(|(line, (height, share))| Artefact::Step { axis: ["y", "x"][axis], line, height, share }).collect()
}

/// Lines of equal heights at the rim, unless lines inside are level as well.
fn border(scan: &Scan) -> Option<Artefact> {
    let edge = scan.height.first().copied()?;
    let level = |axis: usize, place: usize, value: Option<f64>| {
        let line = scan.height.index_axis(ndarray::Axis(axis), place);
        let value = value.or(line.first().copied());
        line.iter().all(|h| Some(*h) == value || h.is_nan())
    };
    let count = |axis: usize, is_first: bool| {
        let lines = scan.shape()[axis];
        let count =
            (0..lines).take_while(|i| level(axis, if is_first { *i } else { lines - 1 - i }, Some(edge))).count();
        if count == 1 && opens_from(scan, axis, is_first) { 0 } else { count }
    };
    let lines = [count(0, true), count(0, false), count(1, true), count(1, false)];
    let all = [0, 1].map(|axis| (0..scan.shape()[axis]).filter(|place| level(axis, *place, None)).count());
    let is_rim = !scan.is_line() && all != [0, 0] && all == [lines[0] + lines[1], lines[2] + lines[3]];
    is_rim.then_some(Artefact::Border { lines })
}

/// Whether the surface opens from its first or last line across an axis, so that the level there is one of the surface, as that of a sine at its zero:
/// the next line differs less from it than the one behind.
fn opens_from(scan: &Scan, axis: usize, is_first: bool) -> bool {
    let lines = scan.shape()[axis];
    let line = |i: usize| scan.height.index_axis(ndarray::Axis(axis), if is_first { i } else { lines - 1 - i });
    let square = |i: usize| -> f64 {
        let off = &line(i) - &line(0);
        off.iter().filter(|it| !it.is_nan()).map(|it| it * it).sum()
    };
    lines > 2 && square(1) < OPENS * OPENS * square(2)
}

/// Heights that are multiples of a step, where these are few.
fn rounded(scan: &Scan) -> Option<Artefact> {
    let mut heights = sample(scan);
    let count = heights.len();
    heights.dedup();
    let gaps: Vec<f64> = heights.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let step = gaps.iter().copied().fold(f64::INFINITY, f64::min);
    let is_multiple = |gap: &f64| ((gap / step).round() * step - gap).abs() < 1e-3 * step;
    let usual = scan.axes().map(|axis| scan.rms_step(axis).powi(2)).sum::<f64>().sqrt();
    let is_rounded = heights.len() > 2 && 4 * heights.len() < count && gaps.iter().all(is_multiple);
    let share = step / usual;
    (is_rounded && share * share / 6.0 > ROUNDED).then_some(Artefact::Rounded { step, share })
}

/// The heights that are void in one scan and not in another one, if most of them stand above the smooth heights there by the same; of scars,
/// those in lines most of which is mended.
fn alike(before: &Scan, after: &Scan, are_scars: bool) -> Option<Artefact> {
    if after.voids() <= before.voids() {
        return None;
    }
    let is_mended = ndarray::Zip::from(&before.height).and(&after.height).map_collect(|a, b| b.is_nan() && !a.is_nan());
    let long = |axis: usize| -> Vec<bool> {
        let lines = is_mended.axis_iter(ndarray::Axis(axis));
        lines.map(|line| line.iter().filter(|it| **it).count() as f64 > WIRE * line.len() as f64).collect()
    };
    let [rows, columns] = [0, 1].map(long);
    let is_counted = |(y, x): (usize, usize)| is_mended[(y, x)] && (!are_scars || rows[y] || columns[x]);
    let full = Fill::Harmonic.apply(after.clone())?;
    let places = before.height.indexed_iter().zip(&full.height).filter(|((place, _), _)| is_counted(*place));
    let mut off: Vec<f64> = places.map(|((_, before), smooth)| before - smooth).collect();
    let middle = median(&mut off)?;
    let is_alike = |it: &&f64| (**it - middle).abs() < ALIKE * middle;
    let nodes = off.iter().filter(is_alike).count();
    let share = 1.0 - (full.rms_gradient() / before.rms_gradient()).powi(2);
    (off.len() >= FEWEST_ALIKE && middle > 0.0 && nodes as f64 > MOST_ALIKE * off.len() as f64)
        .then_some(Artefact::AlikeMended { nodes, share })
}
