//! The layout of a surface: its relief on the left, figure and text on the right.

use super::blueprint::{Kind, Pane, View, send};
use crate::record::draw::{FigurePicture, STEP};
use rerun::{RecordingStream, RecordingStreamResult};

/// Writes the layout of the relief at `relief`, if there is one, a figure, and a text at `text`.
pub fn send_survey(
    relief: Option<&str>,
    figure: &FigurePicture,
    text: &str,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let palette = figure.palette;
    let space = |root: &str| View::space("Heights", root, vec![format!("{root}/**")], [4.8, -10.4, 7.2], palette);
    let panels = figure.panels();
    let panels =
        panels.map(|(title, root, bounds)| View::plane(title, &root, vec![format!("{root}/**")], bounds, palette));
    let mut panels: Vec<Pane> = panels.collect();
    let left = relief.map_or_else(|| panels.remove(0), space);
    panels.push(View::text("Description", text.into()));
    let right = Pane::even(Kind::Vertical, "figure", panels);
    let panes = vec![(left, 1.4), (right, 1.0)];
    send(vec![Pane::container(Kind::Horizontal, "surface", panes)], (STEP, 1.0), Some(palette), stream)
}
