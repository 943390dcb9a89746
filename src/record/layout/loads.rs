//! The layout of a recording over loads: contacts on the left, figure, charts and text on the right.

use super::blueprint::{Kind, Pane, View, send};
use super::steps::pictures;
use crate::record::draw::{Chart, Curves, FigurePicture, LOAD, Stage};
use rerun::{RecordingStream, RecordingStreamResult};

/// Entity of the text about the current load.
pub const TEXT: &str = "/load";
/// Loads per second when they are played.
const LOADS_PER_SEC: f64 = 2.0;
/// Room of the contacts beside that of figure and charts.
const CONTACT: f32 = 1.3;
/// Charts with a row of their own, unless there is a figure.
const ROWS: usize = 2;

/// Writes the layout of scenes, a figure and curves over the loads.
pub fn send_loads(
    stages: &[Stage],
    figure: Option<&FigurePicture>,
    charts: &[Chart],
    curves: &Curves,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let contacts: Vec<Pane> = stages.iter().filter(|stage| stage.what.has_pictures()).map(pictures).collect();
    let contacts = (!contacts.is_empty()).then(|| (Pane::even(Kind::Tabs, "contacts", contacts), CONTACT));
    let mut rows = rows(figure, charts.iter().map(chart).collect());
    rows.push((Pane::even(Kind::Tabs, "more", texts(stages, curves)), 1.0));
    let panes = contacts.into_iter().chain([(Pane::container(Kind::Vertical, "curves", rows), 1.0)]).collect();
    let palette = charts.first().map(|chart| chart.palette).or(stages.first().map(|stage| stage.palette));
    send(vec![Pane::container(Kind::Horizontal, "loads", panes)], (LOAD, LOADS_PER_SEC), palette, stream)
}

/// The panels of the figure above all charts in one row, or charts in rows of their own.
fn rows(figure: Option<&FigurePicture>, mut charts: Vec<Pane>) -> Vec<(Pane, f32)> {
    let Some(figure) = figure else {
        let others = charts.split_off(ROWS.min(charts.len()));
        let others = (!others.is_empty()).then(|| Pane::even(Kind::Tabs, "charts", others));
        return charts.into_iter().chain(others).map(|chart| (chart, 1.0)).collect();
    };
    let panels = figure
        .panels()
        .map(|(title, root, bounds)| View::plane(title, &root, vec![format!("{root}/**")], bounds, figure.palette));
    let charts = (!charts.is_empty()).then(|| (Pane::even(Kind::Tabs, "charts", charts), 1.0));
    [(Pane::even(Kind::Tabs, "figure", panels.collect()), 2.0)].into_iter().chain(charts).collect()
}

fn chart(chart: &Chart) -> Pane {
    View::plane(&chart.title(), &chart.root, vec![format!("{}/**", chart.root)], chart.bounds(), chart.palette)
}

/// The text of the current load, the scenes, and the curves against the number of the load, where a click picks one.
fn texts(stages: &[Stage], curves: &Curves) -> Vec<Pane> {
    let scenes = stages.iter().map(|stage| View::text(&stage.title, stage.description()));
    let numbered = curves.views().into_iter();
    let numbered = numbered.map(|(title, entities)| View::falling(&format!("{title}, load by load"), entities));
    [View::text("Load", TEXT.into())].into_iter().chain(scenes).chain(numbered).collect()
}
