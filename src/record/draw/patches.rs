//! The contacts of a line under all loads, one row above the other: how patches grow and merge.

use super::canvas::{self, style};
use super::fill::zigzag;
use super::palette::Palette;
use crate::plot::{Axis, Frame};
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Bars of a row along the line.
const BARS: f32 = 1024.0;
/// Share of its room that a row fills.
const FILL: f64 = 0.86;
/// Rows that there is room for at least, so that the numbers of the loads are whole.
const FEWEST: usize = 4;

/// A map of the contact, the position to the right and the load upwards. It grows with the load.
pub struct PatchMap {
    frame: Frame,
    palette: &'static Palette,
    pub root: String,
}

impl PatchMap {
    /// The map under `root` of a line under so many loads, beside pictures in `frame`.
    pub fn new(frame: Frame, palette: &'static Palette, root: &str, loads: usize) -> Self {
        let y = Axis::linear("load", [0.5, loads.max(FEWEST) as f64 + 0.5]);
        Self { frame: Frame { y, ..frame }, palette, root: format!("{root}/patches") }
    }

    pub fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame)
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame)
    }

    /// Records the contact under load number `load` at the current time, as the ends of its segments; it stays for heavier loads.
    pub fn log(&self, to: &RecordingStream, load: usize, segments: &[[f32; 2]]) -> RecordingStreamResult<()> {
        let y = |side: f64| self.frame.position([0.0, self.frame.y.place(load as f64 + 1.0 + FILL * side)])[1] as f32;
        let ends = [y(-0.5), y(0.5)];
        let width = self.frame.size[0] as f32;
        let fill = |segment: &[f32; 2]| {
            let bars = ((segment[1] - segment[0]) / width * BARS).ceil().max(1.0) as usize;
            zigzag(*segment, bars, |_, _| ends)
        };
        let row = style(self.palette.contact, Radius::new_scene_units(width / BARS), 10.0);
        let row = row.with_strips(segments.iter().map(fill));
        to.log(format!("{}/row/{}", self.root, load + 1), &row)?;
        let cursor = style(self.palette.ink, Radius::new_ui_points(2.0), 30.0);
        let sides = [0.0, width].map(|x| ends.map(|y| [x, y]));
        to.log(format!("{}/cursor", self.root), &cursor.with_strips(sides))
    }
}
