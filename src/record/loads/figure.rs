//! The panels of a figure, drawn as on paper but on the dark ground, with a cursor at the current load.

use crate::plot::{Align, Element, Figure, Frame, Panel, Sheet, width};
use crate::record::axes;
use crate::record::palette::{self, colour};
use crate::record::scene::range;
use rerun::{Color, LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// Root of its entities.
const ROOT: &str = "/figure";
/// Room above a panel for the name of its y axis, which cannot stand upright here.
const HEAD: f64 = 26.0;
/// From the middle of a text up to its place, over its size: the viewer hangs words below their places.
const RISE: f64 = 0.72;
/// Size of a text as the viewer shows it, over the canvas at its usual size.
const TEXT: f64 = 15.0;
/// From line to line of what fills a shape.
const HATCH: f64 = 1.0;
/// Half the width of these lines, which overlap.
const HALF: f64 = 0.7;

/// The panels of a figure and the places of the loads along their x axes.
pub struct FigurePicture {
    title: String,
    panels: Vec<Panel>,
    cursor: Vec<f64>,
}

/// A strip, its colour and its radius.
type Strip = (Vec<[f32; 2]>, Color, Radius);

impl FigurePicture {
    /// The picture of `figure`, with the loads at `cursor`.
    pub fn new(figure: &Figure, cursor: Vec<f64>) -> Self {
        Self { title: figure.title.clone(), panels: figure.panels.clone(), cursor }
    }

    /// Title, root and the part of the canvas of each panel.
    pub fn panels(&self) -> impl Iterator<Item = (&str, String, [f64; 4])> {
        self.panels.iter().enumerate().map(|(i, panel)| {
            let is_alone = self.panels.len() == 1 && !self.title.is_empty();
            let title = if is_alone || panel.title.is_empty() { &self.title } else { &panel.title };
            let [right, bottom] = sheet(panel).size.map(f64::from);
            (title.as_str(), root(i), [0.0, right, -HEAD, bottom])
        })
    }

    /// Records all but the cursor.
    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        for (i, panel) in self.panels.iter().enumerate() {
            let Sheet { elements, .. } = sheet(panel);
            to.log_static(format!("{}/drawing", root(i)), &strips(elements.iter().filter_map(strip)))?;
            to.log_static(format!("{}/words", root(i)), &axes::labels(elements.iter().filter_map(words).collect()))?;
        }
        Ok(())
    }

    /// Records the cursor at load number `load` and what it stands for, at the current time.
    pub fn log_cursor(&self, to: &RecordingStream, load: usize, caption: &str) -> RecordingStreamResult<()> {
        let at = self.cursor.get(load).copied().unwrap_or(f64::NAN);
        for (i, panel) in self.panels.iter().enumerate() {
            let frame = Frame::of(panel, [0.0, 0.0]);
            let place = panel.x.place(at);
            let upright = [0.0, 1.0].map(|y| frame.position([place, y]).map(|p| p as f32)).to_vec();
            let upright =
                (0.0..=1.0).contains(&place).then_some((upright, colour(palette::INK), Radius::new_ui_points(1.0)));
            to.log(format!("{}/cursor", root(i)), &strips(upright).with_draw_order(1.0))?;
            let words = ([(frame.left + 0.7 * frame.width) as f32, -HEAD as f32], caption.to_owned());
            to.log(format!("{}/caption", root(i)), &axes::labels(vec![words]))?;
        }
        Ok(())
    }
}

fn root(panel: usize) -> String {
    format!("{ROOT}/{panel}")
}

/// The sheet of a panel alone.
fn sheet(panel: &Panel) -> Sheet {
    Sheet::of(&Figure { title: String::new(), panels: vec![panel.clone()] })
}

/// A line, or what fills a shape.
fn strip(element: &Element) -> Option<Strip> {
    match element {
        Element::Line { points, colour, width } => {
            let points = points.iter().map(|point| point.map(|p| p as f32)).collect();
            Some((points, palette::on_ground(colour.0), Radius::new_ui_points(0.5 * *width as f32)))
        }
        Element::Shape { corners, colour, .. } => {
            let radius = Radius::new_scene_units(HALF as f32);
            Some((hatch(corners), palette::on_ground(colour.0), radius))
        }
        Element::Text { .. } => None,
    }
}

