//! The indenter above the solid along a line.

use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields, range};
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
/// The largest distance of surfaces apart that the profile has room for, in heights of the profile. From further away the shapes could not be read.
const MOST_APART: f64 = 3.0;

/// The indenter at rest, and the solid a gap below it.
#[derive(Clone)]
struct Bodies {
    plane: LinePlane,
    title: String,
    /// The heights of the indenter at all nodes of the window, upwards, and their places on the vertical axis.
    heights: Vec<f64>,
    places: Vec<f32>,
    length_unit: String,
    axis: Ruler,
}

/// The drawing of a line.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    let Plane::Line(plane) = subject.plane else { return None };
    let height = subject.scene.problem.height();
    let nodes = plane.window.every(1);
    let heights: Vec<f64> = nodes.values(height).map(|h| -h).collect();
    let length_unit = subject.options.length_unit.clone();
    let axis = axis(&heights, &length_unit, 0.0);
    Some(Box::new(Bodies {
        plane: plane.clone(),
        title: format!("{}: indenter above the solid", subject.scene.title),
        places: places(&heights, &axis),
        axis,
        heights,
        length_unit,
    }))
}

/// The places of heights on an axis.
fn places(heights: &[f64], axis: &Ruler) -> Vec<f32> {
    heights.iter().map(|height| axis.place(*height) as f32).collect()
}

/// The vertical axis for the heights of an indenter, and below it for a solid that is as far `apart`.
fn axis(heights: &[f64], length_unit: &str, apart: f64) -> Ruler {
    let [low, high] = range(heights.iter().copied());
    let room = ROOM * (high - low);
    Ruler::new("z", length_unit, [low - 2.0 * room - apart, high + room])
}

impl Bodies {
    /// The height of the indenter on the canvas, at a node of the window.
    fn indenter(&self, node: usize) -> f32 {
        self.plane.height() * (1.0 - self.places[node])
    }

    /// The same bodies with room for a solid that is apart, as far as the shapes can be read.
    fn with_room(&self, apart: f64) -> Self {
        let [low, high] = range(self.heights.iter().copied());
        let apart = apart.min(MOST_APART * (high - low));
        let axis = axis(&self.heights, &self.length_unit, apart);
        Self { places: places(&self.heights, &axis), axis, ..self.clone() }
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

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let least = fields.gap.iter().copied().fold(f64::INFINITY, f64::min);
        FieldExtent { apart: if least.is_finite() { least.max(0.0) } else { 0.0 }, ..FieldExtent::NONE }
    }

    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        if extent.apart > 0.0 { self.with_room(extent.apart).log_static(to) } else { Ok(()) }
    }

    /// The fill of the solid ends at the box, so that it cannot be stretched to a box that is deeper.
    fn redraw(&self, to: &RecordingStream, fields: &FrameFields<'_>, all: &FieldExtent) -> RecordingStreamResult<()> {
        if all.apart > 0.0 { self.with_room(all.apart).log_frame(to, fields) } else { Ok(()) }
    }
}
