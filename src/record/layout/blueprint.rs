//! Writes a blueprint, the viewer's description of its own panes, into a recording.

use crate::record::draw::{Eye, Palette, colour};
use crate::record::sdk::{Range2D, TimeRange, Uuid, layout};
use rerun::external::re_log_types::BlueprintActivationCommand;
use rerun::external::re_sdk_types::blueprint::{archetypes as panes, components};
use rerun::{AsComponents, RecordingStream, RecordingStreamResult};

pub use components::ContainerKind as Kind;
pub use components::Corner2D as Corner;

/// Panes side by side in a grid.
pub const GRID_COLUMNS: usize = 2;
/// The class of views of curves.
const CURVES: &str = "TimeSeries";

/// A part of the window: a view, or panes side by side with their shares of the room.
pub enum Pane {
    /// A view.
    View(View),
    /// A container of panes.
    Container(Kind, String, Vec<(Pane, f32)>),
}

impl Pane {
    pub fn container(kind: Kind, title: &str, panes: Vec<(Self, f32)>) -> Self {
        Self::Container(kind, title.into(), panes)
    }

    /// The pane with another title.
    pub fn titled(self, title: &str) -> Self {
        match self {
            Self::View(view) => Self::View(View { title: title.into(), ..view }),
            Self::Container(kind, _, panes) => Self::Container(kind, title.into(), panes),
        }
    }

    /// A container of panes with the same share of the room each; a single one needs no container.
    pub fn even(kind: Kind, title: &str, mut panes: Vec<Self>) -> Self {
        match panes.pop() {
            Some(only) if panes.is_empty() => only,
            last => Self::container(kind, title, panes.into_iter().chain(last).map(|pane| (pane, 1.0)).collect()),
        }
    }
}

/// A view: its content and its properties.
pub struct View {
    pub(super) class: String,
    pub(super) title: String,
    pub(super) origin: String,
    pub(super) contents: Vec<String>,
    pub(super) properties: Vec<(String, Box<dyn AsComponents>)>,
    /// The root of the picture that it shows, if it shows one.
    pub(super) picture: Option<String>,
}

impl View {
    /// A view of `class` of the entities that match `contents` (`/scene/pressure/**`).
    fn new(class: &str, title: &str, origin: &str, contents: Vec<String>) -> Self {
        Self {
            class: class.into(),
            title: title.into(),
            origin: origin.into(),
            contents,
            properties: Vec::new(),
            picture: None,
        }
    }

    /// The picture of a root in the plane, showing `[left, right, top, bottom]` of its canvas.
    pub fn plane(
        title: &str,
        origin: &str,
        contents: Vec<String>,
        (root, [left, right, top, bottom]): (String, [f64; 4]),
        palette: &Palette,
    ) -> Pane {
        let range = Range2D { x_range: [left, right].into(), y_range: [top, bottom].into() };
        let bounds = panes::VisualBounds2D::new(components::VisualBounds2D(range));
        let view = Self::new("2D", title, origin, contents).with("VisualBounds2D", bounds);
        Pane::View(Self { picture: Some(root), ..view.with("Background", ground(palette)) })
    }

    /// The picture of a root in space, as an eye sees it.
    pub fn space(title: &str, (root, eye): (&str, Eye), palette: &Palette) -> Pane {
        let eye = panes::EyeControls3D::new()
            .with_kind(components::Eye3DKind::Orbital)
            .with_position(eye.position)
            .with_look_target(eye.target)
            .with_eye_up([0.0, 0.0, 1.0]);
        let view = Self::new("3D", title, root, vec![format!("{root}/**")]).with("EyeControls3D", eye);
        let view = view.with("LineGrid3D", panes::LineGrid3D::new().with_visible(false));
        Pane::View(Self { picture: Some(root.into()), ..view.with("Background", ground(palette)) })
    }

    /// Curves of all times on an axis over `range`. Without a legend, the title must say which curve is which.
    pub fn settling(title: &str, contents: Vec<String>, range: [f64; 2], legend: Option<Corner>) -> Pane {
        let range = rerun::components::Range1D(range.into());
        let view = Self::curves(title, contents, legend);
        Pane::View(view.with("ScalarAxis", panes::ScalarAxis::new().with_range(range)))
    }

    /// Curves of all times on an axis that fits them; the legend stands where nothing is, if they fall.
    pub fn falling(title: &str, contents: Vec<String>) -> Pane {
        Pane::View(Self::curves(title, contents, Some(Corner::RightTop)))
    }

    /// One curve of all times, which the title names, on an axis that fits it.
    pub fn single(title: &str, entity: String) -> Pane {
        Pane::View(Self::curves(title, vec![entity], None))
    }

    fn curves(title: &str, contents: Vec<String>, legend: Option<Corner>) -> Self {
        let time = panes::TimeAxis::new().with_link(components::LinkAxis::Independent);
        let legend = match legend {
            Some(corner) => panes::PlotLegend::new().with_corner(corner),
            None => panes::PlotLegend::new().with_visible(false),
        };
        Self::new(CURVES, title, "/", contents)
            .with("PlotLegend", legend)
            .with("TimeAxis", time.with_view_range(TimeRange::EVERYTHING))
    }

