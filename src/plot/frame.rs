//! A panel on the sheet: its frame, axes and titles.

use super::font::width;
use super::legend::draw_legend;
use super::series::draw_series;
use super::sheet::{Align, Sheet, rectangle};
use super::{Axis, Colour, Figure, Panel};

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
const AXIS_NAME: f64 = 17.0;
const LABEL: f64 = 15.0;

const TICK: f64 = 6.0;
const MINOR_TICK: f64 = 3.5;

impl Sheet {
    /// Draws `figure`.
    pub fn of(figure: &Figure) -> Self {
        let columns = figure.panels.len().clamp(1, IN_A_ROW);
        let rows = figure.panels.len().div_ceil(columns).max(1);
        let head = if figure.title.is_empty() { 0 } else { HEAD };
        let size = [columns as u32 * SIZE[0], head + rows as u32 * SIZE[1]];
        let mut sheet = Self { size, elements: Vec::new() };
        let middle = 0.5 * f64::from(size[0]);
        sheet.fitted_text(&figure.title, [middle, 0.6 * f64::from(head)], FIGURE_TITLE, 1.9 * middle, false);
        for (i, panel) in figure.panels.iter().enumerate() {
            let [column, row] = [i % columns, i / columns].map(|i| i as u32);
            let corner = [column * SIZE[0], head + row * SIZE[1]];
            Frame::of(panel, corner.map(f64::from)).draw(&mut sheet);
        }
        sheet
    }
}

/// The rectangle between the axes of a panel.
pub struct Frame<'a> {
    pub panel: &'a Panel,
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl<'a> Frame<'a> {
    /// The frame of a panel whose top left corner is at `[x, y]`.
    pub fn of(panel: &'a Panel, [x, y]: [f64; 2]) -> Self {
        let labels = panel.y.ticks().iter().map(|(_, label)| width(label, LABEL)).fold(LABELS, f64::max);
        let [left, above] = [NAME + labels, if panel.title.is_empty() { 0.5 * ABOVE } else { ABOVE }];
        let [width, height] = SIZE.map(f64::from);
        Self { panel, left: x + left, top: y + above, width: width - left - RIGHT, height: height - above - BELOW }
    }

    /// Places of a point along both axes.
    pub fn places(&self, x: f64, y: f64) -> [f64; 2] {
        [self.panel.x.place(x), self.panel.y.place(y)]
    }

    /// The position on the sheet of places along both axes.
    pub fn position(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.left + x * self.width, self.top + (1.0 - y) * self.height]
    }

    fn draw(&self, sheet: &mut Sheet) {
        self.draw_x_axis(sheet);
        self.draw_y_axis(sheet);
        let middle = self.left + 0.5 * self.width;
        sheet.fitted_text(&self.panel.title, [middle, self.top - 0.5 * ABOVE], PANEL_TITLE, self.width, false);
        self.panel.series.iter().for_each(|series| draw_series(sheet, self, series));
        let corners = rectangle([self.left, self.top], [self.left + self.width, self.top + self.height]);
        sheet.edge(&corners, Colour::GREY, 1.2);
        draw_legend(sheet, self);
    }

    fn draw_x_axis(&self, sheet: &mut Sheet) {
        let bottom = self.top + self.height;
        let at = |place: f64| self.left + place * self.width;
        for (place, label) in labels(&self.panel.x) {
            sheet.line(vec![[at(place), self.top], [at(place), bottom]], Colour::PALE, 1.0);
            sheet.line(vec![[at(place), bottom], [at(place), bottom + TICK]], Colour::GREY, 1.2);
            sheet.text(&label, [at(place), bottom + 18.0], LABEL, Align::Middle);
        }
        for place in minors(&self.panel.x) {
            sheet.line(vec![[at(place), bottom], [at(place), bottom + MINOR_TICK]], Colour::GREY, 1.0);
        }
        sheet.fitted_text(&self.panel.x.name, [at(0.5), bottom + 43.0], AXIS_NAME, self.width, false);
    }

    fn draw_y_axis(&self, sheet: &mut Sheet) {
        let left = self.left;
        let at = |place: f64| self.top + (1.0 - place) * self.height;
        for (place, label) in labels(&self.panel.y) {
            sheet.line(vec![[left, at(place)], [left + self.width, at(place)]], Colour::PALE, 1.0);
            sheet.line(vec![[left, at(place)], [left - TICK, at(place)]], Colour::GREY, 1.2);
            sheet.text(&label, [left - 9.0, at(place)], LABEL, Align::Right);
        }
        for place in minors(&self.panel.y) {
            sheet.line(vec![[left, at(place)], [left - MINOR_TICK, at(place)]], Colour::GREY, 1.0);
        }
        let name = [left - LABELS - 18.0, at(0.5)];
        sheet.fitted_text(&self.panel.y.name, name, AXIS_NAME, self.height, true);
    }
}

fn labels(axis: &Axis) -> Vec<(f64, String)> {
    axis.ticks().into_iter().map(|(value, label)| (axis.place(value).clamp(0.0, 1.0), label)).collect()
}

fn minors(axis: &Axis) -> Vec<f64> {
    axis.minor_ticks().into_iter().map(|value| axis.place(value).clamp(0.0, 1.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sheet::Element;
    use super::super::{Corner, Mark, Point, Series, Symbol};
    use super::*;

    const ODD: Colour = Colour([1, 2, 3]);

    /// What a series without a name adds to a panel from 0 to 1 (linear) and from 1e-2 to 1 (logarithmic).
    fn drawn(mark: Mark, points: &[[f64; 3]]) -> Vec<Element> {
        let points = points.iter().map(|&[x, y, spread]| Point { x, y, spread }).collect();
        let [x, y] = [Axis::linear("x", [0.0, 1.0]), Axis::log("y", [1e-2, 1.0])];
        let mut panel = Panel::new("", x, y, Corner::TopLeft);
        panel.series.push(Series::new("", ODD, mark, points));
        let sheet = Sheet::of(&Figure { title: String::new(), panels: vec![panel] });
        let is_odd = |element: &Element| match element {
            Element::Line { colour, .. } | Element::Shape { colour, .. } => *colour == ODD,
            Element::Text { .. } => false,
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
            |title: &str, panels| Sheet::of(&Figure { title: title.into(), panels: vec![panel.clone(); panels] }).size;
        assert_eq!(
            [size("", 0), size("", 1), size("", 2), size("", 3)],
            [[600, 480], [600, 480], [1200, 480], [1200, 960]]
        );
        assert_eq!(size("title", 1), [600, 520]);
    }
}
