//! The panels of a figure, drawn as on paper but on the ground of the recording, with a cursor at the current load.

use super::canvas;
use super::palette::{Palette, colour};
use crate::plot::{Figure, Panel, drawing, frame_of};
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Room above a panel for the name of its y axis and the current load.
const HEAD: f64 = 26.0;

/// The panels of a figure and the places of the loads along their x axes.
pub struct FigurePicture {
    /// Panels, each with the title of its view.
    panels: Vec<(String, Panel)>,
    pub palette: &'static Palette,
    cursor: Vec<f64>,
}

impl FigurePicture {
    /// The picture of `figure`, with the loads at `cursor`. Views have the titles of their panels, that of a single one the
    /// title of the figure.
    pub fn new(figure: &Figure, cursor: Vec<f64>, palette: &'static Palette) -> Self {
        let is_single = figure.panels.len() == 1 && !figure.title.is_empty();
        let title =
            |panel: &Panel| if is_single || panel.title.is_empty() { &figure.title } else { &panel.title }.clone();
        let untitled = |panel: &Panel| Panel { title: String::new(), ..panel.clone() };
        let panels = figure.panels.iter().map(|panel| (title(panel), untitled(panel))).collect();
        Self { panels, palette, cursor }
    }

    /// Title, root and the part of the canvas of each panel.
    pub fn panels(&self) -> impl Iterator<Item = (&str, String, [f64; 4])> {
        self.panels.iter().enumerate().map(|(i, (title, panel))| {
            let [right, bottom] = drawing(&alone(panel)).size.map(f64::from);
            (title.as_str(), root(i), [0.0, right, -HEAD, bottom])
        })
    }

    /// Records all but the cursor.
    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let mut panels = self.panels.iter().enumerate();
        panels.try_for_each(|(i, (_, panel))| {
            canvas::log_sheet(to, self.palette, &root(i), &drawing(&alone(panel)), -HEAD)
        })
    }

    /// Records the cursor at load number `load` and its caption, at the current time.
    pub fn log_cursor(&self, to: &RecordingStream, load: usize, caption: &str) -> RecordingStreamResult<()> {
        let at = self.cursor.get(load).copied().unwrap_or(f64::NAN);
        for (i, (_, panel)) in self.panels.iter().enumerate() {
            let frame = frame_of(panel, [0.0, 0.0]);
            let place = panel.x.place(at);
            let upright = [0.0, 1.0].map(|y| frame.position([place, y]).map(|p| p as f32)).to_vec();
            let upright = (upright, colour(self.palette.ink), Radius::new_ui_points(1.0));
            let upright = (0.0..=1.0).contains(&place).then_some(upright);
            to.log(format!("{}/cursor", root(i)), &canvas::strips(upright).with_draw_order(21.0))?;
            let [x, _] = frame.position([0.7, 0.0]);
            let words = ([x as f32, -HEAD as f32], caption.to_owned());
            to.log(format!("{}/caption", root(i)), &canvas::labels(self.palette, vec![words]))?;
        }
        Ok(())
    }
}

/// The root of the entities of a panel.
fn root(panel: usize) -> String {
    format!("/figure/{panel}")
}

fn alone(panel: &Panel) -> Figure {
    Figure { title: String::new(), panels: vec![panel.clone()] }
}
