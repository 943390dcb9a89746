//! Fields in colours.

use super::axis::Axis;
use super::colour::Colour;
use super::frame::{AxesFrame, AxisSide};
use super::sheet::{PixelImage, Sheet};

/// Colours of the scale from its start to its end, evenly spaced: viridis of matplotlib.
const STOPS: [[f64; 3]; 9] = [
    [68.0, 1.0, 84.0],
    [71.0, 44.0, 122.0],
    [59.0, 81.0, 139.0],
    [44.0, 113.0, 142.0],
    [33.0, 144.0, 141.0],
    [39.0, 173.0, 129.0],
    [92.0, 200.0, 99.0],
    [170.0, 220.0, 50.0],
    [253.0, 231.0, 37.0],
];
/// Steps of the bar of colours.
const STEPS: usize = 256;
/// Width of the bar, its distance from the frame, and the room for its labels and its name.
const BAR: f64 = 16.0;
const APART: f64 = 14.0;
pub(crate) const BESIDE: f64 = APART + BAR + 100.0;

/// A field between the axes of a panel, in the colours of a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldMap {
    /// Rows and columns.
    pub shape: [usize; 2],
    /// Values, row by row, the first row below; values that are not finite stay white.
    pub values: Vec<f64>,
    /// The scale of the colours, with the name of the field.
    pub scale: Axis,
}

impl FieldMap {
    /// Draws the field, and the bar of its colours to the right of the frame.
    pub(super) fn draw(&self, sheet: &mut Sheet, frame: &AxesFrame) {
        let [rows, columns] = self.shape;
        let pixel = |(row, column): (usize, usize)| self.colour(self.values[(rows - 1 - row) * columns + column]);
        let pixels = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).map(pixel).collect();
        sheet.image(PixelImage { corner: frame.corner, size: frame.size, shape: self.shape, pixels });
        let [left, top] = [frame.corner[0] + frame.size[0] + APART, frame.corner[1]];
        let bar = AxesFrame {
            x: Axis::linear("", [0.0, 1.0]),
            y: self.scale.clone(),
            corner: [left, top],
            size: [BAR, frame.size[1]],
            text: frame.text,
        };
        let step = |i: usize| self.colour(self.scale.value(1.0 - (i as f64 + 0.5) / STEPS as f64));
        let pixels = (0..STEPS).map(step).collect();
        sheet.image(PixelImage { corner: bar.corner, size: bar.size, shape: [STEPS, 1], pixels });
        bar.draw_axis(sheet, AxisSide::Right);
        bar.draw_box(sheet);
    }

    /// The colour of a value: that of the nearer end for one beyond the scale.
    fn colour(&self, value: f64) -> Colour {
        let place = self.scale.place(value);
        if !value.is_finite() || place.is_nan() {
            return Colour::WHITE;
        }
        let place = place.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
        let stop = (place as usize).min(STOPS.len() - 2);
        let share = place - stop as f64;
        Colour(std::array::from_fn(|i| (STOPS[stop][i] + share * (STOPS[stop + 1][i] - STOPS[stop][i])).round() as u8))
    }
}
