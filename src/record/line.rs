//! The pictures of a line: the indenter above the solid, the pressure and the gap along it.

use super::Options;
use super::axes::{Axis, Frame};
use super::field::CONTACT_CLASS;
use super::fill;
use super::forecast::Forecast;
use super::palette::{self, colour};
use super::part::{Part, Parts};
use super::scene::{self, Extent, Fields, Scene, range};
use super::window::{Samples, Window};
use rerun::{EntityPath, LineStrip2D, LineStrips2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Width and height of the boxes on the canvas.
const BOX: [f32; 2] = [1000.0, 400.0];
/// Height of a line of text on the canvas.
const TEXT: f32 = 20.0;
/// Room above and below the profile, in heights of the profile.
const ROOM: f64 = 0.06;

type Points = Vec<[f32; 2]>;

/// What is drawn of a line, and where.
pub struct LinePicture {
    what: Parts,
    window: Window,
    /// Where the indenter lies on the canvas, for all nodes of the window; empty if it is not shown.
    indenter: Vec<f32>,
    profile: Frame,
    pressure: Frame,
    gap: Frame,
    contact_modulus: f64,
    rms_height: f64,
    entities: Entities,
}

/// The entities that change from frame to frame.
struct Entities {
    solid: EntityPath,
    solid_fill: EntityPath,
    contact: EntityPath,
    pressure: EntityPath,
    gap: EntityPath,
}

impl Entities {
    fn under(root: &str) -> Self {
        Self {
            solid: format!("{root}/profile/solid").into(),
            solid_fill: format!("{root}/profile/solid_fill").into(),
            contact: format!("{root}/contact").into(),
            pressure: format!("{root}/pressure/curves/pressure").into(),
            gap: format!("{root}/gap/curves/gap").into(),
        }
    }
}

impl LinePicture {
    /// The picture of `scene`.
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, options: &Options) -> Self {
        let problem = scene.problem;
        let window = Window::around(scene);
        let spacing = problem.surface().grid().spacing()[1];
        let [left, right] = window.ends(spacing);
        let x = scene::length_axis("x", &options.length_unit, left, right);
        let frame = |y: Axis| Frame { x: x.clone(), y, width: BOX[0], height: BOX[1], text: TEXT };
        let nodes = window.every(1);
        let (low, high) = range(nodes.of(problem.height()));
        let room = ROOM * (high - low);
        let z = scene::length_axis("z", &options.length_unit, -high - 2.0 * room, -low + room);
        let profile = frame(z);
        let shown = options.what.has(Part::Profile).then(|| nodes.of(problem.height()));
        let indenter = shown.into_iter().flatten().map(|h| profile.place_y(-h)).collect();
        Self {
            what: options.what,
            indenter,
            window,
            profile,
            pressure: frame(scene::pressure_axis(forecast.max_pressure / problem.contact_modulus())),
            gap: frame(scene::gap_axis((high - low) / problem.rms_height())),
            contact_modulus: problem.contact_modulus(),
            rms_height: problem.rms_height(),
            entities: Entities::under(root),
        }
    }

    /// The frame of the first of the three pictures, which lie at the same place.
    pub fn frame(&self) -> &Frame {
        &self.profile
    }

    /// The part of the canvas that each of the three pictures takes.
    pub fn bounds(&self) -> [f64; 4] {
        self.profile.bounds()
    }

    /// Records what stays: axes, styles, the indenter, the exact pressure.
    pub fn log_static(&self, to: &RecordingStream, root: &str, scene: &Scene<'_>) -> RecordingStreamResult<()> {
        if self.what.has(Part::Profile) {
            self.log_profile(to, root)?;
        }
        if self.what.has(Part::Fields) {
            self.log_fields(to, root, scene)?;
        }
        if self.what.has(Part::Mask) {
            let contact = style(palette::CONTACT, Radius::new_ui_points(2.5), 34.0);
            let contact = contact.with_class_ids([CONTACT_CLASS]).with_show_labels(false);
            to.log_static(self.entities.contact.clone(), &contact)?;
        }
        if self.shows_contact_alone() {
            self.profile.log_floor(to, &format!("{root}/contact/axes"))?;
        }
        Ok(())
    }

    /// Whether the contact has a picture of its own, for want of others to lie in.
    pub fn shows_contact_alone(&self) -> bool {
        self.what.has(Part::Mask) && !self.what.has_any([Part::Profile, Part::Fields])
    }

    fn log_fields(&self, to: &RecordingStream, root: &str, scene: &Scene<'_>) -> RecordingStreamResult<()> {
        let Entities { pressure, gap, .. } = &self.entities;
        to.log_static(pressure.clone(), &style(palette::PRESSURE, Radius::new_ui_points(1.4), 32.0))?;
        to.log_static(gap.clone(), &style(palette::GAP, Radius::new_ui_points(1.0), 32.0))?;
        if let Some(exact) = &scene.exact {
            let pressure = exact.pressure.iter().map(|p| if p.is_finite() { *p } else { 0.0 }).collect::<Vec<_>>();
            let curve = self.pressure_curve(&self.window.every(1), &pressure);
            let line = style(palette::EXACT, Radius::new_ui_points(0.5), 36.0);
            to.log_static(format!("{root}/pressure/curves/exact"), &line.with_strips([LineStrip2D::from_iter(curve)]))?;
        }
        self.log_scaled(to, root, [self.pressure.y.high(), self.gap.y.high()])
    }

    /// The contact, as segments along the lower edge of the box.
    pub fn contact(&self, fields: &Fields<'_>) -> Vec<[[f32; 2]; 2]> {
        segments(&self.window.every(fields.stride[1]), fields.pressure)
    }

    /// Records a state at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let nodes = self.window.every(fields.stride[1]);
        if self.what.has(Part::Profile) {
            let solid = self.solid_curve(&nodes, fields.gap);
            to.log(self.entities.solid_fill.clone(), &strip(fill::bars(&solid, BOX[0], BOX[1], f32::max)))?;
            to.log(self.entities.solid.clone(), &strip(solid))?;
        }
        if self.what.has(Part::Fields) {
            to.log(self.entities.pressure.clone(), &strip(self.pressure_curve(&nodes, fields.pressure)))?;
            to.log(self.entities.gap.clone(), &strip(self.gap_curve(&nodes, fields.gap)))?;
        }
        if self.what.has(Part::Mask) {
            let contact = LineStrips2D::update_fields().with_strips(self.contact(fields));
            to.log(self.entities.contact.clone(), &contact)?;
        }
        Ok(())
    }

    /// Records the `pressure` of an earlier solve, on any number of nodes, along the same line.
    pub fn log_ghost(&self, to: &RecordingStream, root: &str, pressure: &[f64]) -> RecordingStreamResult<()> {
        let nodes = self.window.nodes();
        let pressure: Vec<f64> = (0..nodes).map(|i| pressure[i * pressure.len() / nodes]).collect();
        let curve = self.pressure_curve(&self.window.every(1), &pressure);
        let line = style(palette::GHOST, Radius::new_ui_points(0.7), 35.0);
        to.log_static(format!("{root}/pressure/curves/ghost"), &line.with_strips([LineStrip2D::from_iter(curve)]))
    }

    /// How far the fields of a state reach in the window.
    pub fn extent(&self, fields: &Fields<'_>) -> Extent {
        let nodes = self.window.every(fields.stride[1]);
        let [pressure, gap] = [fields.pressure, fields.gap].map(|values| range(nodes.of(values)).1);
        Extent { pressure, gap, ..Extent::NONE }
    }

    /// Fits the axes of pressure and gap, for all times.
    pub fn settle(&self, to: &RecordingStream, root: &str, extent: Extent) -> RecordingStreamResult<()> {
        if !self.what.has(Part::Fields) {
            return Ok(());
        }
        let pressure = extent.pressure / self.contact_modulus;
        let gap = (extent.gap / self.rms_height).max(scene::LEAST_GAP);
        self.log_scaled(to, root, [scene::headroom(pressure), scene::headroom(gap)])
    }

    fn log_profile(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        self.profile.log(to, &format!("{root}/profile/axes"))?;
        let fill_radius = Radius::new_scene_units(fill::radius(BOX[0]));
        let Entities { solid, solid_fill, .. } = &self.entities;
        to.log_static(solid.clone(), &style(palette::SOLID, Radius::new_ui_points(1.0), 32.0))?;
        to.log_static(solid_fill.clone(), &style(palette::SOLID_FILL, fill_radius, 10.0))?;
        self.log_indenter(to, root)
    }

    fn log_indenter(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        let curve = curve(&self.window.every(1), |i| self.indenter[i]);
        let radius = Radius::new_scene_units(fill::radius(BOX[0]));
        let body = style(palette::INDENTER_FILL, radius, 8.0);
        let line = style(palette::INDENTER, Radius::new_ui_points(0.8), 30.0);
        let bars = LineStrip2D::from_iter(fill::bars(&curve, BOX[0], 0.0, f32::min));
        to.log_static(format!("{root}/profile/indenter_fill"), &body.with_strips([bars]))?;
        to.log_static(format!("{root}/profile/indenter"), &line.with_strips([LineStrip2D::from_iter(curve)]))
    }

    /// Axes of pressure and gap up to `highs`, and the curves stretched to them: frames recorded before stay right.
    fn log_scaled(&self, to: &RecordingStream, root: &str, highs: [f64; 2]) -> RecordingStreamResult<()> {
        for ((name, frame), high) in [("pressure", &self.pressure), ("gap", &self.gap)].into_iter().zip(highs) {
            let scaled = Frame { y: frame.y.up_to(high), ..frame.clone() };
            scaled.log(to, &format!("{root}/{name}/axes"))?;
            let stretch = (frame.y.span() / scaled.y.span()) as f32;
            let transform = Transform3D::from_translation([0.0, frame.height * (1.0 - stretch), 0.0]);
            to.log_static(format!("{root}/{name}/curves"), &transform.with_scale([1.0, stretch, 1.0]))?;
        }
        Ok(())
    }

    /// The solid, a gap below the nodes of the indenter.
    fn solid_curve(&self, nodes: &Samples, gap: &[f64]) -> Points {
        let drop = f64::from(self.profile.height) / self.profile.y.span();
        let level = |i| self.indenter[nodes.offset(i)] + (gap[nodes.node(i)] * drop) as f32;
        curve(nodes, |i| level(i).clamp(0.0, self.profile.height))
    }

    fn pressure_curve(&self, nodes: &Samples, pressure: &[f64]) -> Points {
        rising(nodes, pressure, &self.pressure, self.contact_modulus)
    }

    fn gap_curve(&self, nodes: &Samples, gap: &[f64]) -> Points {
        rising(nodes, gap, &self.gap, self.rms_height)
    }
}

