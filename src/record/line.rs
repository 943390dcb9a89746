//! The pictures of a line: the indenter above the solid, the pressure and the gap along it.

use super::axes::{Axis, Frame};
use super::field::CONTACT_CLASS;
use super::fill;
use super::forecast::Forecast;
use super::palette::{self, colour};
use super::reduce::Columns;
use super::scene::{self, Fields, Scene, range};
use rerun::{EntityPath, LineStrip2D, LineStrips2D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Width and height of the boxes on the canvas.
const BOX: [f32; 2] = [1000.0, 400.0];
/// Height of a line of text on the canvas.
const TEXT: f32 = 20.0;
/// Width of the window around a contact that is known beforehand, in widths of that contact.
const WINDOW: f64 = 2.5;
/// Room above and below the profile, in heights of the profile.
const ROOM: f64 = 0.06;

type Points = Vec<[f32; 2]>;

/// What is drawn of a line, and where.
pub struct LinePicture {
    window: Window,
    columns: Columns,
    /// Where the indenter lies on the canvas, for the nodes of the window.
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

/// The nodes shown: `shown` of the `nodes` of the period, from node `start` on and across the period.
#[derive(Clone, Copy)]
struct Window {
    start: usize,
    shown: usize,
    nodes: usize,
}

impl Window {
    /// The whole line, or the surroundings of a contact that is known to be single.
    fn around(scene: &Scene<'_>) -> Self {
        let height = scene.problem.height();
        let nodes = height.len();
        let Some(exact) = &scene.exact else { return Self { start: 0, shown: nodes, nodes } };
        let shown = ((WINDOW * exact.relative_area * nodes as f64) as usize).clamp(16.min(nodes), nodes);
        let peak = (0..nodes).fold(0, |peak, i| if height[i] > height[peak] { i } else { peak });
        Self { start: (peak + nodes - shown / 2) % nodes, shown, nodes }
    }

    /// The node of the period behind place `i` of the window.
    fn node(&self, i: usize) -> usize {
        let node = self.start + i;
        if node < self.nodes { node } else { node - self.nodes }
    }

    /// First and last position; a window across the period starts at a negative one.
    fn ends(&self, spacing: f64) -> [f64; 2] {
        let start = self.start as f64 - if self.start + self.shown > self.nodes { self.nodes as f64 } else { 0.0 };
        [start * spacing, (start + self.shown as f64) * spacing]
    }

    /// Points of a curve over the window, which ends on the first node beyond it.
    fn points(&self) -> usize {
        self.shown + 1
    }

    /// The values of the window, in its order.
    fn of<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        (0..self.points()).map(|i| values[self.node(i)])
    }
}

impl LinePicture {
    /// The picture of `scene`, with lengths in `unit`.
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, unit: &str) -> Self {
        let problem = scene.problem;
        let window = Window::around(scene);
        let spacing = problem.surface().grid().spacing()[1];
        let [left, right] = window.ends(spacing);
        let x = scene::length_axis("x", unit, left, right);
        let frame = |y: Axis| Frame { x: x.clone(), y, width: BOX[0], height: BOX[1], text: TEXT };
        let (low, high) = range(window.of(problem.height()));
        let room = ROOM * (high - low);
        let profile = frame(scene::length_axis("z", unit, -high - 2.0 * room, -low + room));
        Self {
            columns: Columns::new(window.points()),
            indenter: window.of(problem.height()).map(|h| profile.place_y(-h)).collect(),
            window,
            profile,
            pressure: frame(scene::pressure_axis(forecast.max_pressure / problem.contact_modulus())),
            gap: frame(scene::gap_axis((high - low) / problem.rms_height())),
            contact_modulus: problem.contact_modulus(),
            rms_height: problem.rms_height(),
            entities: Entities::under(root),
        }
    }

    /// The part of the canvas that each of the three pictures takes.
    pub fn bounds(&self) -> [f64; 4] {
        self.profile.bounds()
    }

    /// Records what stays: axes, styles, the indenter, the exact pressure.
    pub fn log_static(&self, to: &RecordingStream, root: &str, scene: &Scene<'_>) -> RecordingStreamResult<()> {
        self.profile.log(to, &format!("{root}/profile/axes"))?;
        self.log_styles(to)?;
        self.log_indenter(to, root)?;
        if let Some(exact) = &scene.exact {
            let pressure = exact.pressure.iter().map(|p| if p.is_finite() { *p } else { 0.0 }).collect::<Vec<_>>();
            let curve = self.placed(&self.pressure_points(&pressure));
            let line = style(palette::EXACT, Radius::new_ui_points(0.5), 36.0);
            to.log_static(format!("{root}/pressure/curves/exact"), &line.with_strips([LineStrip2D::from_iter(curve)]))?;
        }
        self.log_scaled(to, root, [self.pressure.y.high(), self.gap.y.high()])
    }

    /// Records a state at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let solid = self.placed(&self.solid_points(fields.gap));
        to.log(self.entities.solid_fill.clone(), &strip(fill::bars(&solid, BOX[0], BOX[1], f32::max)))?;
        to.log(self.entities.solid.clone(), &strip(solid))?;
        to.log(self.entities.pressure.clone(), &strip(self.placed(&self.pressure_points(fields.pressure))))?;
        to.log(self.entities.gap.clone(), &strip(self.placed(&self.gap_points(fields.gap))))?;
        let contact = LineStrips2D::update_fields().with_strips(self.segments(fields.pressure));
        to.log(self.entities.contact.clone(), &contact)
    }

    /// Fits the axes of pressure and gap to the final state, for all times.
    pub fn settle(&self, to: &RecordingStream, root: &str, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let pressure = range(self.window.of(fields.pressure)).1 / self.contact_modulus;
        let gap = (range(self.window.of(fields.gap)).1 / self.rms_height).max(scene::LEAST_GAP);
        self.log_scaled(to, root, [scene::headroom(pressure), scene::headroom(gap)])
    }

    fn log_styles(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let fill_radius = Radius::new_scene_units(fill::radius(BOX[0]));
        let Entities { solid, solid_fill, contact, pressure, gap } = &self.entities;
        to.log_static(solid.clone(), &style(palette::SOLID, Radius::new_ui_points(1.0), 32.0))?;
        to.log_static(solid_fill.clone(), &style(palette::SOLID_FILL, fill_radius, 10.0))?;
        to.log_static(pressure.clone(), &style(palette::PRESSURE, Radius::new_ui_points(1.4), 32.0))?;
        to.log_static(gap.clone(), &style(palette::GAP, Radius::new_ui_points(1.0), 32.0))?;
        let contact_style = style(palette::CONTACT, Radius::new_ui_points(2.5), 34.0);
        to.log_static(contact.clone(), &contact_style.with_class_ids([CONTACT_CLASS]).with_show_labels(false))
    }

    fn log_indenter(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        let curve = self.placed(&self.columns.extremes(|i| self.indenter[i]));
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

    fn solid_points(&self, gap: &[f64]) -> Vec<(usize, f32)> {
        let drop = f64::from(self.profile.height) / self.profile.y.span();
        let floor = self.profile.height;
        self.columns.extremes(|i| (self.indenter[i] + (gap[self.window.node(i)] * drop) as f32).clamp(0.0, floor))
    }

    fn pressure_points(&self, pressure: &[f64]) -> Vec<(usize, f32)> {
        self.rising(pressure, &self.pressure, self.contact_modulus)
    }

    fn gap_points(&self, gap: &[f64]) -> Vec<(usize, f32)> {
        self.rising(gap, &self.gap, self.rms_height)
    }

    fn rising(&self, values: &[f64], frame: &Frame, unit: f64) -> Vec<(usize, f32)> {
        let rise = f64::from(frame.height) / (frame.y.span() * unit);
        self.columns.extremes(|i| frame.height - (values[self.window.node(i)] * rise) as f32)
    }

    fn placed(&self, points: &[(usize, f32)]) -> Points {
        points.iter().map(|&(i, y)| [self.place_x(i as f32), y]).collect()
    }

    fn place_x(&self, i: f32) -> f32 {
        i * BOX[0] / self.window.shown as f32
    }

    /// The contact, as segments along the lower edge of the box; a node in contact is half a spacing long to either side.
    fn segments(&self, pressure: &[f64]) -> Vec<[[f32; 2]; 2]> {
        let runs = self.columns.runs(|i| pressure[self.window.node(i)] > 0.0);
        let end = |i: usize| [self.place_x(i as f32 - 0.5).clamp(0.0, BOX[0]), BOX[1]];
        runs.into_iter().map(|run| [end(run.start), end(run.end)]).collect()
    }
}

/// A strip without its style, which is recorded once.
fn strip(points: Points) -> LineStrips2D {
    LineStrips2D::update_fields().with_strips([LineStrip2D::from_iter(points)])
}

fn style(rgb: u32, radius: Radius, order: f32) -> LineStrips2D {
    LineStrips2D::update_fields().with_colors([colour(rgb)]).with_radii([radius]).with_draw_order(order)
}
