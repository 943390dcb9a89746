//! Legends: a line for each series that has a name.

use super::clip::runs;
use super::colour::Colour;
use super::figure::{Corner, Panel, Series};
use super::font::width;
use super::frame::Frame;
use super::series::{draw_line, draw_symbol};
use super::sheet::{Align, Element, Sheet, rectangle};

const TEXT: f64 = 13.0;
/// Height of a line.
const ROW: f64 = 20.0;
/// Length of the piece of a series.
const SAMPLE: f64 = 32.0;
const PADDING: f64 = 7.0;
/// Between the legend and the frame.
const MARGIN: f64 = 9.0;
const OPACITY: f64 = 0.85;

/// Draws the legend of `panel` where it hides least of its `frame`, whose series are the elements from number `first` on.
pub fn draw_legend(sheet: &mut Sheet, frame: &Frame, panel: &Panel, first: usize) {
    let named: Vec<&Series> = panel.series.iter().filter(|series| !series.name.is_empty()).collect();
    if named.is_empty() {
        return;
    }
    let widest = named.iter().map(|series| width(&series.name, TEXT)).fold(0.0, f64::max);
    let size = [3.0 * PADDING + SAMPLE + widest, 2.0 * PADDING + ROW * named.len() as f64];
    let [left, top] = place(frame, panel.legend, size, &sheet.elements[first..]);
    let corners = rectangle([left, top], size);
    sheet.edge(&corners, Colour::PALE, 1.0);
    sheet.shape(corners, Colour::WHITE, OPACITY);
    for (i, series) in named.into_iter().enumerate() {
        draw_entry(sheet, series, [left + PADDING, top + PADDING + ROW * (i as f64 + 0.5)]);
    }
}

/// The top left corner of a legend: in the corner `wanted`, or in another one where less of `marks` is hidden.
fn place(frame: &Frame, wanted: Corner, size: [f64; 2], marks: &[Element]) -> [f64; 2] {
    let corners = [wanted, Corner::TopLeft, Corner::TopRight, Corner::BottomLeft, Corner::BottomRight];
    let places = corners.map(|corner| top_left(frame, corner, size));
    let hidden = |place: &[f64; 2]| marks.iter().map(|mark| hidden(mark, *place, size)).sum::<f64>();
    places.into_iter().min_by(|a, b| hidden(a).total_cmp(&hidden(b))).unwrap_or(frame.corner)
}

fn top_left(frame: &Frame, corner: Corner, size: [f64; 2]) -> [f64; 2] {
    let [near, far] = [
        frame.corner.map(|near| near + MARGIN),
        [0, 1].map(|axis| frame.corner[axis] + frame.size[axis] - MARGIN - size[axis]),
    ];
    match corner {
        Corner::TopLeft => near,
        Corner::TopRight => [far[0], near[1]],
        Corner::BottomLeft => [near[0], far[1]],
        Corner::BottomRight => far,
    }
}

/// Length of the line of a mark inside a rectangle, over its sides.
fn hidden(mark: &Element, corner: [f64; 2], size: [f64; 2]) -> f64 {
    let (Element::Line { points, .. } | Element::Shape { corners: points, .. }) = mark else { return 0.0 };
    let within = |point: &[f64; 2]| [0, 1].map(|axis| (point[axis] - corner[axis]) / size[axis]);
    let length = |run: &[[f64; 2]]| (run[1][0] - run[0][0]).hypot(run[1][1] - run[0][1]);
    runs(&points.iter().map(within).collect::<Vec<_>>()).iter().flat_map(|run| run.windows(2)).map(length).sum()
}

fn draw_entry(sheet: &mut Sheet, series: &Series, [left, y]: [f64; 2]) {
    draw_line(sheet, series, vec![[left, y], [left + SAMPLE, y]]);
    draw_symbol(sheet, series, [left + 0.5 * SAMPLE, y]);
    sheet.words(&series.name, [left + SAMPLE + PADDING, y], TEXT, Align::Left);
}

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::*;

    #[test]
    fn a_legend_stands_where_it_is_wanted_or_else_where_it_hides_less() {
        let [x, y] = ["x", "y"].map(|name| Axis::linear(name, [0.0, 1.0]));
        let frame = Frame { x, y, corner: [0.0, 0.0], size: [100.0, 100.0], text: 15.0 };
        let line = |points: &[[f64; 2]]| Element::Line { points: points.to_vec(), colour: Colour::BLUE, width: 1.0 };
        let place = |marks: &[Element]| place(&frame, Corner::TopLeft, [40.0, 40.0], marks);
        assert_eq!(place(&[line(&[[0.0, 50.0], [100.0, 50.0]])]), [9.0, 9.0]);
        assert_eq!(place(&[line(&[[0.0, 30.0], [100.0, 30.0]])]), [9.0, 51.0]);
        assert_eq!(place(&[line(&[[0.0, 0.0], [100.0, 100.0]]), line(&[[0.0, 60.0], [100.0, 60.0]])]), [51.0, 9.0]);
    }
}
