//! The panels of a figure, drawn as on paper but on the background of the recording, with a cursor at the current load.

use crate::plot::{Align, Figure, Panel, Sheet, drawing_of, frame_in};
use crate::record::draw::ink::canvas::{self, PANE};
use crate::record::draw::ink::palette::{Palette, colour};
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Room above a panel for the current load.
const HEAD: f64 = 14.0;
/// Size of the text that shows the current load.
const TEXT: f64 = 16.0;

/// The panels of a figure and the places of the loads along their x axes.
pub(crate) struct FigurePicture {
    /// Panels, each with the title of its view and the size of its pane.
    panels: Vec<(String, Panel, [f64; 2])>,
    pub palette: &'static Palette,
    cursor: Vec<f64>,
}

impl FigurePicture {
    /// The picture of `figure`, with the loads at `cursor`. Views have the titles of their panels, that of a single one the
    /// title of the figure.
    pub(crate) fn new(figure: &Figure, cursor: Vec<f64>, palette: &'static Palette) -> Self {
        let is_single = figure.panels.len() == 1 && !figure.title.is_empty();
        let title =
            |panel: &Panel| if is_single || panel.title.is_empty() { &figure.title } else { &panel.title }.clone();
        let untitled = |panel: &Panel| Panel { title: String::new(), ..panel.clone() };
        let panels = figure.panels.iter().map(|panel| (title(panel), untitled(panel), PANE)).collect();
        Self { panels, palette, cursor }
    }

    /// Title, root and the part of the canvas of each panel.
    pub(crate) fn panels(&self) -> impl Iterator<Item = (&str, String, [f64; 4])> {
        let panels = self.panels.iter().enumerate();
        panels.map(|(i, (title, _, [width, height]))| (title.as_str(), root(i), [0.0, *width, 0.0, *height]))
    }

    /// Gives each panel the proportions of its pane, whose size in points `pane` returns for the root of the panel.
    pub(crate) fn fit(&mut self, pane: impl Fn(&str) -> Option<[f64; 2]>) {
        for (i, (_, _, size)) in self.panels.iter_mut().enumerate() {
            *size = pane(&root(i)).unwrap_or(*size);
        }
    }

    /// Records all but the cursor.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let mut panels = self.panels.iter().enumerate();
        panels.try_for_each(|(i, (_, panel, size))| canvas::log_sheet(to, self.palette, &root(i), &sheet(panel, *size)))
    }

    /// Records the cursor at load number `load` and its caption, at the current time.
    pub(crate) fn log_cursor(&self, to: &RecordingStream, load: usize, caption: &str) -> RecordingStreamResult<()> {
        let at = self.cursor.get(load).copied().unwrap_or(f64::NAN);
        for (i, (_, panel, [width, height])) in self.panels.iter().enumerate() {
            let frame = frame_in(panel, [0.0, HEAD], [*width, height - HEAD]);
            let place = panel.x.place(at);
            let upright = [0.0, 1.0].map(|y| frame.position([place, y]).map(|p| p as f32)).to_vec();
            let upright = (upright, colour(self.palette.ink), Radius::new_ui_points(1.0));
            let upright = (0.0..=1.0).contains(&place).then_some(upright);
            to.log(format!("{}/cursor", root(i)), &canvas::strips(upright).with_draw_order(21.0))?;
            let mut words = Sheet::default();
            words.words(caption, [frame.position([0.5, 0.0])[0], HEAD], TEXT, Align::Middle);
            to.log(format!("{}/caption", root(i)), &canvas::written(self.palette, &words))?;
        }
        Ok(())
    }
}

/// A panel below the room for the current load.
fn sheet(panel: &Panel, [width, height]: [f64; 2]) -> Sheet {
    drawing_of(panel, [0.0, HEAD], [width, height - HEAD])
}

/// The root of the entities of a panel.
fn root(panel: usize) -> String {
    format!("/figure/{panel}")
}
