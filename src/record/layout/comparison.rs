//! The layout of a comparison: the curves of all runs together, and each recording in its own tab.

use super::blueprint::{PlayedTimeline, send};
use super::loads::chart;
use super::steps::FRAMES_PER_SEC;
use super::window::Sizes;
use crate::record::draw::{Chart, ContainerKind, Corner, PANE, Pane, PaneView};
use crate::record::options::WINDOW;
use rerun::{RecordingStream, RecordingStreamResult};

/// The number of curves that stand one above the other where none settles.
const FIRST: usize = 2;

/// Curves of one quantity.
pub(crate) struct Compared {
    pub title: String,
    pub entities: Vec<String>,
    /// The upper end of their axis, of those that settle at some value above zero.
    pub most: Option<f64>,
}

/// Writes the layout of curves over a timeline, a text about them and the `recordings`.
pub(crate) fn send_comparison(
    curves: Vec<Compared>,
    text: String,
    recordings: Vec<Pane>,
    timeline: &'static str,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let (mut settling, mut falling): (Vec<_>, Vec<_>) = curves.into_iter().partition(|curves| curves.most.is_some());
    if settling.is_empty() {
        settling = falling.drain(..falling.len().min(FIRST)).collect();
    }
    let mut falling = falling.into_iter().map(view);
    let first = falling.next().map(|first| (first, 1.0));
    let text = PaneView::text("Runs", text);
    let rest = Pane::even(ContainerKind::Tabs, "more", [text].into_iter().chain(falling).collect());
    let right = Pane::container(ContainerKind::Vertical, "curves", first.into_iter().chain([(rest, 1.0)]).collect());
    let left = Pane::even(ContainerKind::Vertical, "curves", settling.into_iter().map(view).collect());
    let comparison = Pane::even(ContainerKind::Horizontal, "Comparison", vec![left, right]);
    send(
        [comparison].into_iter().chain(recordings).collect(),
        PlayedTimeline { timeline, frames_per_sec: FRAMES_PER_SEC },
        stream,
    )
}

/// Writes the layout of charts over the quantity along the loads or states, of the same curves over their numbers, a text about them and the
/// `recordings`. The charts get the proportions of their panes.
pub(crate) fn send_load_comparison(
    charts: &mut [Chart],
    curves: Vec<Compared>,
    text: String,
    recordings: Vec<Pane>,
    timeline: &'static str,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let sizes = Sizes::new(&[of_charts(charts, Vec::new(), String::new()), PaneView::text("", String::new())], WINDOW);
    charts.iter_mut().for_each(|chart| chart.fit(sizes.get(&chart.root).unwrap_or(PANE)));
    let comparison = of_charts(charts, curves, text);
    let played = PlayedTimeline { timeline, frames_per_sec: FRAMES_PER_SEC };
    send([comparison].into_iter().chain(recordings).collect(), played, stream)
}

/// The first charts one above the other, and beside them the next one above the text, the other charts and the curves over numbers.
fn of_charts(charts: &[Chart], curves: Vec<Compared>, text: String) -> Pane {
    let mut charts = charts.iter().map(chart);
    let left = charts.by_ref().take(FIRST).collect();
    let next = charts.next();
    let numbered = curves.into_iter().map(|it| view(Compared { title: format!("{}, by number", it.title), ..it }));
    let rest = [PaneView::text("Runs", text)].into_iter().chain(charts).chain(numbered).collect();
    let right = next.into_iter().chain([Pane::even(ContainerKind::Tabs, "more", rest)]).collect();
    let columns = [left, right].map(|panes| Pane::even(ContainerKind::Vertical, "curves", panes));
    Pane::even(ContainerKind::Horizontal, "Comparison", columns.into())
}

fn view(Compared { title, entities, most }: Compared) -> Pane {
    match most {
        Some(most) => PaneView::settling(&title, entities, [0.0, most], Some(Corner::RightBottom)),
        None => PaneView::falling(&title, entities),
    }
}
