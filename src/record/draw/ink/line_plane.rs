//! The canvas that the pictures of a line share: the same part of the line, at the same place.

use super::canvas;
use super::mirror::MeasuredPart;
use super::palette::Palette;
use super::pane::{Pane, PaneView};
use super::reduce::Columns;
use super::ruler::Ruler;
use super::window::{Samples, Window};
use crate::contact::Law;
use crate::plot::{AxesFrame, Axis};
use crate::record::draw::fields::FrameFields;
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// Width of the box of a picture on its canvas.
pub(crate) const WIDTH: f32 = canvas::WIDTH as f32;

/// The part of a line that is shown, and where it lies on the canvas.
#[derive(Clone)]
pub(crate) struct LinePlane {
    /// Root of the entities of the scene.
    pub root: String,
    pub palette: &'static Palette,
    pub law: Law,
    pub window: Window,
    /// First and last position, lengths.
    pub ends: [f64; 2],
    /// The box with the axis of positions; each picture has a vertical axis of its own.
    pub frame: AxesFrame,
    parts: Parts,
    /// The part that was measured, if the rest is its mirror image.
    pub measured: Option<MeasuredPart>,
}

impl LinePlane {
    /// The canvas of a scene whose entities lie under `root`.
    pub(crate) fn new(scene: &Scene<'_>, root: &str, options: &Options) -> Self {
        let window = Window::around(scene);
        let ends = window.ends(scene.problem.surface().grid().spacing()[1]);
        let x = Ruler::new("x", &options.length_unit, ends).axis;
        Self {
            root: root.into(),
            palette: Palette::new(options.theme),
            law: scene.problem.law(),
            window,
            ends,
            frame: canvas::frame(canvas::PANE, [x, Axis::linear("", [0.0, 1.0])], 0.0),
            parts: options.what,
            measured: MeasuredPart::new(scene),
        }
    }

    /// Gives it the proportions of a pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit(&mut self.frame, pane, 0.0);
    }

    /// The view of a picture on this canvas. The contact lies in it if it `has_contact`.
    pub(crate) fn pane(&self, picture: &str, title: &str, has_contact: bool) -> Pane {
        let root = &self.root;
        let mut contents = vec![format!("{root}/{picture}/**"), caption(root)];
        if has_contact && self.parts.has(Part::Mask) {
            contents.extend(["contact", "contact/patches"].map(|entity| format!("{root}/{entity}")));
        }
        PaneView::plane(title, root, contents, (root.clone(), canvas::bounds(&self.frame, 0.0)), self.palette)
    }

    /// The frame with a vertical axis.
    pub(crate) fn frame_with(&self, y: &Axis) -> AxesFrame {
        AxesFrame { y: y.clone(), ..self.frame.clone() }
    }

    /// The height of the box on the canvas.
    pub(crate) fn height(&self) -> f32 {
        self.frame.size[1] as f32
    }

    /// The place of a value on the canvas, from above.
    pub(crate) fn level(&self, value: f64, ruler: &Ruler) -> f32 {
        self.height() * (1.0 - ruler.share(value) as f32)
    }

    /// Outlines the measured part in a picture.
    pub(crate) fn log_measured(&self, to: &RecordingStream, picture: &str) -> RecordingStreamResult<()> {
        let entity = format!("{}/{picture}/measured", self.root);
        self.measured.map_or(Ok(()), |measured| measured.log(to, &entity, self.frame.size, self.palette))
    }

    /// Runs of nodes in contact with their edges, as left and right ends on the canvas; of columns of several nodes, half a spacing
    /// beyond the outer ones.
    pub(crate) fn segments(&self, fields: &FrameFields<'_>) -> Vec<[f32; 2]> {
        let nodes = self.window.every(fields.stride[1]);
        let runs = Columns::new(nodes.count()).runs(|i| fields.pressure[nodes.node(i)] > 0.0);
        let end = |i: usize, is_right: bool| {
            let beyond = fields.outline.place(nodes.node(i), is_right) as f32 * nodes.spacing();
            let place = nodes.place(i) + if is_right { beyond } else { -beyond };
            (place * WIDTH).clamp(0.0, WIDTH)
        };
        runs.into_iter().map(|run| [end(run.start, false), end(run.end - 1, true)]).collect()
    }
}

/// The entity of the words above the pictures of the scene under `root`.
pub(crate) fn caption(root: &str) -> String {
    format!("{root}/caption")
}

/// A curve with the height `y(i)` at sample `i`.
pub(crate) fn curve(nodes: &Samples, y: impl Fn(usize) -> f32) -> Vec<[f32; 2]> {
    Columns::new(nodes.count()).extremes(y).into_iter().map(|(i, y)| [nodes.place(i) * WIDTH, y]).collect()
}
