//! Legends: a line for each series that has a name.

use super::clip::runs;
use super::colour::Colour;
use super::figure::{Panel, Series};
use super::font::width;
use super::frame::AxesFrame;
use super::series::{draw_line, draw_symbol};
use super::sheet::{Align, Element, Sheet, rectangle};
use super::style::LegendPlace;

const TEXT: f64 = 14.0;
/// Height of a line.
const ROW: f64 = 20.0;
/// Length of the piece of a series.
const SAMPLE: f64 = 32.0;
const PADDING: f64 = 7.0;
/// Between the legend and the frame.
const MARGIN: f64 = 9.0;
const OPACITY: f64 = 0.85;

/// Scales of a legend, and places of it over the room that it leaves in the frame: those that are tried, the best first.
const SCALES: [f64; 3] = [1.0, 0.85, 0.7];
#[rustfmt::skip]
const PLACES: [[f64; 2]; 9] =
    [[1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 1.0], [1.0, 0.5], [0.0, 0.5], [0.5, 0.5]];

/// Draws the legend of `panel` where it hides least of its `frame`, whose series are the elements from number `first` on.
pub(crate) fn draw_legend(sheet: &mut Sheet, frame: &AxesFrame, panel: &Panel, first: usize, legend: LegendPlace) {
    let named: Vec<&Series> = panel.series.iter().filter(|series| !series.name.is_empty()).collect();
    if named.is_empty() || legend == LegendPlace::None {
        return;
    }
    let widest = named.iter().map(|series| width(&series.name, TEXT)).fold(0.0, f64::max);
    let size = [3.0 * PADDING + SAMPLE + widest, 2.0 * PADDING + ROW * named.len() as f64];
    let (scale, [left, top]) = place(frame, size, &sheet.elements[first..], legend);
    let corners = rectangle([left, top], size.map(|length| scale * length));
    sheet.edge(&corners, Colour::PALE, 1.0);
    sheet.shape(corners, Colour::WHITE, OPACITY);
    for (i, series) in named.into_iter().enumerate() {
        let [left, y] = [left + scale * PADDING, top + scale * (PADDING + ROW * (i as f64 + 0.5))];
        draw_line(sheet, series, vec![[left, y], [left + scale * SAMPLE, y]]);
        draw_symbol(sheet, series, [left + 0.5 * scale * SAMPLE, y]);
        sheet.words(&series.name, [left + scale * (SAMPLE + PADDING), y], scale * TEXT, Align::Left);
    }
}

/// The scale and the top left corner of a legend that hides least of `marks`.
fn place(frame: &AxesFrame, size: [f64; 2], marks: &[Element], legend: LegendPlace) -> (f64, [f64; 2]) {
    let room = |scale: f64| [0, 1].map(|axis| frame.size[axis] - 2.0 * MARGIN - scale * size[axis]);
    let corner =
        |scale, place: [f64; 2]| [0, 1].map(|axis| frame.corner[axis] + MARGIN + place[axis] * room(scale)[axis]);
    let places = match legend {
        LegendPlace::Auto | LegendPlace::None => &PLACES[..],
        LegendPlace::TopRight => &PLACES[..1],
        LegendPlace::BottomRight => &PLACES[1..2],
        LegendPlace::TopLeft => &PLACES[2..3],
        LegendPlace::BottomLeft => &PLACES[3..4],
    };
    let at = |scale| places.iter().map(move |place| (scale, corner(scale, *place)));
    let choices = SCALES.into_iter().filter(|scale| legend == LegendPlace::Auto || *scale == 1.0).flat_map(at);
    let hidden = |(scale, corner): &(f64, [f64; 2])| {
        marks.iter().map(|mark| hidden(mark, *corner, size.map(|length| scale * length))).sum::<f64>()
    };
    choices.min_by(|a, b| hidden(a).total_cmp(&hidden(b))).unwrap_or((1.0, frame.corner))
}

/// Length of the line of a mark inside a rectangle, over its sides.
fn hidden(mark: &Element, corner: [f64; 2], size: [f64; 2]) -> f64 {
    let (Element::Line { points, .. } | Element::Shape { corners: points, .. }) = mark else { return 0.0 };
    let within = |point: &[f64; 2]| [0, 1].map(|axis| (point[axis] - corner[axis]) / size[axis]);
    let length = |run: &[[f64; 2]]| (run[1][0] - run[0][0]).hypot(run[1][1] - run[0][1]);
    runs(&points.iter().map(within).collect::<Vec<_>>()).iter().flat_map(|run| run.windows(2)).map(length).sum()
}
