//! The layout of a recording over loads: contacts on the left, figure, curves and text on the right.

use super::blueprint::{Clock, Kind, Pane, View, send};
use super::steps::pictures;
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
    let contacts = contacts(shown).map(|contacts| (contacts, CONTACT));
    let panes = contacts.into_iter().chain([(curves(shown), 1.0)]).collect();
    let clock = Clock { timeline: shown.timeline, frames_per_sec: LOADS_PER_SEC };
    send(application, vec![Pane::container(Kind::Horizontal, "loads", panes)], clock, stream)
}

/// The pictures of each scene that has any, several as tabs.
fn contacts(shown: &Panes<'_>) -> Option<Pane> {
    let stages = shown.stages.iter().zip(shown.patches).filter(|(stage, _)| stage.what.has_pictures());
    let pictures = |(stage, map): (&Stage, &Option<_>)| pictures(stage, map.as_ref().map(|map| patches(stage, map)));
    let tabs: Vec<Pane> = stages.map(pictures).collect();
    (!tabs.is_empty()).then(|| Pane::even(Kind::Tabs, "contacts", tabs))
}

fn patches(stage: &Stage, map: &PatchMap) -> Pane {
    let contents = vec![format!("{}/**", map.root()), stage.caption_entity()];
    View::plane("Contact patches, load upwards", &stage.root, contents, map.bounds())
}

/// The panels of the figure, the first curves, and a stack of the other curves and the texts.
fn curves(shown: &Panes<'_>) -> Pane {
    let mut rows = Vec::new();
    if let Some(figure) = shown.figure {
        let panels = figure.panels();
        let panels = panels.map(|(title, root, bounds)| View::plane(title, &root, vec![format!("{root}/**")], bounds));
        rows.push((Pane::even(Kind::Tabs, "figure", panels.collect()), 2.0));
    }
    let curves = shown.curves.iter().flat_map(|curves| curves.views());
    let mut views = curves.map(|(title, entities)| View::curves(title, entities, None));
    rows.extend(views.next().map(|first| (first, 1.0)));
    let load = View::text("Load", shown.text.into());
    let scenes = shown.stages.iter().map(|stage| View::text(&stage.title, stage.description()));
    rows.push((Pane::even(Kind::Tabs, "more", views.chain([load]).chain(scenes).collect()), 1.0));
    Pane::container(Kind::Vertical, "curves", rows)
}
