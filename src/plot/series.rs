//! Series between axes: error bars, then lines, then symbols.

use super::clip::{dashes, runs};
use super::colour::Colour;
use super::figure::{Dot, Series};
use super::frame::AxesFrame;
use super::mark::Mark;
use super::sheet::{Sheet, rectangle};

const LINE: f64 = 2.0;
const FINE_LINE: f64 = 1.4;
/// Opacity of an area.
const PALE: f64 = 0.18;
/// Length of the head of an arrow.
const HEAD: f64 = 12.0;
/// By what neighbouring tiles overlap.
const SEAM: f64 = 0.4;
/// From the middle of an error bar to the end of a cap.
const CAP: f64 = 4.0;

/// Draws the part of a series inside `frame`.
pub(crate) fn draw_series(sheet: &mut Sheet, frame: &AxesFrame, series: &Series) {
    series.dots.iter().for_each(|dot| draw_bar(sheet, frame, series.colour, dot));
    let places: Vec<[f64; 2]> = series.dots.iter().map(|dot| frame.places(dot.x, dot.y)).collect();
    for run in runs(&places) {
        draw_line(sheet, series, run.into_iter().map(|place| frame.position(place)).collect());
    }
    for place in places.into_iter().filter(|place| place.iter().all(|place| (0.0..=1.0).contains(place))) {
        match series.mark {
            Mark::Tile { columns, rows } => draw_tile(sheet, frame, series.colour, place, [columns, rows]),
            _ => draw_symbol(sheet, series, frame.position(place)),
        }
    }
}

/// Draws a tile about a place, a little larger than its share of the frame, so that no seam is seen between tiles.
fn draw_tile(sheet: &mut Sheet, frame: &AxesFrame, colour: Colour, place: [f64; 2], tiles: [u32; 2]) {
    let [x, y] = frame.position(place);
    let [width, height] = [0, 1].map(|axis| frame.size[axis] / f64::from(tiles[axis]) + SEAM);
    sheet.shape(rectangle([x - 0.5 * width, y - 0.5 * height], [width, height]), colour, 1.0);
}

/// Draws the line of a series through `points` of the sheet, if it has one.
pub(crate) fn draw_line(sheet: &mut Sheet, series: &Series, points: Vec<[f64; 2]>) {
    let pattern = match series.mark {
        Mark::Symbol { .. } | Mark::Tile { .. } => return,
        Mark::Area => return sheet.shape(points, series.colour, PALE),
        Mark::Arrow => return draw_arrow(sheet, series.colour, &points),
        Mark::Line | Mark::Joined { .. } => return sheet.line(points, series.colour, LINE),
        Mark::Dashed => [7.0, 4.5],
        Mark::Dotted => [2.0, 3.5],
    };
    dashes(&points, pattern).into_iter().for_each(|dash| sheet.line(dash, series.colour, LINE));
}

/// Draws an arrow from the first to the last point.
fn draw_arrow(sheet: &mut Sheet, colour: Colour, points: &[[f64; 2]]) {
    let (Some(&[x, y]), Some(&end)) = (points.first(), points.last()) else { return };
    let [dx, dy] = [end[0] - x, end[1] - y];
    let length = dx.hypot(dy);
    if length == 0.0 {
        return;
    }
    let [along, side] = [[dx / length, dy / length], [-dy / length, dx / length]];
    let head = HEAD.min(0.5 * length);
    let corner = |back: f64, out: f64| [0, 1].map(|axis| end[axis] - back * along[axis] + out * side[axis]);
    sheet.line(vec![[x, y], corner(head, 0.0)], colour, LINE);
    sheet.shape(vec![end, corner(head, 0.4 * head), corner(head, -0.4 * head)], colour, 1.0);
}

/// Draws the symbol of a series at a position on the sheet, if it has one.
pub(crate) fn draw_symbol(sheet: &mut Sheet, series: &Series, [x, y]: [f64; 2]) {
    let (Mark::Symbol { symbol, filled } | Mark::Joined { symbol, filled }) = series.mark else { return };
    let outline = |inset| symbol.outline(inset).into_iter().map(|[right, down]| [x + right, y + down]).collect();
    sheet.shape(outline(0.0), series.colour, 1.0);
    if !filled {
        sheet.shape(outline(FINE_LINE), Colour::WHITE, 1.0);
    }
}

/// Draws an error bar as far as it lies inside, with caps where it ends there.
fn draw_bar(sheet: &mut Sheet, frame: &AxesFrame, colour: Colour, dot: &Dot) {
    let ends = [-1.0, 1.0].map(|sign| frame.places(dot.x, dot.y + sign * dot.spread));
    let is_bar = dot.y.is_finite() && dot.spread > 0.0;
    let x = ends[0][0];
    let [low, high] = ends.map(|[_, y]| y.clamp(0.0, 1.0));
    if !is_bar || !(0.0..=1.0).contains(&x) || low == high {
        return;
    }
    sheet.line(vec![frame.position([x, low]), frame.position([x, high])], colour, FINE_LINE);
    for end in ends.into_iter().filter(|[_, y]| (0.0..=1.0).contains(y)) {
        let [x, y] = frame.position(end);
        sheet.line(vec![[x - CAP, y], [x + CAP, y]], colour, FINE_LINE);
    }
}
