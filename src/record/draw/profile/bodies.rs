//! The indenter above the solid along a line.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FrameFields, range};
use crate::record::draw::ink::canvas::{self, strip, style};
use crate::record::draw::ink::fill;
use crate::record::draw::ink::line_plane::{LinePlane, WIDTH, curve};
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::window::Samples;
use crate::record::draw::plane::Plane;
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Room above and below the profile, in heights of the profile.
const ROOM: f64 = 0.06;

/// The indenter at rest, and the solid a gap below it.
struct Bodies {
    plane: LinePlane,
    title: String,
    /// The place of the indenter on the vertical axis, for all nodes of the window.
    indenter: Vec<f32>,
    axis: Ruler,
}

/// The drawing of a line.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let Plane::Line(plane) = subject.plane else { return None };
    let height = subject.scene.problem.height();
    let nodes = plane.window.every(1);
    let [low, high] = range(nodes.values(height));
    let room = ROOM * (high - low);
    let axis = Ruler::new("z", &subject.options.length_unit, [-high - 2.0 * room - subject.scene.apart, -low + room]);
    Some(Box::new(Bodies {
        plane: plane.clone(),
        title: format!("{}: indenter above the solid", subject.scene.title),
        indenter: nodes.values(height).map(|h| axis.place(-h) as f32).collect(),
        axis,
    }))
}

impl Bodies {
    /// The height of the indenter on the canvas, at a node of the window.
    fn indenter(&self, node: usize) -> f32 {
        self.plane.height() * (1.0 - self.indenter[node])
    }

    /// The solid, a gap below the nodes of the indenter.
    fn solid(&self, nodes: &Samples, gap: &[f64]) -> Vec<[f32; 2]> {
        let height = self.plane.height();
        let level = |i| self.indenter(nodes.offset(i)) + height * self.axis.share(gap[nodes.node(i)]) as f32;
        curve(nodes, |i| level(i).clamp(0.0, height))
    }
}

impl Drawing for Bodies {
    fn panes(&self) -> Vec<(Place, Pane)> {
        vec![(Place::Main, self.plane.pane("profile", &self.title, true))]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.plane.root).into_iter().for_each(|size| self.plane.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let LinePlane { palette, .. } = self.plane;
        let root = format!("{}/profile", self.plane.root);
        canvas::log_axes(to, palette, &format!("{root}/axes"), &self.plane.frame_with(&self.axis.axis))?;
        self.plane.log_measured(to, "profile")?;
        let bars = Radius::new_scene_units(fill::radius(WIDTH));
        to.log_static(format!("{root}/solid"), &style(palette.solid, Radius::new_ui_points(1.0), 32.0))?;
        to.log_static(format!("{root}/solid_fill"), &style(palette.solid_fill, bars, 10.0))?;
        let curve = curve(&self.plane.window.every(1), |i| self.indenter(i));
        let body = style(palette.indenter_fill, bars, 8.0);
        let body = body.with_strips([fill::under(&curve, WIDTH, 0.0, f32::min)]);
        to.log_static(format!("{root}/indenter_fill"), &body)?;
        let line = style(palette.indenter, Radius::new_ui_points(0.8), 30.0);
        to.log_static(format!("{root}/indenter"), &line.with_strips([curve]))
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let root = format!("{}/profile", self.plane.root);
        let solid = self.solid(&self.plane.window.every(fields.stride[1]), &fields.gap);
        let body = fill::under(&solid, WIDTH, self.plane.height(), f32::max);
        to.log(format!("{root}/solid_fill"), &strip(body))?;
        to.log(format!("{root}/solid"), &strip(solid))
    }
}
