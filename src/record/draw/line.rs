//! The pictures of a line: the indenter above the solid, the pressure and the gap along it.

use super::canvas::{self, strip, style};
use super::fields::{Extent, Fields, range};
use super::fill;
use super::mirror::MeasuredPart;
use super::palette::{self, CONTACT_CLASS, Palette, YIELDING_CLASS};
use super::patch_points;
use super::picture::Picture;
use super::reduce::Columns;
use super::ruler::Ruler;
use super::strips::strips_of;
use super::window::{Samples, Window};
use crate::contact::{Forecast, Law};
use crate::plot::{Axis, Frame};
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::record::sdk::Float32;
use crate::setup::Part;
use crate::theory::Exact;
use rerun::{AnyValues, AsComponents, LineStrips2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

const WIDTH: f32 = canvas::WIDTH as f32;
/// Room above and below the profile, in heights of the profile.
const ROOM: f64 = 0.06;

/// Pictures of a line; the pictures that are shown lie at the same place of the canvas.
pub struct LinePicture {
    what: Parts,
    palette: &'static Palette,
    root: String,
    law: Law,
    window: Window,
    /// The place of the indenter on the axis of the profile, for all nodes of the window; empty if it is not shown.
    indenter: Vec<f32>,
    /// The frame of the profile.
    frame: Frame,
    /// First and last position.
    ends: [f64; 2],
    profile: Ruler,
    pressure: Ruler,
    gap: Ruler,
    /// The exact pressure, where there is one.
    exact: Option<Vec<f64>>,
    /// The part that was measured, if the rest is its mirror image.
    measured: Option<MeasuredPart>,
}

impl LinePicture {
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, options: &Options) -> Self {
        let problem = scene.problem;
        let window = Window::around(scene);
        let nodes = window.every(1);
        let [low, high] = range(nodes.of(problem.height()));
        let room = ROOM * (high - low);
        let length = |symbol, range| Ruler::new(symbol, &options.length_unit, range);
        let profile = length("z", [-high - 2.0 * room, -low + room]);
        let shown = options.what.has(Part::Profile).then(|| nodes.of(problem.height()));
        let ends = window.ends(problem.surface().grid().spacing()[1]);
        Self {
            what: options.what,
            palette: Palette::of(options.theme),
            root: root.into(),
            law: problem.law(),
            window,
            indenter: shown.into_iter().flatten().map(|h| profile.place(-h) as f32).collect(),
            frame: canvas::frame(canvas::PANE, [length("x", ends).axis, profile.axis.clone()], 0.0),
            ends,
            profile,
            pressure: Ruler::pressure(forecast.max_pressure, problem.contact_modulus()),
            gap: Ruler::gap(high - low, problem.rms_height()),
            exact: scene.exact.as_ref().map(finite_pressure),
            measured: MeasuredPart::of(scene),
        }
    }

    fn frame_with(&self, y: &Axis) -> Frame {
        Frame { y: y.clone(), ..self.frame.clone() }
    }

    /// The height of the box on the canvas.
    fn height(&self) -> f32 {
        self.frame.size[1] as f32
    }

    /// The height of a value on the canvas.
    fn level(&self, value: f64, ruler: &Ruler) -> f32 {
        self.height() * (1.0 - ruler.share(value) as f32)
    }

    /// The height of the indenter on the canvas, at a node of the window.
    fn indenter(&self, node: usize) -> f32 {
        self.height() * (1.0 - self.indenter[node])
    }

    /// Values upwards from the lower edge of the box.
    fn rising(&self, nodes: &Samples, values: &[f64], ruler: &Ruler) -> Vec<[f32; 2]> {
        curve(nodes, |i| self.level(values[nodes.node(i)], ruler))
    }

    fn log_profile(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let root = format!("{}/profile", self.root);
        canvas::log_axes(to, self.palette, &format!("{root}/axes"), &self.frame)?;
        self.log_measured(to, "profile")?;
        let bars = Radius::new_scene_units(fill::radius(WIDTH));
        to.log_static(format!("{root}/solid"), &style(self.palette.solid, Radius::new_ui_points(1.0), 32.0))?;
        to.log_static(format!("{root}/solid_fill"), &style(self.palette.solid_fill, bars, 10.0))?;
        let curve = curve(&self.window.every(1), |i| self.indenter(i));
        let body = style(self.palette.indenter_fill, bars, 8.0);
        let body = body.with_strips([fill::under(&curve, WIDTH, 0.0, f32::min)]);
        to.log_static(format!("{root}/indenter_fill"), &body)?;
        let line = style(self.palette.indenter, Radius::new_ui_points(0.8), 30.0);
        to.log_static(format!("{root}/indenter"), &line.with_strips([curve]))
    }

    /// Outlines what was measured in a picture.
    fn log_measured(&self, to: &RecordingStream, picture: &str) -> RecordingStreamResult<()> {
        let entity = format!("{}/{picture}/measured", self.root);
        self.measured.map_or(Ok(()), |measured| measured.log(to, &entity, self.frame.size, self.palette))
    }

    fn log_fields(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let [pressure, gap] = ["pressure", "gap"].map(|name| format!("{}/{name}/curves", self.root));
        to.log_static(format!("{pressure}/pressure"), &style(self.palette.pressure, Radius::new_ui_points(1.4), 32.0))?;
        to.log_static(format!("{gap}/gap"), &style(self.palette.gap, Radius::new_ui_points(1.0), 32.0))?;
        if let Some(exact) = &self.exact {
            let curve = self.rising(&self.window.every(1), exact, &self.pressure);
            let curve: Vec<[f64; 2]> = curve.into_iter().map(|point| point.map(f64::from)).collect();
            let line = style(self.palette.exact, Radius::new_ui_points(1.0), 38.0);
            to.log_static(format!("{pressure}/exact"), &line.with_strips(canvas::dashed(&curve)))?;
        }
        ["pressure", "gap"].into_iter().try_for_each(|picture| self.log_measured(to, picture))?;
        self.log_scaled(to, [self.pressure.axis.clone(), self.gap.axis.clone()])
    }

    /// The axes of pressure and gap, and the curves stretched to them: frames recorded before stay right.
    fn log_scaled(&self, to: &RecordingStream, axes: [Axis; 2]) -> RecordingStreamResult<()> {
        for ((name, ruler), axis) in [("pressure", &self.pressure), ("gap", &self.gap)].into_iter().zip(axes) {
            canvas::log_axes(to, self.palette, &format!("{}/{name}/axes", self.root), &self.frame_with(&axis))?;
            let stretch = axis.place(ruler.axis.range[1]) as f32;
            let transform = Transform3D::from_translation([0.0, self.height() * (1.0 - stretch), 0.0]);
            to.log_static(format!("{}/{name}/curves", self.root), &transform.with_scale([1.0, stretch, 1.0]))?;
        }
        Ok(())
    }

    /// Records the curve of a field in pieces, each with its position `x` and the value that it stands for, of those of its
    /// nodes the one that `pick` prefers: numbers for programs, and for people who point at the curve.
    fn log_field(
        &self,
        to: &RecordingStream,
        name: &'static str,
        nodes: &Samples,
        (field, ruler): (&[f64], &Ruler),
        pick: impl Fn(f64, f64) -> f64,
    ) -> RecordingStreamResult<()> {
        let columns = Columns::new(nodes.count());
        let (curve, pieces) = columns.pieces(|i| self.level(field[nodes.node(i)], ruler));
        let curve: Vec<[f32; 2]> = curve.into_iter().map(|(i, y)| [nodes.place(i) * WIDTH, y]).collect();
        let [start, end] = self.ends;
        let position = |sample: f64| f64::from(nodes.place(0)) + sample * f64::from(nodes.spacing());
        let values = columns.fold(|i| field[nodes.node(i)], pick);
        let (x, values): (Vec<_>, Vec<_>) =
            values.map(|(sample, value)| ((start + position(sample) * (end - start)) as f32, value as f32)).unzip();
        let values = AnyValues::default()
            .with_component_override::<Float32>("x", "length", x)
            .with_component_override::<Float32>(name, name, values);
        let strips = strips_of(&curve, pieces.into_iter());
        to.log(format!("{}/{name}/curves/{name}", self.root), &[&strips as &dyn AsComponents, &values])
    }

    /// Runs of nodes that yield, half a spacing beyond the outer ones.
    fn yielding(&self, fields: &Fields<'_>) -> Vec<[f32; 2]> {
        let nodes = self.window.every(fields.stride[1]);
        let runs = Columns::new(nodes.count()).runs(|i| self.law.yields(fields.pressure[nodes.node(i)]));
        let end = |i: usize, beyond: f32| ((nodes.place(i) + beyond * nodes.spacing()) * WIDTH).clamp(0.0, WIDTH);
        runs.into_iter().map(|run| [end(run.start, -0.5), end(run.end - 1, 0.5)]).collect()
    }

    /// The solid, a gap below the nodes of the indenter.
    fn solid(&self, nodes: &Samples, gap: &[f64]) -> Vec<[f32; 2]> {
        let height = self.height();
        let level = |i| self.indenter(nodes.offset(i)) + height * self.profile.share(gap[nodes.node(i)]) as f32;
        curve(nodes, |i| level(i).clamp(0.0, height))
    }
}

