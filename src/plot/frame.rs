//! A panel on the sheet: its frame, axes and titles.

use super::font::width;
use super::legend::draw_legend;
use super::series::draw_series;
use super::sheet::{Align, Sheet, around, rectangle};
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
        sheet.line(around(&corners), Colour::GREY, 1.2);
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