    /// Lanes of states over all times.
    pub fn lanes(title: &str, origin: &str) -> Pane {
        Pane::View(Self::new("StateTimeline", title, origin, vec![format!("{origin}/**")]))
    }

    pub fn text(title: &str, entity: String) -> Pane {
        Pane::View(Self::new("TextDocument", title, &entity.clone(), vec![entity]))
    }

    fn with(mut self, name: &str, property: impl AsComponents + 'static) -> Self {
        self.properties.push((name.into(), Box::new(property)));
        self
    }
}

fn ground(palette: &Palette) -> panes::Background {
    panes::Background::new(components::BackgroundKind::SolidColor).with_color(colour(palette.ground))
}

/// Writes the blueprint of its viewer into `recording`: `panes`, as tabs if there are several, and the
/// timeline that is active at first with its frames per second.
///
/// Views of curves keep the ground of the viewer, as numbers, grid and legend are drawn in the colours of the viewer, which no
/// recording can set: on a ground of our own they would be unreadable in the other theme.
pub fn send(panes: Vec<Pane>, clock: (&'static str, f64), recording: &RecordingStream) -> RecordingStreamResult<()> {
    let Some(shown) = recording.store_info() else { return Ok(()) };
    let (store, storage) = layout(shown.application_id())?;
    store.set_time_sequence("blueprint", 0);
    let mut blueprint = Blueprint { store, panes: 0 };
    blueprint.log(panes, clock)?;
    let Some(info) = blueprint.store.store_info() else { return Ok(()) };
    let command = BlueprintActivationCommand { blueprint_id: info.store_id, make_active: true, make_default: true };
    recording.send_blueprint(storage.take(), command);
    Ok(())
}

/// A blueprint in the making, whose panes are named by their paths.
struct Blueprint {
    store: RecordingStream,
    panes: u16,
}

impl Blueprint {
    fn log(&mut self, panes: Vec<Pane>, clock: (&'static str, f64)) -> RecordingStreamResult<()> {
        let kind = if panes.len() > 1 { Kind::Tabs } else { Kind::Horizontal };
        let root = self.container(kind, "asperity".into(), panes.into_iter().map(|pane| (pane, 1.0)).collect())?;
        let viewport = panes::ViewportBlueprint::new().with_root_container(root);
        self.store.log("viewport", &viewport.with_auto_layout(false).with_auto_views(false))?;
        self.log_panels(clock)
    }

    /// Adds a pane and returns its path.
    fn pane(&mut self, pane: Pane) -> RecordingStreamResult<String> {
        match pane {
            Pane::View(view) => self.view(view),
            Pane::Container(kind, title, panes) => Ok(format!("container/{}", self.container(kind, title, panes)?)),
        }
    }

    fn view(&mut self, view: View) -> RecordingStreamResult<String> {
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

    fn container(&mut self, kind: Kind, title: String, children: Vec<(Pane, f32)>) -> RecordingStreamResult<Uuid> {
        let (children, shares): (Vec<_>, Vec<_>) = children.into_iter().unzip();
        let paths = children.into_iter().map(|pane| self.pane(pane)).collect::<RecordingStreamResult<Vec<_>>>()?;
        let id = self.next_id("container");
        let contents = paths.into_iter().map(|path| components::IncludedContent(path.into()));
        let pane = panes::ContainerBlueprint::new(kind).with_display_name(title).with_contents(contents);
        let pane = match kind {
            Kind::Horizontal => pane.with_col_shares(shares),
            Kind::Vertical => pane.with_row_shares(shares),
            Kind::Grid => pane.with_grid_columns(GRID_COLUMNS as u32),
            Kind::Tabs => pane,
        };
        self.store.log(format!("container/{id}"), &pane)?;
        Ok(id)
    }

    /// Side panels folded, time at the last frame.
    fn log_panels(&self, (timeline, frames_per_sec): (&'static str, f64)) -> RecordingStreamResult<()> {
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

    /// A new identity. It tells classes of panes apart, as the viewer keeps what it knows of a pane when the next recording
    /// brings another layout.
    fn next_id(&mut self, class: &str) -> Uuid {
        self.panes += 1;
        let mut bytes = *b"asperity\x80\0\0\0\0\0\0\0";
        bytes[9..14].iter_mut().zip(class.bytes()).for_each(|(byte, letter)| *byte = letter);
        bytes[14..].copy_from_slice(&self.panes.to_be_bytes());
        Uuid { bytes }
    }
}

/// Store and storage hold one another: unless they are parted, both stay for ever, and two threads with them.
impl Drop for Blueprint {
    fn drop(&mut self) {
        self.store.disconnect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blueprint_arrives_and_its_store_ends_with_it() {
        let (recording, storage) = layout(&"test".into()).unwrap();
        let text = View::text("text", "/text".into());
        send(vec![text], ("step", 1.0), &recording).unwrap();
        assert!(!storage.take().is_empty());
        recording.disconnect();
        let (store, storage) = layout(&"test".into()).unwrap();
        let weak = store.clone_weak();
        drop((Blueprint { store, panes: 0 }, storage));
        assert_eq!(weak.ref_count(), 0);
    }
}
