//! Scales of colours beside images.

use super::canvas;
use super::palette::{Map, Palette};
use crate::plot::{Align, Axis, Frame, Sheet};
use rerun::{LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// Bars of a scale.
const SHADES: usize = 64;

/// The colours of an image, and the bar beside it that explains them.
pub struct ColourScale {
    pub root: String,
    pub palette: &'static Palette,
    pub map: Map,
}

impl ColourScale {
    /// Records the bar beside a frame, with the numbers of an axis.
    pub fn log(&self, to: &RecordingStream, frame: &Frame, axis: &Axis) -> RecordingStreamResult<()> {
        to.log_static(format!("{}/colours", self.root), &self.bar(frame))?;
        canvas::log_sheet(to, self.palette, &self.root, &words(frame, axis), canvas::head(frame))
    }

    /// Shades one above the other, each overlapped by the next.
    fn bar(&self, frame: &Frame) -> LineStrips2D {
        let Frame { size, text, .. } = frame;
        let (x, height, text) = ((size[0] + 1.5 * text) as f32, size[1] as f32, *text as f32);
        let y = |shade: usize| (1.0 - shade as f32 / SHADES as f32) * height;
        let bars = (0..SHADES).map(|shade| [[x, y(shade)], [x, y((shade + 2).min(SHADES))]]);
        let colours = (0..SHADES).map(|shade| self.map.at((shade as f64 + 0.5) / SHADES as f64));
        LineStrips2D::new(bars).with_colors(colours).with_radii([Radius::new_scene_units(0.4 * text)])
    }
}

/// Numbers beside the bar, and their name above it.
fn words(frame: &Frame, axis: &Axis) -> Sheet {
    let Frame { size: [width, height], text, .. } = *frame;
    let mut sheet = Sheet::default();
    for (value, label) in axis.ticks() {
        let at = [width + 2.3 * text, (1.0 - axis.place(value)) * height];
        sheet.words(&label, at, text, Align::Left);
    }
    sheet.words(&axis.name, [width + 1.5 * text, canvas::head(frame) + 0.72 * text], text, Align::Middle);
    sheet
}
