//! Artefacts of measured heights, by their names.

use super::clip::Clip;
use super::scales::sample;
use super::waves::{Alone, WavePower};
use crate::surface::bends::{DEVIATION, median};
use crate::surface::{LineLevel, LineOffsets, Outliers, Preparation, Scan, Scars};

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

/// An artefact of measured heights. An axis, "y" or "x", is the one across the lines: rows lie across y, columns across x.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the fields are described with their variant")]
pub enum Artefact {
    /// Lines whose levels differ independently: their rms `rms`, a length, and their share `share` of the mean square gradient.
    Offsets { axis: &'static str, rms: f64, share: f64 },
    /// The same where nothing but the lines differs, so that they may be grooves.
    Grooves { axis: &'static str, rms: f64 },
    /// Single heights, `nodes` of them, that stand off all their neighbours, such as dead pixels and spikes.
    Outliers { nodes: usize },
    /// Stretches of scan lines that stand off the lines beside them, with `nodes` nodes.
    Scars { axis: &'static str, nodes: usize },
    /// A step of a height over the whole width, between line number `line`, from 0, and the next one.
    Step { axis: &'static str, line: usize, height: f64 },
    /// Lines whose levels wander, by an rms step from line to line of `rms`, a length, and with a share `share` of the mean square gradient:
    /// drift of the instrument, or a lay of the surface.
    Wander { axis: &'static str, rms: f64, share: f64 },
    /// Waves that stand alone, `count` of them, the strongest with a wavelength of `wavelength`, with an rms height `rms` and a share `share` of
    /// the mean square gradient: hum of the instrument, or a pattern of the surface.
    Waves { count: usize, wavelength: f64, rms: f64, share: f64 },
    /// Flat heights, `nodes` of them and a share `share` of all, that are the highest (`is_top`) or the lowest.
    Clipped { nodes: usize, share: f64, is_top: bool },
    /// Lines of equal heights at the rim: how many first and last rows, and first and last columns.
    Border { lines: [usize; 4] },
    /// Heights that are rounded to multiples of `step`, a length, which is `share` times the rms difference between neighbours.
    Rounded { step: f64, share: f64 },
}

/// The artefacts of some heights, and the heights without those that can be mended.
#[derive(Debug, Clone, PartialEq)]
pub struct Artefacts {
    /// The artefacts, those that can be mended first.
    pub all: Vec<Artefact>,
    /// The steps that mend them; they leave voids.
    pub steps: Preparation,
    /// The heights after these steps.
    pub rest: Scan,
}

impl Artefact {
    /// What it is, in a sentence without its end, with lengths as plain numbers.
    pub fn sentence(&self) -> String {
        self.sentence_in(&|length| format!("{length:.3e}"))
    }

    /// The sentence of the artefact without its end, in which each length stands in the words that are given for it.
    pub fn sentence_in(&self, words: &dyn Fn(f64) -> String) -> String {
        let line = |axis: &str| if axis == "y" { "row" } else { "column" };
        match *self {
            Self::Offsets { axis, rms, share } => {
                let what = match axis {
                    "y" => "the levels of rows differ from row to row by",
                    _ => "the levels of columns differ from column to column by",
                };
                format!("{what} {} rms, {:.0} % of the mean square gradient", words(rms), 100.0 * share.min(1.0))
            }
            Self::Grooves { axis, rms } => format!(
                "the levels of {0}s differ from {0} to {0} by {1} rms, and little else does: they may be grooves, and are kept",
                line(axis),
                words(rms)
            ),
            Self::Outliers { nodes: 1 } => {
                "1 single height stands off all its neighbours, as dead pixels and spikes do".into()
            }
            Self::Outliers { nodes } => {
                format!("{nodes} single heights stand off all their neighbours, as dead pixels and spikes do")
            }
            Self::Scars { axis: "y", nodes } => format!("{nodes} heights are in scars along rows"),
            Self::Scars { nodes, .. } => format!("{nodes} heights are in scars along columns"),
            Self::Step { axis, line: number, height } => format!(
                "a step of {} over the whole width is between {} {number} and the next one: of the surface, or a jump of the instrument",
                words(height),
                line(axis)
            ),
            Self::Wander { axis, rms, share } => format!(
                "the levels of {}s wander by {} rms from one to the next: a lay of the surface, or drift of the instrument, and then areas may be off by up to {:.0} %",
                line(axis),
                words(rms),
                100.0 * area_error_of(share)
            ),
            Self::Waves { count, wavelength, rms, share } => format!(
                "{} with a wavelength of {} stands out of the spectrum, {} rms: a pattern of the surface, or hum of the instrument, and then areas may be off by up to {:.0} %",
                if count == 1 { "a wave".to_owned() } else { format!("the strongest of {count} waves") },
                words(wavelength),
                words(rms),
                100.0 * area_error_of(share)
            ),
            Self::Clipped { nodes, share, is_top: true } => format!(
                "{nodes} of the highest heights ({:.1} % of all) are flat: peaks were cut off, and relative areas are too large by up to {share:.2}",
                100.0 * share
            ),
            Self::Clipped { nodes, share, .. } => {
                format!("{nodes} of the lowest heights ({:.1} % of all) are flat: valleys were cut off", 100.0 * share)
            }
            Self::Border { lines: [top, bottom, left, right] } => format!(
                "heights at the rim are equal in {top} and {bottom} rows and in {left} and {right} columns: they were not measured, and can be cropped"
            ),
            Self::Rounded { step, share } => format!(
                "the heights are rounded to multiples of {}, {share:.1} times the rms step between neighbours",
                words(step)
            ),
        }
    }

    /// Whether a step of a preparation mends it.
    pub fn can_be_mended(&self) -> bool {
        matches!(self, Self::Offsets { .. } | Self::Outliers { .. } | Self::Scars { .. })
    }

    /// The offsets of the lines across an axis, if they are independent from line to line.
    fn of_lines(scan: &Scan, axis: usize) -> Option<Self> {
        let found = LineOffsets::new(scan, axis)?;
        let slopes = [0, 1].map(|axis| scan.rms_step(axis) / scan.spacing[axis]);
        let (rms, along) = (found.white().sqrt(), rms_along(scan, axis));
        let share = 2.0 * (rms / scan.spacing[axis]).powi(2) / (slopes[0].powi(2) + slopes[1].powi(2));
        let axis = ["y", "x"][axis];
        if share.is_nan() || share < OFFSETS {
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
        let mut it = Self { all: Vec::new(), steps: Preparation::default(), rest: scan.clone() };
        it.mend_offsets();
        let outliers = Outliers::find(&it.rest).len();
        if outliers > 0 {
            it.all.push(Artefact::Outliers { nodes: outliers });
            it.steps.outliers = Some(Outliers::Void);
            it.rest = Outliers::Void.apply(it.rest);
        }
        it.mend_scars();
        let steps: Vec<Artefact> = [0, 1].into_iter().flat_map(|axis| step(&it.rest, axis)).collect();
        it.all.extend(steps);
        it.all.extend(it.waves());
        it.all.extend(Self::of_equal_heights(scan));
        it
    }

    /// Artefacts by which heights are equal. A preparation hides them, so that they are looked for in the heights of the file.
    pub fn of_equal_heights(scan: &Scan) -> Vec<Artefact> {
        let clipped = |(clip, is_top): (Option<Clip>, bool)| {
            clip.map(|Clip { nodes, share }| Artefact::Clipped { nodes, share, is_top })
        };
        let cut = Clip::both(scan).into_iter().zip([true, false]).map(clipped);
        cut.chain([border(scan), rounded(scan)]).flatten().collect()
    }

    /// Levels the lines across each axis along which their offsets are independent.
    fn mend_offsets(&mut self) {
        let found: Vec<(usize, Artefact)> =
            [0, 1].into_iter().filter_map(|axis| Some((axis, Artefact::of_lines(&self.rest, axis)?))).collect();
        for (axis, artefact) in found {
            if artefact.can_be_mended() {
                let level = if axis == 0 { &mut self.steps.level_rows } else { &mut self.steps.level_columns };
                *level = Some(LineLevel::Offsets);
                self.rest = LineLevel::Offsets.apply(self.rest.clone(), axis);
            }
            self.all.push(artefact);
        }
    }

    /// Takes scars for voids, along the axis that has more of them.
    fn mend_scars(&mut self) {
        let along = [Scars::Rows, Scars::Columns].map(|it| (it, it.find(&self.rest).len()));
        let Some((scars, nodes)) = along.into_iter().max_by_key(|(_, nodes)| *nodes).filter(|it| it.1 > 0) else {
            return;
        };
        let axis = if scars == Scars::Rows { "y" } else { "x" };
        self.all.push(Artefact::Scars { axis, nodes });
        self.steps.scars = Some(scars);
        self.rest = scars.apply(self.rest.clone());
    }

    /// Levels of lines that wander, where they are not told already, and waves that stand alone.
    fn waves(&self) -> Vec<Artefact> {
        let Some(waves) = WavePower::new(&self.rest) else { return Vec::new() };
        let wander = [(0, "y"), (1, "x")].into_iter().filter_map(|(number, name)| {
            let is_told = |it: &Artefact| {
                matches!(it, Artefact::Offsets { axis, .. } | Artefact::Grooves { axis, .. } | Artefact::Step { axis, .. } if *axis == name)
            };
            let found = waves.wander(number).filter(|_| !self.all.iter().any(is_told));
            found.map(|[rms, share]| (share, Artefact::Wander { axis: name, rms, share }))
        });
        let alone = waves
            .alone()
            .map(|Alone { count, wavelength, rms, share }| (share, Artefact::Waves { count, wavelength, rms, share }));
        wander.chain(alone).filter(|it| it.0 > TOLD).map(|it| it.1).collect()
    }

    /// The largest relative error of areas that the artefacts which can be mended may cause, by the rms gradient with and without them; 1 where
    /// they are above all the rest, so that the contact begins at them.
    pub fn area_error(&self, scan: &Scan) -> f64 {
        let highest = |it: &Scan| it.height.iter().copied().filter(|h| !h.is_nan()).fold(f64::NEG_INFINITY, f64::max);
        let (before, after) = (scan.rms_gradient(), self.rest.rms_gradient());
        match self.all.iter().any(Artefact::can_be_mended) {
            false => 0.0,
            true if highest(scan) > highest(&self.rest) => 1.0,
            true => (1.0 - after / before).abs(),
        }
    }
}

/// The relative error of areas by what makes a share of the mean square gradient.
fn area_error_of(share: f64) -> f64 {
    1.0 - (1.0 - share.min(1.0)).sqrt()
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
    let found = far.iter().filter(|_| far.len() <= MOST_STEPS);
    found.map(|line| Artefact::Step { axis: ["y", "x"][axis], line: *line, height: steps[*line] }).collect()
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
        (0..lines).take_while(|i| level(axis, if is_first { *i } else { lines - 1 - i }, Some(edge))).count()
    };
    let lines = [count(0, true), count(0, false), count(1, true), count(1, false)];
    let all = [0, 1].map(|axis| (0..scan.shape()[axis]).filter(|place| level(axis, *place, None)).count());
    let is_rim = !scan.is_line() && all != [0, 0] && all == [lines[0] + lines[1], lines[2] + lines[3]];
    is_rim.then_some(Artefact::Border { lines })
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
