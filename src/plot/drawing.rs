//! The drawing of a figure: where its panels lie, and what is drawn in them.

use super::axis::Axis;
use super::field_map::BESIDE;
use super::figure::{Figure, Panel};
use super::font::width;
use super::frame::{AxesFrame, AxisSide};
use super::legend::draw_legend;
use super::series::draw_series;
use super::sheet::Sheet;
use super::style::{FigureStyle, LABEL, LegendPlace};

/// Width and height of a panel with all that belongs to it.
const SIZE: [f64; 2] = [600.0, 480.0];
/// Panels in a row, at most.
const IN_A_ROW: usize = 2;
/// The least width of a panel beside another one.
const NARROW: f64 = 330.0;
/// The least width and height of a frame.
const LEAST: f64 = 40.0;
/// Height of the title of a figure.
const HEAD: f64 = 40.0;
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

/// Draws `figure` in a style.
pub(crate) fn drawing(figure: &Figure, style: &FigureStyle) -> Sheet {
    let figure = style.applied(figure);
    let lengths = [style.width, style.height].map(|length| length.map(|it| it / style.unit()));
    let most = lengths[0].map_or(IN_A_ROW, |width| ((width / NARROW) as usize).clamp(1, IN_A_ROW));
    let columns = figure.panels.len().clamp(1, most);
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let head = if figure.title.is_empty() { 0.0 } else { HEAD };
    let width = lengths[0].map_or(SIZE[0], |width| width / columns as f64);
    let heights = figure.panels.iter().map(|panel| usual_height(panel, width));
    let usual = heights.reduce(f64::max).unwrap_or(SIZE[1]);
    let height = lengths[1].map_or(usual, |height| ((height - head) / rows as f64).max(LEAST));
    let all = [columns as f64 * width, head + rows as f64 * height];
    let mut sheet = Sheet { size: all.map(|length| length.round() as u32), elements: Vec::new() };
    let middle = 0.5 * all[0];
    sheet.fitted_words(&figure.title, [middle, 0.6 * head], FIGURE_TITLE, 1.9 * middle, false);
    for (i, panel) in figure.panels.iter().enumerate() {
        let [column, row] = [i % columns, i / columns].map(|i| i as f64);
        let corner = [column * width, head + row * height];
        draw_panel(&mut sheet, &frame_in(panel, corner, [width, height]), panel, style.legend);
    }
    sheet
}

/// Draws a panel alone, of a size, with its top left corner at `corner`.
#[cfg(feature = "record")]
pub(crate) fn drawing_of(panel: &Panel, corner: [f64; 2], size: [f64; 2]) -> Sheet {
    let mut sheet = Sheet::default();
    draw_panel(&mut sheet, &frame_in(panel, corner, size), panel, LegendPlace::Auto);
    sheet
}

/// The frame of a panel of a size whose top left corner is at `[x, y]`.
pub(crate) fn frame_in(panel: &Panel, [x, y]: [f64; 2], [width, height]: [f64; 2]) -> AxesFrame {
    let [left, above] = [NAME + labels(&panel.y), if panel.title.is_empty() { 0.5 * ABOVE } else { ABOVE }];
    let right = if panel.map.is_some() { BESIDE } else { RIGHT };
    let room = [(width - left - right).max(LEAST), (height - above - BELOW).max(LEAST)];
    let size = if panel.map.is_some() { proportioned(panel, room) } else { room };
    AxesFrame { x: panel.x.clone(), y: panel.y.clone(), corner: [x + left, y + above], size, text: LABEL }
}

/// The height of a panel of some width, if none is given: that of a map follows from its proportions.
fn usual_height(panel: &Panel, width: f64) -> f64 {
    let usual = SIZE[1] / SIZE[0] * width;
    match &panel.map {
        None => usual,
        Some(_) => {
            let frame = frame_in(panel, [0.0; 2], [width, 2.0 * width]);
            frame.corner[1] + frame.size[1] + BELOW
        }
    }
}

/// The largest size within some room with which lengths along both axes are the same.
fn proportioned(panel: &Panel, [width, height]: [f64; 2]) -> [f64; 2] {
    let [x, y] = [&panel.x, &panel.y].map(|axis| (axis.range[1] - axis.range[0]).abs());
    let scale = (width / x).min(height / y);
    if scale.is_normal() { [scale * x, scale * y].map(|length| length.max(LEAST)) } else { [width, height] }
}

/// Width of the labels of an axis.
fn labels(axis: &Axis) -> f64 {
    axis.ticks().iter().map(|(_, label)| width(label, LABEL)).fold(LABELS, f64::max)
}

fn draw_panel(sheet: &mut Sheet, frame: &AxesFrame, panel: &Panel, legend: LegendPlace) {
    match &panel.map {
        Some(map) => map.draw(sheet, frame),
        None => frame.draw_grid(sheet),
    }
    [AxisSide::Below, AxisSide::Left].into_iter().for_each(|side| frame.draw_axis(sheet, side));
    let [x, y] = frame.position([0.5, 1.0]);
    sheet.fitted_words(&panel.title, [x, y - 0.5 * ABOVE], PANEL_TITLE, frame.size[0], false);
    let first = sheet.elements.len();
    panel.series.iter().for_each(|series| draw_series(sheet, frame, series));
    frame.draw_box(sheet);
    draw_legend(sheet, frame, panel, first, legend);
}
