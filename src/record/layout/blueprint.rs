//! Writes a blueprint, the viewer's description of its own panes, into a recording.

use crate::digest::fnv1a;
use crate::record::draw::{ContainerKind, GRID_COLUMNS, Pane, PaneView};
use crate::record::sdk::{Uuid, layout};
use rerun::external::re_log_types::BlueprintActivationCommand;
use rerun::external::re_sdk_types::blueprint::{archetypes as panes, components};
use rerun::{RecordingStream, RecordingStreamResult};

/// Number of different identities that the same pane has in the recordings of different applications.
///
/// The SDK keeps each path of an entity for as long as the process lives, and the paths of panes contain their identities: with an identity of its own,
/// each recording of a server would leave 30 kB behind. With 256 these are 8 MB at most. The price: one recording of 256 begins with the part of the
/// curves that the viewer showed of the recording before.
const IDENTITIES: u64 = 256;

/// The timeline that is active at first, and how fast it is played.
pub(crate) struct PlayedTimeline {
    pub timeline: &'static str,
    pub frames_per_sec: f64,
}

/// Writes the blueprint of its viewer into `recording`: `panes`, as tabs if there are several, and how they are played.
///
/// Views of curves keep the background of the viewer, because numbers, grid and legend have the colours of the viewer,
/// which a recording cannot set. On another background they would be unreadable in one of the themes.
pub(crate) fn send(panes: Vec<Pane>, played: PlayedTimeline, recording: &RecordingStream) -> RecordingStreamResult<()> {
    let Some(shown) = recording.store_info() else { return Ok(()) };
    let (store, storage) = layout(shown.application_id())?;
    store.set_time_sequence("blueprint", 0);
    let application = fnv1a([shown.application_id().as_str().as_bytes()]) % IDENTITIES;
    let mut blueprint = Blueprint { store, application, panes: 0 };
    blueprint.log(panes, played)?;
    let Some(info) = blueprint.store.store_info() else { return Ok(()) };
    let command = BlueprintActivationCommand { blueprint_id: info.store_id, make_active: true, make_default: true };
    recording.send_blueprint(storage.take(), command);
    Ok(())
}

/// A blueprint in the making, whose panes are named by their paths.
struct Blueprint {
    store: RecordingStream,
    /// A number of the application of the recording, below [`IDENTITIES`].
    application: u64,
    panes: u16,
}

impl Blueprint {
    fn log(&mut self, panes: Vec<Pane>, played: PlayedTimeline) -> RecordingStreamResult<()> {
        let kind = if panes.len() > 1 { ContainerKind::Tabs } else { ContainerKind::Horizontal };
        let root = self.container(kind, "asperity".into(), panes.into_iter().map(|pane| (pane, 1.0)).collect())?;
        let viewport = panes::ViewportBlueprint::new().with_root_container(root);
        self.store.log("viewport", &viewport.with_auto_layout(false).with_auto_views(false))?;
        self.log_panels(played)
    }

    /// Adds a pane and returns its path.
    fn pane(&mut self, pane: Pane) -> RecordingStreamResult<String> {
        match pane {
            Pane::View(view) => self.view(view),
            Pane::Container(kind, title, panes) => Ok(format!("container/{}", self.container(kind, title, panes)?)),
        }
    }

    fn view(&mut self, view: PaneView) -> RecordingStreamResult<String> {
        let path = format!("view/{}", self.next_id(&view.class));
        let contents = view.contents.into_iter().map(|entities| components::QueryExpression(entities.into()));
        self.store.log(format!("{path}/ViewContents"), &panes::ViewContents::new(contents))?;
        let pane = panes::ViewBlueprint::new(view.class).with_display_name(view.title).with_space_origin(view.origin);
        self.store.log(path.as_str(), &pane)?;
        for (name, property) in view.properties {
            self.store.log(format!("{path}/{name}"), property.as_ref())?;
        }
        Ok(path)
    }

    fn container(
        &mut self,
        kind: ContainerKind,
        title: String,
        children: Vec<(Pane, f32)>,
    ) -> RecordingStreamResult<Uuid> {
        let (children, shares): (Vec<_>, Vec<_>) = children.into_iter().unzip();
        let paths = children.into_iter().map(|pane| self.pane(pane)).collect::<RecordingStreamResult<Vec<_>>>()?;
        let id = self.next_id("container");
        let contents = paths.into_iter().map(|path| components::IncludedContent(path.into()));
        let pane = panes::ContainerBlueprint::new(kind).with_display_name(title).with_contents(contents);
        let pane = match kind {
            ContainerKind::Horizontal => pane.with_col_shares(shares),
            ContainerKind::Vertical => pane.with_row_shares(shares),
            ContainerKind::Grid => pane.with_grid_columns(GRID_COLUMNS as u32),
            ContainerKind::Tabs => pane,
        };
        self.store.log(format!("container/{id}"), &pane)?;
        Ok(id)
    }

    /// Side panels folded, time at the last frame.
    fn log_panels(&self, PlayedTimeline { timeline, frames_per_sec }: PlayedTimeline) -> RecordingStreamResult<()> {
        let folded = panes::PanelBlueprint::new().with_state(components::PanelState::Collapsed);
        self.store.log("blueprint_panel", &folded)?;
        self.store.log("selection_panel", &folded)?;
        let time = panes::TimePanelBlueprint::new()
            .with_state(components::PanelState::Collapsed)
            .with_timeline(timeline)
            .with_fps(frames_per_sec)
            .with_play_state(components::PlayState::Following);
        self.store.log("time_panel", &time)
    }

    /// A new identity. It distinguishes recordings and classes of panes, because the viewer keeps what it knows of a pane, such as the part of a
    /// curve that it shows, when the next recording brings another layout.
    fn next_id(&mut self, class: &str) -> Uuid {
        self.panes += 1;
        let mut bytes = *b"\0\0\0\0\0\0\0\0\x80\0\0\0\0\0\0\0";
        bytes[..8].copy_from_slice(&self.application.to_be_bytes());
        bytes[9..14].iter_mut().zip(class.bytes()).for_each(|(byte, letter)| *byte = letter);
        bytes[14..].copy_from_slice(&self.panes.to_be_bytes());
        Uuid { bytes }
    }
}

/// Store and storage refer to each other: unless the cycle is broken, both are never freed, and two threads never end.
impl Drop for Blueprint {
    fn drop(&mut self) {
        self.store.disconnect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_of_different_recordings_have_different_identities() {
        let ids = ["one", "other"].map(|application| {
            let (store, _) = layout(&application.into()).unwrap();
            let mut blueprint = Blueprint { store, application: fnv1a([application.as_bytes()]), panes: 0 };
            [blueprint.next_id("TimeSeries"), blueprint.next_id("TimeSeries")]
        });
        assert!(ids[0] != ids[1] && ids[0][0] != ids[0][1]);
    }

    #[test]
    fn a_blueprint_arrives_and_its_store_ends_with_it() {
        let (recording, storage) = layout(&"test".into()).unwrap();
        let text = PaneView::text("text", "/text".into());
        send(vec![text], PlayedTimeline { timeline: "step", frames_per_sec: 1.0 }, &recording).unwrap();
        assert!(!storage.take().is_empty());
        recording.disconnect();
        let (store, storage) = layout(&"test".into()).unwrap();
        let weak = store.clone_weak();
        drop((Blueprint { store, application: 0, panes: 0 }, storage));
        assert_eq!(weak.ref_count(), 0);
    }
}
