//! The layout of a comparison: the curves of all runs together, and each recording in its own tab.

use super::blueprint::{PlayedTimeline, send};
use super::steps::FRAMES_PER_SEC;
use crate::record::draw::{ContainerKind, Corner, Pane, PaneView};
use rerun::{RecordingStream, RecordingStreamResult};

/// The number of curves that stand one above the other where none settles.
const FIRST: usize = 2;

/// Curves of one quantity.
pub struct Compared {
    pub title: String,
    pub entities: Vec<String>,
    /// The upper end of their axis, of those that settle at some value above zero.
    pub most: Option<f64>,
}

/// Writes the layout of curves over a timeline, a text about them and the `recordings`.
pub fn send_comparison(
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

fn view(Compared { title, entities, most }: Compared) -> Pane {
    match most {
        Some(most) => PaneView::settling(&title, entities, [0.0, most], Some(Corner::RightBottom)),
        None => PaneView::falling(&title, entities),
    }
}