fn strips(strips: impl IntoIterator<Item = Strip>) -> LineStrips2D {
    let (mut points, mut colours, mut radii) = (Vec::new(), Vec::new(), Vec::new());
    for (strip, colour, radius) in strips {
        points.push(strip);
        colours.push(colour);
        radii.push(radius);
    }
    LineStrips2D::new(points).with_colors(colours).with_radii(radii)
}

/// A text and where its upper edge has its middle; what reads upwards stands above the panel instead.
fn words(element: &Element) -> Option<([f32; 2], String)> {
    let Element::Text { text, at: [x, y], size, align, upwards } = element else { return None };
    let half = 0.5 * width(text, TEXT);
    let [x, y] = match align {
        _ if *upwards => [half.max(*x), -HEAD],
        Align::Left => [x + half, y - RISE * size],
        Align::Middle => [*x, y - RISE * size],
        Align::Right => [x - half, y - RISE * size],
    };
    (!text.is_empty()).then(|| ([x as f32, y as f32], text.clone()))
}

/// A line up and down across a convex shape, whose width stays inside.
fn hatch(corners: &[[f64; 2]]) -> Vec<[f32; 2]> {
    let [left, right] = ends(corners.iter().map(|corner| corner[0]));
    let bars = ((right - left) / HATCH).ceil().max(1.0) as usize;
    let ends = |i: usize| {
        let x = left + (i as f64 + 0.5) / bars as f64 * (right - left);
        let [top, bottom] = ends(sides(corners).filter_map(|side| crossing(side, x)));
        let reach = (0.5 * (bottom - top) - HALF).max(0.0) * if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        [-reach, reach].map(|reach| [x, top.midpoint(bottom) + reach])
    };
    (0..bars).flat_map(ends).map(|point| point.map(|p| p as f32)).collect()
}

/// The sides of a shape.
fn sides(corners: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(from, to)| [*from, *to])
}

/// How far down a side crosses the vertical at `x`.
fn crossing([from, to]: [[f64; 2]; 2], x: f64) -> Option<f64> {
    let share = (x - from[0]) / (to[0] - from[0]);
    (0.0..=1.0).contains(&share).then(|| from[1] + share * (to[1] - from[1]))
}

fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) = range(values);
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Corner};

    #[test]
    fn shapes_are_filled_from_side_to_side() {
        let line = hatch(&[[0.0, 0.0], [12.0, 0.0], [12.0, 6.0], [0.0, 6.0]]);
        assert_eq!(line.len(), 2 * 12);
        for (point, expected) in line.iter().zip([[0.5, 0.7], [0.5, 5.3], [1.5, 5.3], [1.5, 0.7]]) {
            assert!((0..2).all(|i| (f64::from(point[i]) - expected[i]).abs() < 1e-5), "{line:?}");
        }
        let triangle = hatch(&[[0.0, 0.0], [3.0, 3.0], [0.0, 3.0]]);
        assert!(triangle.len() == 2 * 3 && triangle.iter().all(|[x, y]| (*x..3.0).contains(y)), "{triangle:?}");
    }

    #[test]
    fn all_words_of_a_panel_are_there_and_those_of_the_y_axis_above_it() {
        let (x, y) = (Axis::linear("across", [0.0, 1.0]), Axis::linear("up", [0.0, 1.0]));
        let panel = Panel::new("title", x, y, Corner::TopLeft);
        let all: Vec<_> = sheet(&panel).elements.iter().filter_map(words).collect();
        for word in ["title", "across", "0.2"] {
            assert!(all.iter().any(|([_, y], words)| words == word && *y > -HEAD as f32), "{word}");
        }
        assert!(all.iter().any(|([_, y], words)| words == "up" && *y == -HEAD as f32));
    }
}
