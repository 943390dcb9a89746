//! The drawing of a figure: where its panels lie, and what is drawn in them.

use super::axis::Axis;
use super::figure::{Figure, Panel};
use super::font::width;
use super::frame::{Frame, Side};
use super::legend::draw_legend;
use super::series::draw_series;
use super::sheet::Sheet;

/// Width and height of a panel with all that belongs to it.
const SIZE: [u32; 2] = [600, 480];
/// Panels in a row, at most.
const IN_A_ROW: usize = 2;
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
        draw_panel(&mut sheet, &frame_of(panel, corner.map(f64::from)), panel);
    }
    sheet
}

/// The frame of a panel whose top left corner is at `[x, y]`.
pub fn frame_of(panel: &Panel, [x, y]: [f64; 2]) -> Frame {
    let [left, above] = [NAME + labels(&panel.y), if panel.title.is_empty() { 0.5 * ABOVE } else { ABOVE }];
    let [width, height] = SIZE.map(f64::from);
    Frame {
        x: panel.x.clone(),
        y: panel.y.clone(),
        corner: [x + left, y + above],
        size: [width - left - RIGHT, height - above - BELOW],
        text: LABEL,
    }
}

/// Width of the labels of an axis.
fn labels(axis: &Axis) -> f64 {
    axis.ticks().iter().map(|(_, label)| width(label, LABEL)).fold(LABELS, f64::max)
}

fn draw_panel(sheet: &mut Sheet, frame: &Frame, panel: &Panel) {
    frame.draw_grid(sheet);
    [Side::Below, Side::Left].into_iter().for_each(|side| frame.draw_axis(sheet, side));
    let [x, y] = frame.position([0.5, 1.0]);
    sheet.fitted_words(&panel.title, [x, y - 0.5 * ABOVE], PANEL_TITLE, frame.size[0], false);
    let first = sheet.elements.len();
    panel.series.iter().for_each(|series| draw_series(sheet, frame, series));
    frame.draw_box(sheet);
    draw_legend(sheet, frame, panel, first);
}

#[cfg(test)]
mod tests {
    use super::super::colour::Colour;
    use super::super::figure::{Corner, Point, Series};
    use super::super::mark::{Mark, Symbol};
    use super::super::sheet::Element;
    use super::*;

    const ODD: Colour = Colour([1, 2, 3]);

    /// The elements that a series without a name adds to a panel from 0 to 1 (linear) and from 1e-2 to 1 (logarithmic).
    fn drawn(mark: Mark, points: &[[f64; 3]]) -> Vec<Element> {
        let points = points.iter().map(|&[x, y, spread]| Point { x, y, spread }).collect();
        let [x, y] = [Axis::linear("x", [0.0, 1.0]), Axis::log("y", [1e-2, 1.0])];
        let mut panel = Panel::new("", x, y, Corner::TopLeft);
        panel.series.push(Series::new("", ODD, mark, points));
        let sheet = drawing(&Figure { title: String::new(), panels: vec![panel] });
        let is_odd = |element: &Element| match element {
            Element::Line { colour, .. } | Element::Shape { colour, .. } => *colour == ODD,
            Element::Words { .. } => false,
        };
        sheet.elements.into_iter().filter(is_odd).collect()
    }

    /// The frame of that panel: left, right, top, bottom.
    fn edges() -> [f64; 4] {
        match &drawn(Mark::Line, &[[0.0, 1e-2, 0.0], [1.0, 1.0, 0.0]])[..] {
            [Element::Line { points, .. }] => [points[0][0], points[1][0], points[1][1], points[0][1]],
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn lines_are_cut_at_the_frame() {
        let [left, right, top, bottom] = edges();
        let across = drawn(Mark::Line, &[[-9.0, 0.1, 0.0], [9.0, 0.1, 0.0], [9.0, -1.0, 0.0], [0.5, 0.1, 0.0]]);
        let [Element::Line { points, .. }] = &across[..] else { panic!("{across:?}") };
        let middle = 0.5 * (top + bottom);
        for (point, expected) in points.iter().zip([[left, middle], [right, middle]]) {
            assert!((0..2).all(|i| (point[i] - expected[i]).abs() < 1e-9), "{points:?}");
        }
        assert!(drawn(Mark::Dashed, &[[0.0, 2.0, 0.0], [1.0, 3.0, 0.0]]).is_empty());
        assert!(drawn(Mark::Dotted, &[[0.0, 0.1, 0.0], [1.0, 0.1, 0.0]]).len() > 50);
    }

    #[test]
    fn symbols_outside_are_left_out() {
        let symbol = Mark::Symbol { symbol: Symbol::Circle, filled: true };
        let points = [[0.5, 0.1, 0.0], [1.0, 1.0, 0.0], [1.1, 0.1, 0.0], [0.5, 1e-3, 0.0], [0.5, -1.0, 0.0]];
        assert_eq!(drawn(symbol, &points).len(), 2);
        assert!(drawn(symbol, &[[f64::NAN, 0.1, 0.1], [0.5, f64::INFINITY, 0.1]]).is_empty());
    }

    #[test]
    fn error_bars_are_cut_and_keep_the_caps_inside() {
        let [_, _, top, bottom] = edges();
        let symbol = Mark::Symbol { symbol: Symbol::Square, filled: false };
        assert_eq!(drawn(symbol, &[[0.5, 0.1, 0.05]]).len(), 1 + 3);
        let cut = drawn(symbol, &[[0.5, 0.1, 0.2]]);
        assert_eq!(cut.len(), 1 + 2);
        let Element::Line { points, .. } = &cut[0] else { panic!("{cut:?}") };
        assert!(points[0][1] == bottom && points[1][1] > top, "{points:?}");
        assert!(drawn(symbol, &[[2.0, 0.1, 0.05], [0.5, 3.0, 0.5]]).is_empty());
    }

    #[test]
    fn sheets_have_two_panels_in_a_row() {
        let panel = Panel::new("", Axis::linear("x", [0.0, 1.0]), Axis::linear("y", [0.0, 1.0]), Corner::TopLeft);
        let size =
            |title: &str, panels| drawing(&Figure { title: title.into(), panels: vec![panel.clone(); panels] }).size;
        assert_eq!(
            [size("", 0), size("", 1), size("", 2), size("", 3)],
            [[600, 480], [600, 480], [1200, 480], [1200, 960]]
        );
        assert_eq!(size("title", 1), [600, 520]);
    }
}
