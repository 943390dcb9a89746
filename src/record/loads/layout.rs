//! Where the views of a recording over loads stand: contacts on the left, figure, curves and text on the right.

use super::patches::PatchMap;
use super::{LOAD, LoadRecording, TEXT};
use crate::record::blueprint::{Blueprint, Clock, Kind, View};
use crate::record::layout::{Placed, gather, pictures};
use crate::record::stage::Stage;
use rerun::{RecordingStream, RecordingStreamResult};

/// Loads per second when they are played.
const PACE: f64 = 2.0;
/// Room of the contacts beside that of figure and curves.
const CONTACT: f32 = 1.3;

/// Writes the layout of `recording`.
pub fn send(recording: &LoadRecording, stream: &RecordingStream) -> RecordingStreamResult<()> {
    let mut blueprint = Blueprint::new(recording.recording.application())?;
    let mut panes = Vec::new();
    if let Some(contacts) = contacts(&mut blueprint, recording)? {
        panes.push((contacts, CONTACT));
    }
    panes.push((curves(&mut blueprint, recording)?, 1.0));
    let window = blueprint.container(Kind::Horizontal, "loads", panes)?;
    blueprint.send(vec![(window, 1.0)], Clock { timeline: LOAD, pace: PACE }, stream)
}

/// The pictures of each scene that has any, several as tabs.
fn contacts(blueprint: &mut Blueprint, recording: &LoadRecording) -> RecordingStreamResult<Option<String>> {
    let mut tabs = Vec::new();
    for (stage, map) in recording.recording.stages.iter().zip(&recording.patches) {
        if stage.what.has_pictures() {
            let map = map.iter().map(|map| patches(stage, map)).collect();
            tabs.push((pictures(blueprint, stage, map)?, 1.0));
        }
    }
    match tabs.as_slice() {
        [] => Ok(None),
        [(only, _)] => Ok(Some(only.clone())),
        _ => blueprint.container(Kind::Tabs, "contacts", tabs).map(Some),
    }
}

fn patches(stage: &Stage, map: &PatchMap) -> View {
    let contents = vec![format!("{}/**", map.root()), stage.caption_entity()];
    View::plane("Contact patches, load upwards", &stage.root, contents, map.bounds())
}

/// The panels of the figure, the first curves, and a stack of the other curves and the texts.
fn curves(blueprint: &mut Blueprint, recording: &LoadRecording) -> Placed {
    let mut rows = Vec::new();
    if let Some(figure) = &recording.figure {
        let panel =
            |(title, root, bounds): (&str, String, _)| View::plane(title, &root, vec![format!("{root}/**")], bounds);
        rows.push((gather(blueprint, Kind::Tabs, "figure", figure.panels().map(panel).collect())?, 2.0));
    }
    let curves = recording.curves.iter().flat_map(|curves| curves.views());
    let mut views = curves.map(|(title, entities)| View::curves(title, entities, None));
    if let Some(first) = views.next() {
        rows.push((blueprint.view(first)?, 1.0));
    }
    let load = View::text("Load", TEXT.into());
    let scenes = recording.recording.stages.iter().map(|stage| View::text(&stage.title, stage.description()));
    let tabs = views.chain([load]).chain(scenes).collect();
    rows.push((gather(blueprint, Kind::Tabs, "more", tabs)?, 1.0));
    blueprint.container(Kind::Vertical, "curves", rows)
}
