//! Legends: a line for each series that has a name.

use super::font::width;
use super::frame::Frame;
use super::series::{draw_line, draw_symbol};
use super::sheet::{Align, Sheet, rectangle};
use super::{Colour, Corner, Series};

const TEXT: f64 = 14.0;
/// Height of a line.
const ROW: f64 = 20.0;
/// Length of the piece of a series.
const SAMPLE: f64 = 32.0;
const PADDING: f64 = 7.0;
/// Between the legend and the frame.
const MARGIN: f64 = 9.0;
const OPACITY: f64 = 0.85;

/// Draws the legend of the panel in `frame`.
pub fn draw_legend(sheet: &mut Sheet, frame: &Frame) {
    let named: Vec<&Series> = frame.panel.series.iter().filter(|series| !series.name.is_empty()).collect();
    if named.is_empty() {
        return;
    }
    let widest = named.iter().map(|series| width(&series.name, TEXT)).fold(0.0, f64::max);
    let size = [3.0 * PADDING + SAMPLE + widest, 2.0 * PADDING + ROW * named.len() as f64];
    let [left, top] = corner(frame, size);
    let corners = rectangle([left, top], [left + size[0], top + size[1]]);
    sheet.edge(&corners, Colour::PALE, 1.0);
    sheet.shape(corners, Colour::WHITE, OPACITY);
    for (i, series) in named.into_iter().enumerate() {
        draw_entry(sheet, series, [left + PADDING, top + PADDING + ROW * (i as f64 + 0.5)]);
    }
}

/// The top left corner of a legend.
fn corner(frame: &Frame, [width, height]: [f64; 2]) -> [f64; 2] {
    let left = frame.left + MARGIN;
    let right = frame.left + frame.width - MARGIN - width;
    let top = frame.top + MARGIN;
    let bottom = frame.top + frame.height - MARGIN - height;
    match frame.panel.legend {
        Corner::TopLeft => [left, top],
        Corner::TopRight => [right, top],
        Corner::BottomLeft => [left, bottom],
        Corner::BottomRight => [right, bottom],
    }
}

fn draw_entry(sheet: &mut Sheet, series: &Series, [left, y]: [f64; 2]) {
    draw_line(sheet, series, vec![[left, y], [left + SAMPLE, y]]);
    draw_symbol(sheet, series, [left + 0.5 * SAMPLE, y]);
    sheet.text(&series.name, [left + SAMPLE + PADDING, y], TEXT, Align::Left);
}
