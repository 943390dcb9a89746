//! The drawing of a figure: where its panels lie, and what is drawn in them.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::font::width;
use super::frame::{AxesFrame, AxisSide};
use super::legend::draw_legend;
use super::series::draw_series;
use super::sheet::Sheet;

/// Width and height of a panel with all that belongs to it.
const SIZE: [u32; 2] = [600, 480];
/// Panels in a row, at most.
const IN_A_ROW: usize = 2;
/// The least width and height of a frame.
const LEAST: f64 = 40.0;
/// Height of the title of a figure.
const HEAD: u32 = 40;
/// Above the frame, for the title of a panel; without one half of it is free.
const ABOVE: f64 = 34.0;
const BELOW: f64 = 62.0;
const RIGHT: f64 = 22.0;
/// Left of the labels of the y axis, for its name.
const NAME: f64 = 34.0;
/// Room for labels, which aligns panels whose labels are not longer.
const LABELS: f64 = 54.0;

const FIGURE_TITLE: f64 = 20.0;
const PANEL_TITLE: f64 = 17.0;
const LABEL: f64 = 15.0;

/// Draws `figure`.
pub fn drawing(figure: &Figure) -> Sheet {
    let columns = figure.panels.len().clamp(1, IN_A_ROW);
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let head = if figure.title.is_empty() { 0 } else { HEAD };
    let size = [columns as u32 * SIZE[0], head + rows as u32 * SIZE[1]];
    let mut sheet = Sheet { size, elements: Vec::new() };
    let middle = 0.5 * f64::from(size[0]);
    sheet.fitted_words(&figure.title, [middle, 0.6 * f64::from(head)], FIGURE_TITLE, 1.9 * middle, false);
    for (i, panel) in figure.panels.iter().enumerate() {
        let [column, row] = [i % columns, i / columns].map(|i| i as u32);
        let corner = [column * SIZE[0], head + row * SIZE[1]];
        draw_panel(&mut sheet, &frame_in(panel, corner.map(f64::from), SIZE.map(f64::from)), panel);
    }
    sheet
}

/// Draws a panel alone, of a size, with its top left corner at `corner`.
#[cfg(feature = "record")]
pub fn drawing_of(panel: &Panel, corner: [f64; 2], size: [f64; 2]) -> Sheet {
    let mut sheet = Sheet::default();
    draw_panel(&mut sheet, &frame_in(panel, corner, size), panel);
    sheet
}

/// The frame of a panel of a size whose top left corner is at `[x, y]`.
pub fn frame_in(panel: &Panel, [x, y]: [f64; 2], [width, height]: [f64; 2]) -> AxesFrame {
    let [left, above] = [NAME + labels(&panel.y), if panel.title.is_empty() { 0.5 * ABOVE } else { ABOVE }];
    AxesFrame {
        x: panel.x.clone(),
        y: panel.y.clone(),
        corner: [x + left, y + above],
        size: [(width - left - RIGHT).max(LEAST), (height - above - BELOW).max(LEAST)],
        text: LABEL,
    }
}

/// Width of the labels of an axis.
fn labels(axis: &Axis) -> f64 {
    axis.ticks().iter().map(|(_, label)| width(label, LABEL)).fold(LABELS, f64::max)
}

fn draw_panel(sheet: &mut Sheet, frame: &AxesFrame, panel: &Panel) {
    frame.draw_grid(sheet);
    [AxisSide::Below, AxisSide::Left].into_iter().for_each(|side| frame.draw_axis(sheet, side));
    let [x, y] = frame.position([0.5, 1.0]);
    sheet.fitted_words(&panel.title, [x, y - 0.5 * ABOVE], PANEL_TITLE, frame.size[0], false);
    let first = sheet.elements.len();
    panel.series.iter().for_each(|series| draw_series(sheet, frame, series));
    frame.draw_box(sheet);
    draw_legend(sheet, frame, panel, first);
}
