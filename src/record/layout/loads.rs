//! The layout of a recording over loads: contacts on the left, figure, charts and text on the right.

use super::blueprint::{PlayedTimeline, send};
use super::steps::{pictures, width};
use super::window::Sizes;
use crate::record::draw::{Chart, ContainerKind, Curves, FigurePicture, PANE, Pane, PaneView, Stage};
use rerun::{RecordingStream, RecordingStreamResult};

/// Entity of the text about the current load.
pub(crate) const TEXT: &str = "/load";
/// Loads per second when they are played.
const LOADS_PER_SEC: f64 = 2.0;
/// Room of the contacts of lines beside that of figure and charts.
const CONTACT: f32 = 1.3;
/// Charts with a row of their own, unless there is a figure.
const ROWS: usize = 2;

/// Gives the pictures of scenes, figure and charts the proportions of their panes in a window.
pub(crate) fn fit_loads(
    stages: &mut [Stage],
    figure: Option<&mut FigurePicture>,
    charts: &mut [Chart],
    curves: &Curves,
    window: [f64; 2],
) {
    let sizes = Sizes::new(&[layout(stages, figure.as_deref(), charts, curves)], window);
    stages.iter_mut().for_each(|stage| stage.fit(|root| sizes.get(root)));
    figure.into_iter().for_each(|figure| figure.fit(|root| sizes.get(root)));
    for chart in charts {
        chart.fit(sizes.get(&chart.root).unwrap_or(PANE));
    }
}

/// Gives charts the proportions of their panes in a window, beside scenes whose pictures keep theirs.
pub(crate) fn fit_charts(stages: &[Stage], charts: &mut [Chart], curves: &Curves, window: [f64; 2]) {
    let sizes = Sizes::new(&[layout(stages, None, charts, curves)], window);
    for chart in charts {
        chart.fit(sizes.get(&chart.root).unwrap_or(PANE));
    }
}

/// Writes the layout of scenes, a figure and curves over the loads.
pub(crate) fn send_loads(
    stages: &[Stage],
    figure: Option<&FigurePicture>,
    charts: &[Chart],
    curves: &Curves,
    timeline: &'static str,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    send(
        vec![layout(stages, figure, charts, curves)],
        PlayedTimeline { timeline, frames_per_sec: LOADS_PER_SEC },
        stream,
    )
}

fn layout(stages: &[Stage], figure: Option<&FigurePicture>, charts: &[Chart], curves: &Curves) -> Pane {
    let is_line = stages.iter().all(|stage| stage.grid.is_line());
    let room = stages.first().filter(|_| !is_line).map_or(CONTACT, width);
    let contacts: Vec<Pane> = stages.iter().filter(|stage| stage.what.has_pictures()).map(pictures).collect();
    let contacts = (!contacts.is_empty()).then(|| (Pane::even(ContainerKind::Tabs, "contacts", contacts), room));
    let (mut rows, others) = rows(figure, charts.iter().map(chart).collect());
    let texts = texts(stages, curves);
    let load = PaneView::text("Values", TEXT.into());
    let more = [load].into_iter().chain(others).chain(texts).collect();
    rows.push((Pane::even(ContainerKind::Tabs, "more", more), 1.0));
    let panes = contacts.into_iter().chain([(Pane::container(ContainerKind::Vertical, "curves", rows), 1.0)]).collect();
    Pane::container(ContainerKind::Horizontal, "loads", panes)
}

/// The panels of the figure above all charts in one row, or the first charts in rows of their own, and the other charts.
fn rows(figure: Option<&FigurePicture>, mut charts: Vec<Pane>) -> (Vec<(Pane, f32)>, Vec<Pane>) {
    let Some(figure) = figure else {
        let others = charts.split_off(ROWS.min(charts.len()));
        return (charts.into_iter().map(|chart| (chart, 1.0)).collect(), others);
    };
    let panels = figure.panels().map(|(title, root, bounds)| {
        PaneView::plane(title, &root, vec![format!("{root}/**")], (root.clone(), bounds), figure.palette)
    });
    let charts = (!charts.is_empty()).then(|| (Pane::even(ContainerKind::Tabs, "charts", charts), 1.0));
    let rows = [(Pane::even(ContainerKind::Tabs, "figure", panels.collect()), 2.0)].into_iter().chain(charts);
    (rows.collect(), Vec::new())
}

/// The view of a chart.
pub(crate) fn chart(chart: &Chart) -> Pane {
    let picture = (chart.root.clone(), chart.bounds());
    PaneView::plane(&chart.title(), &chart.root, vec![format!("{}/**", chart.root)], picture, chart.palette)
}

/// The scenes in words, and the curves against the number of the load, where a click picks one.
fn texts(stages: &[Stage], curves: &Curves) -> Vec<Pane> {
    let scenes = stages.iter().map(|stage| PaneView::text(&stage.title, stage.description()));
    let numbered = curves.views().into_iter();
    let numbered = numbered.map(|(title, entities)| PaneView::falling(&format!("{title}, load by load"), entities));
    scenes.chain(numbered).collect()
}
