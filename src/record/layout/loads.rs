//! The layout of a recording over loads: contacts on the left, figure, curves and text on the right.

use super::blueprint::{Blueprint, Clock, Kind, View};
use super::steps::{Placed, gather, pictures};
use crate::record::draw::{Curves, FigurePicture, PatchMap, Stage};
use rerun::external::re_log_types::ApplicationId;
use rerun::{RecordingStream, RecordingStreamResult};

/// Loads per second when they are played.
const LOADS_PER_SEC: f64 = 2.0;
/// Room of the contacts beside that of figure and curves.
const CONTACT: f32 = 1.3;

/// The drawings of a recording over loads.
pub struct Panes<'a> {
    /// Timeline of the loads.
    pub timeline: &'static str,
    /// Entity of the text about the current load.
    pub text: &'static str,
    /// Scenes.
    pub stages: &'a [Stage],
    /// Map of patches of each scene that has one.
    pub patches: &'a [Option<PatchMap>],
    /// Figure.
    pub figure: Option<&'a FigurePicture>,
    /// Curves over the loads.
    pub curves: Option<&'a Curves>,
}

/// Writes the layout of `shown`.
pub fn send_loads(
    application: ApplicationId,
    shown: &Panes<'_>,
    stream: &RecordingStream,
) -> RecordingStreamResult<()> {
    let mut blueprint = Blueprint::new(application)?;
    let mut panes = Vec::new();
    if let Some(contacts) = contacts(&mut blueprint, shown)? {
        panes.push((contacts, CONTACT));
    }
    panes.push((curves(&mut blueprint, shown)?, 1.0));
    let window = blueprint.container(Kind::Horizontal, "loads", panes)?;
    blueprint.send(vec![(window, 1.0)], Clock { timeline: shown.timeline, frames_per_sec: LOADS_PER_SEC }, stream)
}

/// The pictures of each scene that has any, several as tabs.
fn contacts(blueprint: &mut Blueprint, shown: &Panes<'_>) -> RecordingStreamResult<Option<String>> {
    let mut tabs = Vec::new();
    for (stage, map) in shown.stages.iter().zip(shown.patches) {
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
fn curves(blueprint: &mut Blueprint, shown: &Panes<'_>) -> Placed {
    let mut rows = Vec::new();
    if let Some(figure) = shown.figure {
        let panel =
            |(title, root, bounds): (&str, String, _)| View::plane(title, &root, vec![format!("{root}/**")], bounds);
        rows.push((gather(blueprint, Kind::Tabs, "figure", figure.panels().map(panel).collect())?, 2.0));
    }
    let curves = shown.curves.iter().flat_map(|curves| curves.views());
    let mut views = curves.map(|(title, entities)| View::curves(title, entities, None));
    if let Some(first) = views.next() {
        rows.push((blueprint.view(first)?, 1.0));
    }
    let load = View::text("Load", shown.text.into());
    let scenes = shown.stages.iter().map(|stage| View::text(&stage.title, stage.description()));
    let tabs = views.chain([load]).chain(scenes).collect();
    rows.push((gather(blueprint, Kind::Tabs, "more", tabs)?, 1.0));
    blueprint.container(Kind::Vertical, "curves", rows)
}
