//! Panes: the views of a recording and the containers that they stand in, before they are written.

use super::eye::Eye;
use super::palette::{Palette, colour};
use crate::record::sdk::{Range2D, TimeRange};
use rerun::AsComponents;
use rerun::external::re_sdk_types::blueprint::{archetypes as panes, components};

pub(crate) use components::ContainerKind;
pub(crate) use components::Corner2D as Corner;

/// Panes side by side in a grid.
pub(crate) const GRID_COLUMNS: usize = 2;
/// The class of views of curves.
const CURVES: &str = "TimeSeries";

/// A part of the window: a view, or panes side by side with their shares of the room.
pub(crate) enum Pane {
    /// A view.
    View(PaneView),
    /// A container of panes.
    Container(ContainerKind, String, Vec<(Pane, f32)>),
}

impl Pane {
    pub(crate) fn container(kind: ContainerKind, title: &str, panes: Vec<(Self, f32)>) -> Self {
        Self::Container(kind, title.into(), panes)
    }

    /// The pane with another title.
    pub(crate) fn titled(self, title: &str) -> Self {
        match self {
            Self::View(view) => Self::View(PaneView { title: title.into(), ..view }),
            Self::Container(kind, _, panes) => Self::Container(kind, title.into(), panes),
        }
    }

    /// A container of panes with the same share of the room each; a single one needs no container.
    pub(crate) fn even(kind: ContainerKind, title: &str, mut panes: Vec<Self>) -> Self {
        match panes.pop() {
            Some(only) if panes.is_empty() => only,
            last => Self::container(kind, title, panes.into_iter().chain(last).map(|pane| (pane, 1.0)).collect()),
        }
    }
}

/// A view: its content and its properties.
pub(crate) struct PaneView {
    pub class: String,
    pub title: String,
    pub origin: String,
    pub contents: Vec<String>,
    pub properties: Vec<(String, Box<dyn AsComponents>)>,
    /// The root of the picture that it shows, if it shows one.
    pub picture: Option<String>,
}

impl PaneView {
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
    pub(crate) fn plane(
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
    pub(crate) fn space(title: &str, (root, eye): (&str, Eye), palette: &Palette) -> Pane {
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
    pub(crate) fn settling(title: &str, contents: Vec<String>, range: [f64; 2], legend: Option<Corner>) -> Pane {
        let range = rerun::components::Range1D(range.into());
        let view = Self::curves(title, contents, legend);
        Pane::View(view.with("ScalarAxis", panes::ScalarAxis::new().with_range(range)))
    }

    /// Curves of all times on an axis that fits them; the legend stands where nothing is, if they fall.
    pub(crate) fn falling(title: &str, contents: Vec<String>) -> Pane {
        Pane::View(Self::curves(title, contents, Some(Corner::RightTop)))
    }

    /// Curves of all times on an axis that fits them, without a legend: the title names them.
    pub(crate) fn named(title: &str, contents: Vec<String>) -> Pane {
        Pane::View(Self::curves(title, contents, None))
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
    pub(crate) fn lanes(title: &str, origin: &str) -> Pane {
        Pane::View(Self::new("StateTimeline", title, origin, vec![format!("{origin}/**")]))
    }

    pub(crate) fn text(title: &str, entity: String) -> Pane {
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
