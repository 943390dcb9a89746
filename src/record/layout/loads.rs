//! The layout of a recording over loads: contacts on the left, figure, curves and text on the right.

use super::blueprint::{Kind, Pane, View, send};
use super::steps::pictures;
use crate::record::draw::{Curves, FigurePicture, Stage};
use rerun::{RecordingStream, RecordingStreamResult};

/// Timeline of loads.
pub const LOAD: &str = "load";
/// Entity of the text about the current load.
pub const TEXT: &str = "/load";
/// Loads per second when they are played.
const LOADS_PER_SEC: f64 = 2.0;
/// Room of the contacts beside that of figure and curves.
const CONTACT: f32 = 1.3;

/// Writes the layout of scenes, a figure and curves over the loads.
pub fn send_loads(
    stages: &[Stage],
    figure: Option<&FigurePicture>,
    curves: &Curves,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let contacts: Vec<Pane> = stages.iter().filter(|stage| stage.what.has_pictures()).map(pictures).collect();
    let contacts = (!contacts.is_empty()).then(|| (Pane::even(Kind::Tabs, "contacts", contacts), CONTACT));
    let panes = contacts.into_iter().chain([(charts(stages, figure, curves), 1.0)]).collect();
    send(vec![Pane::container(Kind::Horizontal, "loads", panes)], (LOAD, LOADS_PER_SEC), stream)
}

/// The panels of the figure, the first curves, and a stack of the other curves and the texts.
fn charts(stages: &[Stage], figure: Option<&FigurePicture>, curves: &Curves) -> Pane {
    let mut rows = Vec::new();
    if let Some(figure) = figure {
        let panels = figure.panels();
        let panels = panels.map(|(title, root, bounds)| View::plane(title, &root, vec![format!("{root}/**")], bounds));
        rows.push((Pane::even(Kind::Tabs, "figure", panels.collect()), 2.0));
    }
    let views = curves.views().into_iter();
    let mut views = views.map(|(title, entities)| View::falling(title, entities));
    rows.extend(views.next().map(|first| (first, 1.0)));
    let load = View::text("Load", TEXT.into());
    let scenes = stages.iter().map(|stage| View::text(&stage.title, stage.description()));
    rows.push((Pane::even(Kind::Tabs, "more", views.chain([load]).chain(scenes).collect()), 1.0));
    Pane::container(Kind::Vertical, "curves", rows)
}