impl Picture for LinePicture {
    fn frame(&self) -> &Frame {
        &self.frame
    }

    fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit(&mut self.frame, pane, 0.0);
    }

    fn bounds(&self) -> [f64; 4] {
        canvas::bounds(&self.frame, 0.0)
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        if self.what.has(Part::Profile) {
            self.log_profile(to)?;
        }
        if self.what.has(Part::Fields) {
            self.log_fields(to)?;
        }
        if self.what.has(Part::Mask) {
            patch_points::log_style(to, &format!("{}/contact/patches", self.root), self.palette.contact)?;
            let contact = style(self.palette.contact, Radius::new_ui_points(2.5), 34.0);
            let contact = contact.with_class_ids([CONTACT_CLASS]).with_show_labels(false);
            to.log_static(format!("{}/contact", self.root), &contact)?;
            if !self.law.is_hard_wall() {
                let yielding = style(self.palette.yielding, Radius::new_ui_points(2.5), 35.0);
                let yielding = yielding.with_class_ids([YIELDING_CLASS]).with_show_labels(false);
                to.log_static(format!("{}/contact/yielding", self.root), &yielding)?;
            }
        }
        if self.what.has_mask_alone() {
            canvas::log_floor(to, self.palette, &format!("{}/contact/axes", self.root), &self.frame)?;
        }
        Ok(())
    }

    fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let (root, nodes) = (&self.root, self.window.every(fields.stride[1]));
        if self.what.has(Part::Profile) {
            let solid = self.solid(&nodes, &fields.gap);
            to.log(format!("{root}/profile/solid_fill"), &strip(fill::under(&solid, WIDTH, self.height(), f32::max)))?;
            to.log(format!("{root}/profile/solid"), &strip(solid))?;
        }
        if self.what.has(Part::Fields) {
            self.log_field(to, "pressure", &nodes, (&fields.pressure, &self.pressure), f64::max)?;
            self.log_field(to, "gap", &nodes, (&fields.gap, &self.gap), f64::min)?;
        }
        if self.what.has(Part::Mask) {
            let segments = self.segments(fields).into_iter().map(|ends| ends.map(|x| [x, self.height()]));
            to.log(format!("{root}/contact"), &LineStrips2D::update_fields().with_strips(segments))?;
            if !self.law.is_hard_wall() {
                let segments = self.yielding(fields).into_iter().map(|ends| ends.map(|x| [x, self.height()]));
                to.log(format!("{root}/contact/yielding"), &LineStrips2D::update_fields().with_strips(segments))?;
            }
            let place = |node| Some([nodes.place(nodes.sample(node)?) * WIDTH, self.height()]);
            patch_points::log(to, &format!("{root}/contact/patches"), &fields.patches, place)?;
        }
        Ok(())
    }

    fn log_ghost(&self, to: &RecordingStream, pressure: &[f64]) -> RecordingStreamResult<()> {
        let nodes = self.window.nodes;
        let pressure: Vec<f64> = (0..nodes).map(|i| pressure[i * pressure.len() / nodes]).collect();
        let curve = self.rising(&self.window.every(1), &pressure, &self.pressure);
        let line = style(palette::GHOST, Radius::new_ui_points(0.7), 35.0);
        to.log_static(format!("{}/pressure/curves/ghost", self.root), &line.with_strips([curve]))
    }

    fn extent(&self, fields: &Fields<'_>) -> Extent {
        let nodes = self.window.every(fields.stride[1]);
        let [pressure, gap] = [&fields.pressure, &fields.gap].map(|values| range(nodes.of(values))[1]);
        Extent { pressure, gap, ..Extent::NONE }
    }

    fn settle(&self, to: &RecordingStream, extent: Extent) -> RecordingStreamResult<()> {
        if !self.what.has(Part::Fields) {
            return Ok(());
        }
        self.log_scaled(to, [self.pressure.fitted(extent.pressure), self.gap.fitted(extent.gap)])
    }

    /// Runs of nodes in contact with their edges; of columns of several nodes, half a spacing beyond the outer ones.
    fn segments(&self, fields: &Fields<'_>) -> Vec<[f32; 2]> {
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

/// The exact pressure, 0 where it is infinite.
fn finite_pressure(exact: &Exact) -> Vec<f64> {
    exact.pressure.iter().map(|p| if p.is_finite() { *p } else { 0.0 }).collect()
}

/// A curve with the height `y(i)` at sample `i`.
pub fn curve(nodes: &Samples, y: impl Fn(usize) -> f32) -> Vec<[f32; 2]> {
    Columns::new(nodes.count()).extremes(y).into_iter().map(|(i, y)| [nodes.place(i) * WIDTH, y]).collect()
}
