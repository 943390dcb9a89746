//! The layout of a surface: its relief above a text on the left, the figure on the right.

use super::blueprint::{PlayedTimeline, send};
use super::window::Sizes;
use crate::record::draw::{ContainerKind, Eye, FigurePicture, Pane, PaneView, STEP, SurfaceRelief};
use rerun::{RecordingStream, RecordingStreamResult};

/// Gives relief and figure the proportions of their panes in a window.
pub(crate) fn fit_survey(relief: Option<&mut SurfaceRelief>, figure: &mut FigurePicture, text: &str, window: [f64; 2]) {
    let sizes = Sizes::new(&[layout(relief.as_ref().map(|relief| relief.view()), figure, text)], window);
    figure.fit(|root| sizes.get(root));
    if let Some(relief) = relief
        && let Some(size) = sizes.get(relief.view().0)
    {
        relief.fit(size);
    }
}

/// Writes the layout of a relief as an eye sees it, if there is one, a figure, and a text at `text`.
pub(crate) fn send_survey(
    relief: Option<(&str, Eye)>,
    figure: &FigurePicture,
    text: &str,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    send(vec![layout(relief, figure, text)], PlayedTimeline { timeline: STEP, frames_per_sec: 1.0 }, stream)
}

fn layout(relief: Option<(&str, Eye)>, figure: &FigurePicture, text: &str) -> Pane {
    let palette = figure.palette;
    let panels = figure.panels().map(|(title, root, bounds)| {
        PaneView::plane(title, &root, vec![format!("{root}/**")], (root.clone(), bounds), palette)
    });
    let mut panels: Vec<Pane> = panels.collect();
    let heights = relief.map_or_else(|| panels.remove(0), |relief| PaneView::space("Heights", relief, palette));
    let left = vec![(heights, 2.0), (PaneView::text("Description", text.into()), 1.0)];
    let left = Pane::container(ContainerKind::Vertical, "heights", left);
    let right = Pane::even(ContainerKind::Vertical, "figure", panels);
    Pane::container(ContainerKind::Horizontal, "surface", vec![(left, 1.3), (right, 1.0)])
}
