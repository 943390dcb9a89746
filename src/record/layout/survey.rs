//! The layout of a surface: its relief above a text on the left, the figure on the right.

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
    let heights = relief.map_or_else(|| panels.remove(0), space);
    let left = vec![(heights, 2.0), (View::text("Description", text.into()), 1.0)];
    let left = Pane::container(Kind::Vertical, "heights", left);
    let right = Pane::even(Kind::Vertical, "figure", panels);
    let panes = vec![(left, 1.3), (right, 1.0)];
    send(vec![Pane::container(Kind::Horizontal, "surface", panes)], (STEP, 1.0), Some(palette), stream)
}
