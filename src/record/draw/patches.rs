//! The contacts of a line under all loads, one row above the other: how patches grow and merge.

use super::canvas::{self, style};
use super::fill::zigzag;
use super::load_axis::LoadAxis;
use super::palette::Palette;
use crate::plot::Frame;
use rerun::{Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Bars of a row along the line.
const BARS: f32 = 1024.0;
/// Share of its room that a row fills.
const FILL: f64 = 0.86;

/// A map of the contact, the position to the right and the load upwards. It grows with the load.
pub struct PatchMap {
    frame: Frame,
    palette: &'static Palette,
    loads: LoadAxis,
    pub root: String,
}

impl PatchMap {
    /// The map under `root` of a line under `loads`, beside pictures in `frame`.
    pub fn new(frame: Frame, palette: &'static Palette, root: &str, loads: LoadAxis) -> Self {
        Self { frame: Frame { y: loads.whole(), ..frame }, palette, loads, root: format!("{root}/patches") }
    }

    pub fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame)
    }

    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &self.frame)
    }

    /// Records the contact under load number `load` at the current time, as the ends of its segments; it stays for heavier loads.
    pub fn log(&self, to: &RecordingStream, load: usize, segments: &[[f32; 2]]) -> RecordingStreamResult<()> {
        let Some(room) = self.loads.room(load) else { return Ok(()) };
        let [low, high] = room.map(|end| self.frame.y.place(end));
        let y = |side: f64| self.frame.position([0.0, 0.5 * (low + high) + side * FILL * (high - low)])[1] as f32;
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

    /// Stretches the map to the loads that came, for all times.
    pub fn settle(&self, to: &RecordingStream, loads: impl IntoIterator<Item = usize>) -> RecordingStreamResult<()> {
        let y = self.loads.over(loads);
        let [low, high] = y.range.map(|end| self.frame.y.place(end));
        let stretch = 1.0 / (high - low);
        let shift = self.frame.size[1] * (1.0 - (1.0 - low) * stretch);
        let transform = Transform3D::from_translation([0.0, shift as f32, 0.0]).with_scale([1.0, stretch as f32, 1.0]);
        for stretched in ["row", "cursor"] {
            to.log_static(format!("{}/{stretched}", self.root), &transform)?;
        }
        canvas::log_axes(to, self.palette, &format!("{}/axes", self.root), &Frame { y, ..self.frame.clone() })
    }
}
