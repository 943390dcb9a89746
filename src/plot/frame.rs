//! A frame: a box with two axes, their ticks, labels and names.

use super::axis::Axis;
use super::colour::Colour;
use super::font::width;
use super::sheet::{Align, Sheet, rectangle};

/// A box with two axes on a sheet.
#[derive(Debug, Clone)]
pub(crate) struct AxesFrame {
    pub x: Axis,
    pub y: Axis,
    /// Upper left corner of the box.
    pub corner: [f64; 2],
    /// Width and height of the box.
    pub size: [f64; 2],
    /// Size of the labels, by which ticks and distances are measured, too.
    pub text: f64,
}

/// A side of the box with an axis: the x axis below, the y axis to the left or to the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AxisSide {
    Below,
    Left,
    Right,
}

/// Width of the lines of box and ticks.
const LINE: f64 = 1.2;
const TICK: f64 = 0.4;
const MINOR_TICK: f64 = 0.23;
/// Size of the name of an axis, over that of its labels.
pub(crate) const NAME: f64 = 1.13;
/// The least room between neighbouring labels, side by side and one above the other, over their size.
const APART: [f64; 2] = [0.6, 0.25];

impl AxesFrame {
    /// Places of a point along both axes.
    pub(crate) fn places(&self, x: f64, y: f64) -> [f64; 2] {
        [self.x.place(x), self.y.place(y)]
    }

    /// The position on the sheet of places along both axes.
    pub(crate) fn position(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [[left, top], [width, height]] = [self.corner, self.size];
        [left + x * width, top + (1.0 - y) * height]
    }

    /// Draws pale lines across the box at the ticks that have labels.
    pub(crate) fn draw_grid(&self, sheet: &mut Sheet) {
        for (place, _) in self.labels(AxisSide::Below) {
            sheet.line([0.0, 1.0].map(|y| self.position([place, y])).to_vec(), Colour::PALE, 1.0);
        }
        for (place, _) in self.labels(AxisSide::Left) {
            sheet.line([0.0, 1.0].map(|x| self.position([x, place])).to_vec(), Colour::PALE, 1.0);
        }
    }

    /// Draws the box.
    pub(crate) fn draw_box(&self, sheet: &mut Sheet) {
        sheet.edge(&rectangle(self.corner, self.size), Colour::GREY, LINE);
    }

    /// Draws the ticks, labels and name of an axis.
    pub(crate) fn draw_axis(&self, sheet: &mut Sheet, side: AxisSide) {
        let (axis, align, distances, room) = match side {
            AxisSide::Below => (&self.x, Align::Middle, [1.2, 2.87], self.size[0]),
            AxisSide::Left => (&self.y, Align::Right, [0.6, 4.8], self.size[1]),
            AxisSide::Right => (&self.y, Align::Left, [0.6, 4.8], self.size[1]),
        };
        let tick =
            |place, length, width| (vec![self.beside(side, place, 0.0), self.beside(side, place, length)], width);
        let mut ticks = Vec::new();
        for (place, label) in self.labels(side) {
            sheet.words(&label, self.beside(side, place, distances[0]), self.text, align);
            ticks.push(tick(place, TICK, LINE));
        }
        ticks.extend(axis.minor_ticks().into_iter().map(|value| tick(edge(axis, value), MINOR_TICK, 1.0)));
        ticks.into_iter().for_each(|(points, width)| sheet.line(points, Colour::GREY, width));
        let name = self.beside(side, 0.5, distances[1]);
        sheet.fitted_words(&axis.name, name, NAME * self.text, room, side != AxisSide::Below);
    }

    /// The places and labels along a side: those of all ticks, or of every second, third and so on, so that neighbours are apart.
    pub(crate) fn labels(&self, side: AxisSide) -> Vec<(f64, String)> {
        let axis = if side == AxisSide::Below { &self.x } else { &self.y };
        let all: Vec<(f64, String)> =
            axis.ticks().into_iter().map(|(value, label)| (edge(axis, value), label)).collect();
        let length = |label: &str| if side == AxisSide::Below { width(label, self.text) } else { self.text };
        let (room, apart) = match side {
            AxisSide::Below => (self.size[0], APART[0] * self.text),
            AxisSide::Left | AxisSide::Right => (self.size[1], APART[1] * self.text),
        };
        let is_legible = |stride: &usize| {
            let shown: Vec<&(f64, String)> = all.iter().step_by(*stride).collect();
            shown.windows(2).all(|pair| {
                let between = (pair[1].0 - pair[0].0).abs() * room;
                between >= 0.5 * (length(&pair[0].1) + length(&pair[1].1)) + apart
            })
        };
        let stride = (1..all.len()).find(is_legible).unwrap_or(all.len().max(1));
        all.into_iter().step_by(stride).collect()
    }

    /// The position at `place` along a side and `out` sizes of a label outside the box.
    fn beside(&self, side: AxisSide, place: f64, out: f64) -> [f64; 2] {
        let out = out * self.text;
        let at = |places, [right, down]: [f64; 2]| {
            let [x, y] = self.position(places);
            [x + right, y + down]
        };
        match side {
            AxisSide::Below => at([place, 0.0], [0.0, out]),
            AxisSide::Left => at([0.0, place], [-out, 0.0]),
            AxisSide::Right => at([1.0, place], [out, 0.0]),
        }
    }
}

/// The place of a tick, which rounding may have put outside.
fn edge(axis: &Axis, value: f64) -> f64 {
    axis.place(value).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_labels_never_overlap_however_small_the_box_is() {
        let axes = [Axis::linear("x", [0.0, 0.012]), Axis::log("x", [1e-16, 3.0]), Axis::linear("x", [-8.0, 1234.0])];
        for (axis, length) in axes.iter().flat_map(|axis| [20.0, 60.0, 150.0, 400.0, 1000.0].map(|it| (axis, it))) {
            let frame =
                AxesFrame { x: axis.clone(), y: axis.clone(), corner: [0.0; 2], size: [length, length], text: 16.0 };
            for side in [AxisSide::Below, AxisSide::Left] {
                let labels = frame.labels(side);
                assert!(!labels.is_empty());
                for pair in labels.windows(2) {
                    let half = |label: &str| 0.5 * if side == AxisSide::Below { width(label, 16.0) } else { 16.0 };
                    let between = (pair[1].0 - pair[0].0).abs() * length;
                    assert!(between > half(&pair[0].1) + half(&pair[1].1), "{pair:?} on {length}");
                }
            }
        }
        let roomy =
            AxesFrame { x: axes[0].clone(), y: axes[0].clone(), corner: [0.0; 2], size: [1000.0; 2], text: 16.0 };
        assert_eq!(roomy.labels(AxisSide::Below).len(), axes[0].ticks().len());
    }
}
