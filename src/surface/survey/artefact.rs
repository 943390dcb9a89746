//! Artefacts of measured heights, by their names.

use crate::sentence::{LengthValue, Sentence, sentence};

/// The error of areas of heights each of which is there twice, with which waves shorter than two of them are not known: of 51 maps and profiles, the
/// largest was 0.16. Of 35 maps with three, four and five of each it was up to 0.42, 0.43 and 0.56 of the areas that are found: times the number of
/// times less one to the power of 1.5, it is 0.42, 0.78 and 1.
const OFF_BY_REPEATS: f64 = 0.15;
/// The error of areas over the part of the rms gradient that a shift of every second line makes: of three maps, the largest was 1. The rest is room.
const SHIFT_OVER_GRADIENT: f64 = 1.5;

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
    /// A step of a height over the whole width, between line number `line`, from 0, and the next one, and its share `share` of the mean square gradient.
    Step { axis: &'static str, line: usize, height: f64, share: f64 },
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
    /// Heights each of which is there `times` times one after the other along an axis.
    Repeated { axis: &'static str, times: usize },
    /// Heights of which only every `times`-th one along an axis was measured: those between are linear interpolations.
    Interpolated { axis: &'static str, times: usize },
    /// Levels of lines that settle exponentially: by `height`, a length, within `lines` lines.
    Settling { axis: &'static str, height: f64, lines: f64 },
    /// Single heights that stand off all their neighbours, a share `share` of all, which are too many to be mended.
    ManyOutliers { share: f64 },
    /// Stretches of lines across an axis that stand off the lines beside them, a share `share` of all heights, which are too many to be mended.
    ManyScars { axis: &'static str, share: f64 },
    /// Clusters of a few heights, `count` of them with `nodes` nodes, that stand above those around them by a cliff.
    Clusters { count: usize, nodes: usize },
    /// Parts of a map that are higher than the rest by `height`, a length, behind irregular edges.
    RaisedParts { height: f64 },
    /// Every second line shifted along the lines by `nodes` nodes, which makes a share `share` of the rms gradient.
    Shifted { axis: &'static str, nodes: usize, share: f64 },
    /// Heights that were mended as single ones or scars, `nodes` of them, but may be pillars and wires of the surface: their heights are alike. They
    /// make a share `share` of the mean square gradient.
    AlikeMended { nodes: usize, share: f64 },
    /// Heights that still differ more across the lines than along them after offsets or scars of these lines were mended: what is left of those may
    /// make a share `share` of the mean square gradient.
    LeftAcross { axis: &'static str, share: f64 },
    /// Heights that are rounded to multiples of `step`, a length, which is `share` times the rms difference between neighbours.
    Rounded { step: f64, share: f64 },
}

impl Artefact {
    /// What it is, in a sentence without its end.
    pub fn sentence(&self) -> Sentence {
        match *self {
            Self::Offsets { axis, rms, share } => {
                let percent = 100.0 * share.min(1.0);
                sentence!(
                    "the levels of {lines} differ from {line} to {line} by {rms:.3e} rms, {percent:.0} % of the mean square gradient",
                    lines = lines_of(axis),
                    line = line_of(axis),
                    rms = LengthValue(rms),
                    percent
                )
            }
            Self::Grooves { axis, rms } => sentence!(
                "the levels of {lines} differ from {line} to {line} by {rms:.3e} rms, and little else does: they may be grooves, and are kept",
                lines = lines_of(axis),
                line = line_of(axis),
                rms = LengthValue(rms)
            ),
            Self::Outliers { nodes: 1 } => {
                "1 single height stands off all its neighbours, as dead pixels and spikes do".into()
            }
            Self::Outliers { nodes } => {
                sentence!("{nodes} single heights stand off all their neighbours, as dead pixels and spikes do", nodes)
            }
            Self::Scars { axis: "y", nodes } => sentence!("{nodes} heights are in scars along rows", nodes),
            Self::Scars { nodes, .. } => sentence!("{nodes} heights are in scars along columns", nodes),
            Self::Step { axis, line: number, height, share } => sentence!(
                "a step of {height:.3e} over the whole width is between {line} {number} and the next one: of the surface, or a jump of the instrument, and then \
                 areas may be off by up to {error:.0} %",
                height = LengthValue(height),
                line = line_of(axis),
                number,
                error = 100.0 * area_error_of(share)
            ),
            Self::Wander { axis, rms, share } => sentence!(
                "the levels of {lines} wander by {rms:.3e} rms from one to the next: a lay of the surface, or drift of the instrument, and then areas may be off by up to {error:.0} %",
                lines = lines_of(axis),
                rms = LengthValue(rms),
                error = 100.0 * area_error_of(share)
            ),
            Self::Waves { count, wavelength, rms, share } => sentence!(
                "{waves} with a wavelength of {wavelength:.3e} stands out of the spectrum, {rms:.3e} rms: a pattern of the surface, or hum of the instrument, and then areas may be off by up to {error:.0} %",
                waves = waves_in_words(count),
                wavelength = LengthValue(wavelength),
                rms = LengthValue(rms),
                error = 100.0 * area_error_of(share)
            ),
            _ => self.sentence_of_heights(),
        }
    }

    /// The sentence of an artefact by the range and the resolution of the instrument.
    fn sentence_of_heights(&self) -> Sentence {
        match *self {
            Self::Clipped { nodes, share, is_top: true } => sentence!(
                "{nodes} of the highest heights ({percent:.1} % of all) are flat: peaks were worn, or cut off by the instrument, and then relative areas are too large by up to {share:.2}",
                nodes,
                percent = 100.0 * share,
                share
            ),
            Self::Clipped { nodes, share, .. } => {
                sentence!(
                    "{nodes} of the lowest heights ({percent:.1} % of all) are flat: valleys were cut off",
                    nodes,
                    percent = 100.0 * share
                )
            }
            Self::Border { lines: [top, bottom, left, right] } => sentence!(
                "heights at the rim are equal in {top} and {bottom} rows and in {left} and {right} columns: they were not measured, and can be cropped",
                top,
                bottom,
                left,
                right
            ),
            Self::Rounded { step, share } => sentence!(
                "the heights are rounded to multiples of {step:.3e}, {share:.1} times the rms step between neighbours",
                step = LengthValue(step),
                share
            ),
            _ => self.sentence_of_scan(),
        }
    }

    /// The sentence of an artefact by the way in which the instrument or a program puts heights together.
    fn sentence_of_scan(&self) -> Sentence {
        match *self {
            Self::Repeated { axis, times } => sentence!(
                "every height is there {times} times along {axis}, so the file has fewer heights than nodes, and areas may be off by up to {error:.0} %",
                times,
                axis,
                error = 100.0 * error_of_repeats(times)
            ),
            Self::Interpolated { axis, times } => sentence!(
                "{count} of {times} heights along {axis} are linear interpolations, so the file has fewer heights than nodes, and areas may be off by up to \
                 {error:.0} %",
                count = times - 1,
                times,
                axis,
                error = 100.0 * error_of_repeats(times)
            ),
            Self::Settling { axis, height, lines } => sentence!(
                "the levels of {lines} settle by {height:.3e} within {count:.0} {lines}, as scanners creep",
                lines = lines_of(axis),
                height = LengthValue(height),
                count = lines
            ),
            Self::ManyOutliers { share } => sentence!(
                "{share:.0} % of single heights stand off: too many to be mended, and areas may be off by up to 100 %",
                share = 100.0 * share
            ),
            Self::ManyScars { axis, share } => sentence!(
                "{share:.0} % of the heights are in scars along {lines}: too many to be mended, and areas may be off by up to 100 %",
                lines = lines_of(axis),
                share = 100.0 * share
            ),
            Self::Clusters { count, nodes } => sentence!(
                "{nodes} heights in {clusters} of up to 5 x 5 nodes stand above those around them by a cliff: particles of the surface, \
                 or artefacts, and then areas may be off by up to 100 %",
                nodes,
                clusters = clusters_in_words(count)
            ),
            Self::RaisedParts { height } => sentence!(
                "parts are higher than the rest by {height:.3e} behind irregular edges: of the surface, or jumps of an interferometer, and then areas may be off by up to 100 %",
                height = LengthValue(height)
            ),
            Self::Shifted { axis, nodes, share } => sentence!(
                "every second {line} is shifted by {nodes} nodes, as trace and retrace are: areas may be off by up to {error:.0} %",
                line = line_of(axis),
                nodes,
                error = 100.0 * (SHIFT_OVER_GRADIENT * share).min(1.0)
            ),
            Self::AlikeMended { nodes, share } => sentence!(
                "{nodes} of the heights that are mended stand off by the same: if they are pillars or wires of the surface, areas may be off by up to {error:.0} %",
                nodes,
                error = 100.0 * area_error_of(share)
            ),
            Self::LeftAcross { axis, share } => sentence!(
                "the heights still differ more from {line} to {line} than along the {lines}: what is left of the scars or offsets, or a lay of the \
                 surface, and areas may be off by up to {error:.0} %",
                lines = lines_of(axis),
                line = line_of(axis),
                error = 100.0 * area_error_of(share)
            ),
            _ => "".into(),
        }
    }

    /// Whether a step of a preparation mends it.
    pub fn can_be_mended(&self) -> bool {
        matches!(
            self,
            Self::Offsets { .. }
                | Self::Outliers { .. }
                | Self::Scars { .. }
                | Self::Settling { .. }
                | Self::Repeated { .. }
        )
    }
}

/// What lies across an axis.
fn line_of(axis: &str) -> &'static str {
    if axis == "y" { "row" } else { "column" }
}

/// All that lies across an axis.
fn lines_of(axis: &str) -> &'static str {
    if axis == "y" { "rows" } else { "columns" }
}

fn waves_in_words(count: usize) -> Sentence {
    if count == 1 { "a wave".into() } else { sentence!("the strongest of {count} waves", count) }
}

fn clusters_in_words(count: usize) -> Sentence {
    if count == 1 { "a cluster".into() } else { sentence!("{count} clusters", count) }
}

/// The relative error of areas of heights of which only every second, third, ... one is a measured one.
fn error_of_repeats(times: usize) -> f64 {
    (OFF_BY_REPEATS * ((times - 1) as f64).powf(1.5)).min(1.0)
}

/// The relative error of areas by what makes a share of the mean square gradient: that share.
///
/// At the same load an area goes with the inverse rms gradient, which would be about half of it; but short waves make summits sharper, too. Of 20 maps
/// with hum or drift, the error of 7 was above that by the gradient alone. Of 40, that of one was above the share (0.36, told 0.33).
fn area_error_of(share: f64) -> f64 {
    share.min(1.0)
}
