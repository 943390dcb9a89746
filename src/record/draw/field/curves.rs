//! Pressure and gap along a line, as curves.

use crate::plot::Axis;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields, range};
use crate::record::draw::ink::canvas::{self, style};
use crate::record::draw::ink::line_plane::{LinePlane, WIDTH, curve};
use crate::record::draw::ink::palette;
use crate::record::draw::ink::pane::Pane;
use crate::record::draw::ink::reduce::Columns;
use crate::record::draw::ink::ruler::Ruler;
use crate::record::draw::ink::strips::strips_of;
use crate::record::draw::ink::window::Samples;
use crate::record::sdk::Float32;
use crate::theory::Exact;
use rerun::{AnyValues, AsComponents, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// The curves of pressure and gap, and the exact pressure where it is known.
pub(crate) struct FieldCurves {
    plane: LinePlane,
    pressure: Ruler,
    gap: Ruler,
    exact: Option<Vec<f64>>,
}

impl FieldCurves {
    /// The curves on the canvas of a line.
    pub(crate) fn new(subject: &Subject<'_>, plane: &LinePlane) -> Self {
        let problem = subject.scene.problem;
        let [low, high] = range(plane.window.every(1).values(problem.height()));
        Self {
            plane: plane.clone(),
            pressure: Ruler::pressure(subject.forecast.max_pressure, problem.contact_modulus()),
            gap: Ruler::gap(high - low, problem.rms_height()),
            exact: subject.scene.exact.as_ref().map(finite_pressure),
        }
    }

    /// Values upwards from the lower edge of the box.
    fn rising(&self, nodes: &Samples, values: &[f64], ruler: &Ruler) -> Vec<[f32; 2]> {
        curve(nodes, |i| self.plane.level(values[nodes.node(i)], ruler))
    }

    /// The axes of pressure and gap, and the curves stretched to them: frames recorded before stay right.
    fn log_scaled(&self, to: &RecordingStream, axes: [Axis; 2]) -> RecordingStreamResult<()> {
        let LinePlane { root, palette, .. } = &self.plane;
        for ((name, ruler), axis) in [("pressure", &self.pressure), ("gap", &self.gap)].into_iter().zip(axes) {
            canvas::log_axes(to, palette, &format!("{root}/{name}/axes"), &self.plane.frame_with(&axis))?;
            let stretch = axis.place(ruler.axis.range[1]) as f32;
            let transform = Transform3D::from_translation([0.0, self.plane.height() * (1.0 - stretch), 0.0]);
            to.log_static(format!("{root}/{name}/curves"), &transform.with_scale([1.0, stretch, 1.0]))?;
        }
        Ok(())
    }

    /// Records the curve of a field in pieces, each with its position `x` and the value that it represents, of those of
    /// its nodes the one that `pick` prefers: numbers for programs, and for the text at the pointer.
    fn log_field(
        &self,
        to: &RecordingStream,
        name: &'static str,
        nodes: &Samples,
        field: &[f64],
        ruler: &Ruler,
        pick: impl Fn(f64, f64) -> f64,
    ) -> RecordingStreamResult<()> {
        let curve = Columns::new(nodes.count()).curve(|i| field[nodes.node(i)]);
        let place = |&(i, value): &(usize, f64)| [nodes.place(i) * WIDTH, self.plane.level(value, ruler)];
        let places: Vec<[f32; 2]> = curve.points.iter().map(place).collect();
        let [start, end] = self.plane.ends;
        let position = |sample: f64| f64::from(nodes.place(0)) + sample * f64::from(nodes.spacing());
        let (x, values): (Vec<_>, Vec<_>) = curve
            .values(pick)
            .map(|(sample, value)| ((start + position(sample) * (end - start)) as f32, value as f32))
            .unzip();
        let values = AnyValues::default()
            .with_component_override::<Float32>("x", "length", x)
            .with_component_override::<Float32>(name, name, values);
        let strips = strips_of(&places, curve.pieces());
        to.log(format!("{}/{name}/curves/{name}", self.plane.root), &[&strips as &dyn AsComponents, &values])
    }
}

impl Drawing for FieldCurves {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let pressure = if self.exact.is_some() { "Pressure (green, dashed: exact)" } else { "Pressure" };
        [("pressure", pressure), ("gap", "Gap")]
            .map(|(picture, title)| (Place::Field, self.plane.pane(picture, title, true)))
            .into()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.plane.root).into_iter().for_each(|size| self.plane.fit(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let LinePlane { root, palette, .. } = &self.plane;
        let [pressure, gap] = ["pressure", "gap"].map(|name| format!("{root}/{name}/curves"));
        to.log_static(format!("{pressure}/pressure"), &style(palette.pressure, Radius::new_ui_points(1.4), 32.0))?;
        to.log_static(format!("{gap}/gap"), &style(palette.gap, Radius::new_ui_points(1.0), 32.0))?;
        if let Some(exact) = &self.exact {
            let curve = self.rising(&self.plane.window.every(1), exact, &self.pressure);
            let curve: Vec<[f64; 2]> = curve.into_iter().map(|point| point.map(f64::from)).collect();
            let line = style(palette.exact, Radius::new_ui_points(1.0), 38.0);
            to.log_static(format!("{pressure}/exact"), &line.with_strips(canvas::dashed(&curve)))?;
        }
        ["pressure", "gap"].into_iter().try_for_each(|picture| self.plane.log_measured(to, picture))?;
        self.log_scaled(to, [self.pressure.axis.clone(), self.gap.axis.clone()])
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let nodes = self.plane.window.every(fields.stride[1]);
        self.log_field(to, "pressure", &nodes, &fields.pressure, &self.pressure, f64::max)?;
        self.log_field(to, "gap", &nodes, &fields.gap, &self.gap, f64::min)
    }

    fn log_earlier(&self, to: &RecordingStream, pressure: &[f64]) -> RecordingStreamResult<()> {
        let nodes = self.plane.window.nodes;
        let pressure: Vec<f64> = (0..nodes).map(|i| pressure[i * pressure.len() / nodes]).collect();
        let curve = self.rising(&self.plane.window.every(1), &pressure, &self.pressure);
        let line = style(palette::GHOST, Radius::new_ui_points(0.7), 35.0);
        to.log_static(format!("{}/pressure/curves/ghost", self.plane.root), &line.with_strips([curve]))
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let nodes = self.plane.window.every(fields.stride[1]);
        let [pressure, gap] = [&fields.pressure, &fields.gap].map(|values| range(nodes.values(values))[1]);
        FieldExtent { pressure, gap, ..FieldExtent::NONE }
    }

    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        self.log_scaled(to, [self.pressure.fitted(extent.pressure), self.gap.fitted(extent.gap)])
    }
}

/// The exact pressure, 0 where it is infinite.
fn finite_pressure(exact: &Exact) -> Vec<f64> {
    exact.pressure.iter().map(|p| if p.is_finite() { *p } else { 0.0 }).collect()
}