/// Values over `unit`, upwards from the lower edge of the box.
fn rising(nodes: &Samples, values: &[f64], frame: &Frame, unit: f64) -> Points {
    let rise = f64::from(frame.height) / (frame.y.span() * unit);
    curve(nodes, |i| frame.height - (values[nodes.node(i)] * rise) as f32)
}

/// A curve with the height `y(i)` at sample `i`.
fn curve(nodes: &Samples, y: impl Fn(usize) -> f32) -> Points {
    nodes.columns().extremes(y).into_iter().map(|(i, y)| [nodes.place(i) * BOX[0], y]).collect()
}

/// Runs of nodes in contact; a node in contact is half a spacing long to either side.
fn segments(nodes: &Samples, pressure: &[f64]) -> Vec<[[f32; 2]; 2]> {
    let runs = nodes.columns().runs(|i| pressure[nodes.node(i)] > 0.0);
    let end = |i: usize| [((nodes.place(i) - 0.5 * nodes.spacing()) * BOX[0]).clamp(0.0, BOX[0]), BOX[1]];
    runs.into_iter().map(|run| [end(run.start), end(run.end)]).collect()
}

/// A strip without its style, which is recorded once.
fn strip(points: Points) -> LineStrips2D {
    LineStrips2D::update_fields().with_strips([LineStrip2D::from_iter(points)])
}

fn style(rgb: u32, radius: Radius, order: f32) -> LineStrips2D {
    LineStrips2D::update_fields().with_colors([colour(rgb)]).with_radii([radius]).with_draw_order(order)
}
