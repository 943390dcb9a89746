//! Scales of colours beside images.

use crate::plot::{Align, AxesFrame, Axis, AxisSide, Sheet};
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::{ColourMap, Palette};
use rerun::{LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// Bars of a scale.
const SHADES: usize = 64;
/// From a frame to the middle of the bar, and to that of the name of its numbers, over the size of words.
const BAR: f64 = 1.3;
const NAME: f64 = 7.0;

/// The colours of an image, and the bar beside it that explains them.
pub(crate) struct ColourScale {
    pub root: String,
    pub palette: &'static Palette,
    pub map: ColourMap,
}

impl ColourScale {
    /// Records the bar beside a frame, with the numbers of an axis.
    pub(crate) fn log(&self, to: &RecordingStream, frame: &AxesFrame, axis: &Axis) -> RecordingStreamResult<()> {
        to.log_static(format!("{}/colours", self.root), &self.bar(frame))?;
        canvas::log_sheet(to, self.palette, &self.root, &words(frame, axis))
    }

    /// Shades one above the other, each overlapped by the next.
    fn bar(&self, frame: &AxesFrame) -> LineStrips2D {
        let AxesFrame { size, text, .. } = frame;
        let (x, height, text) = ((size[0] + BAR * text) as f32, size[1] as f32, *text as f32);
        let y = |shade: usize| (1.0 - shade as f32 / SHADES as f32) * height;
        let bars = (0..SHADES).map(|shade| [[x, y(shade)], [x, y((shade + 2).min(SHADES))]]);
        let colours = (0..SHADES).map(|shade| self.map.at((shade as f64 + 0.5) / SHADES as f64));
        LineStrips2D::new(bars).with_colors(colours).with_radii([Radius::new_scene_units(0.4 * text)])
    }
}

/// Numbers beside the bar, and their name to the right of them, upwards.
fn words(frame: &AxesFrame, axis: &Axis) -> Sheet {
    let scale = AxesFrame { y: axis.clone(), ..frame.clone() };
    let AxesFrame { size: [width, height], text, .. } = scale;
    let mut sheet = Sheet::default();
    for (place, label) in scale.labels(AxisSide::Left) {
        sheet.words(&label, [width + (BAR + 0.8) * text, (1.0 - place) * height], text, Align::Left);
    }
    sheet.fitted_words(&axis.name, [width + NAME * text, 0.5 * height], 1.13 * text, height, true);
    sheet
}
