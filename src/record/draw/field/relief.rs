//! The solid under the indenter as a relief in three dimensions, coloured by the pressure. The front half is cut away, so that everyone sees where the
//! solid is and where the rigid surface: the section shows both, and the rigid surface is a grid above the solid.

use crate::plot::width;
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::field::relief_mesh::{RELIEF, ReliefMesh, ReliefStretch};
use crate::record::draw::field::relief_walls::{FOOT, Wall, edge};
use crate::record::draw::field::rigid_grid;
use crate::record::draw::fields::{FieldExtent, FrameFields, range};
use crate::record::draw::ink::canvas::PANE;
use crate::record::draw::ink::eye::Eye;
use crate::record::draw::ink::letter_lines::{RADIUS, letter_lines};
use crate::record::draw::ink::mirror::MeasuredPart;
use crate::record::draw::ink::palette::{Palette, colour};
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::record::draw::ink::ruler::measured;
use glam::Vec3;
use rerun::{LineStrips3D, Mesh3D, Radius, RecordingStream, RecordingStreamResult, Transform3D};
use std::ops::Range;

/// Size of the names of the sides, and from a side to the middle of its name.
const NAME: f64 = 0.5;
pub(crate) const NAME_GAP: f32 = 0.5;
/// Room for a name beside a side.
pub(crate) const NAMES: f32 = NAME_GAP + NAME as f32;
/// How far lines lie above the relief, which would hide them else, and in front of the section.
const ABOVE: f32 = 0.02;
/// Radii of the edges of the section, and of the contact in it.
const EDGE: f32 = 1.0;
const CONTACT: f32 = 3.0;
/// Heights of the eye that are tried, in radians above the horizon.
const ELEVATIONS: [f32; 2] = [0.45, 0.55];

/// The relief of the solid in a scene.
pub(crate) struct Relief {
    /// The title of its pane.
    title: String,
    mesh: ReliefMesh,
    walls: [Wall; 2],
    length_unit: String,
    /// The length of the side and of the section, in words.
    lengths: [String; 2],
    /// The part that was measured, if the rest is its mirror images.
    measured: Option<MeasuredPart>,
    /// Width and height of its pane.
    pane: [f64; 2],
    root: String,
}

/// The drawing of the relief of a surface.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(Relief::new(subject)))
}

impl Relief {
    fn new(subject: &Subject<'_>) -> Self {
        let Subject { scene, forecast, root, options, palette, .. } = subject;
        let grid = subject.grid();
        let mesh = ReliefMesh::new(grid, scene.problem.height(), forecast.max_pressure, palette).behind_the_middle();
        let (root, unit) = (format!("{root}/relief"), &options.length_unit);
        let (_, cut) = mesh.first();
        let drawn = f64::from(0.5 - cut / mesh.size[0]);
        Self {
            title: format!("{}: solid cut below the rigid surface", scene.title),
            walls: [Wall::section(&root, cut, palette), Wall::side(&root, 0.5 * mesh.size[1], palette)],
            length_unit: unit.clone(),
            lengths: [measured("y", unit, drawn * grid.size()[0]), measured("x", unit, grid.size()[1])],
            measured: MeasuredPart::new(scene),
            pane: PANE,
            mesh,
            root,
        }
    }

    /// The eye that sees it, with the names of its sides, as large as its pane allows.
    fn eye(&self) -> Eye {
        let [y, x] = self.mesh.size.map(|length| 0.5 * length);
        let (_, cut) = self.mesh.first();
        let ends = |side: bool, low: f32, high: f32| if side { high } else { low };
        let corner = |i: u8| {
            let [right, back, up] = [0, 1, 2].map(|axis| i >> axis & 1 == 1);
            let names = if up { 0.0 } else { NAMES };
            let x = ends(right, -x - names, x + names);
            Vec3::new(x, ends(back, cut - names, y), ends(up, FOOT, rigid_grid::CEILING))
        };
        Eye::around(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner), (self.pane[0] / self.pane[1]) as f32, ELEVATIONS)
    }

    fn solid(&self) -> String {
        format!("{}/solid", self.root)
    }

    /// The outline of the measured part, which is stretched with the mesh.
    fn outline(&self) -> String {
        format!("{}/measured", self.solid())
    }

    /// Stretches everything for all times, and writes how high the relief is.
    fn stretch(&self, to: &RecordingStream, [low, high]: [f64; 2]) -> RecordingStreamResult<()> {
        let stretch = ReliefStretch::new([low, high]);
        let ReliefStretch { factor, shift } = stretch;
        let transform = Transform3D::from_scale([1.0, 1.0, factor]).with_translation([0.0, 0.0, shift]);
        to.log_static(self.solid(), &transform)?;
        self.walls.iter().try_for_each(|wall| wall.stretch(to, stretch))?;
        rigid_grid::log(to, &self.root, &self.mesh, stretch)?;
        self.log_height(to, self.mesh.length(RELIEF / f64::from(factor)))
    }

    /// Records the height of the relief, at a bar on the left of the section.
    fn log_height(&self, to: &RecordingStream, height: f64) -> RecordingStreamResult<()> {
        let (_, cut) = self.mesh.first();
        let (left, bottom) = (-0.5 * self.mesh.size[1] - 0.5 * NAME_GAP, -RELIEF as f32);
        let words = measured("z", &self.length_unit, height);
        let beside = lines(&words, |[along, down]| [left - NAME_GAP + down, cut, 0.5 * bottom + along]);
        let bar = [[left, cut, 0.0], [left, cut, bottom]];
        let radius = Radius::new_scene_units(RADIUS * NAME as f32);
        let strips = LineStrips3D::new(beside.into_iter().map(|line| line.to_vec()).chain([bar.to_vec()]));
        let strips = strips.with_colors([colour(self.mesh.palette.ink)]).with_radii([radius]);
        to.log_static(format!("{}/height", self.root), &strips)
    }

    /// Records the edge of the section, and the contact along it.
    fn log_edge(&self, to: &RecordingStream, edge: &[Vec3], fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let in_front = |vertex: Vec3| [vertex.x, vertex.y - ABOVE, vertex.z];
        let line: Vec<[f32; 3]> = edge.iter().map(|vertex| in_front(*vertex)).collect();
        let touching = self.mesh.touching(fields);
        let contact = runs(&touching[..edge.len()]).map(|run| {
            let half_way = |vertex: usize| {
                let [one, other] = [vertex.saturating_sub(1), vertex.min(edge.len() - 1)].map(|i| Vec3::from(line[i]));
                one.midpoint(other).to_array()
            };
            let ends = [half_way(run.start), half_way(run.end)];
            ends[..1].iter().chain(&line[run]).chain(&ends[1..]).copied().collect::<Vec<_>>()
        });
        let contact: Vec<Vec<[f32; 3]>> = contact.collect();
        to.log(format!("{}/edge", self.solid()), &LineStrips3D::update_fields().with_strips([line.clone()]))?;
        to.log(format!("{}/contact", self.solid()), &LineStrips3D::update_fields().with_strips(contact))
    }
}

impl Drawing for Relief {
    fn panes(&self) -> Vec<(Place, Pane)> {
        vec![(Place::Main, PaneView::space(&self.title, (&self.root, self.eye()), self.mesh.palette))]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        self.pane = size(&self.root).unwrap_or(self.pane);
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { mesh, root, .. } = self;
        let palette = mesh.palette;
        to.log_static(self.solid(), &Mesh3D::update_fields().with_triangle_indices(mesh.triangles()))?;
        let counts = mesh.counts();
        let [section, side] = &self.walls;
        section.log_static(to, counts[1])?;
        side.log_static(to, counts[0])?;
        let style = |rgb, radius| {
            let style = LineStrips3D::update_fields().with_colors([colour(rgb)]);
            style.with_radii([Radius::new_ui_points(radius)])
        };
        if self.measured.is_some() {
            to.log_static(self.outline(), &style(palette.exact, 1.5))?;
        }
        to.log_static(format!("{}/edge", self.solid()), &style(edge(palette), EDGE))?;
        to.log_static(format!("{}/contact", self.solid()), &style(palette.contact, CONTACT))?;
        let [along_y, along_x] = &self.lengths;
        let (_, cut) = mesh.first();
        let [y, x] = mesh.size.map(|length| 0.5 * length);
        let below = (along_x.as_str(), Vec3::new(0.0, cut - NAME_GAP, FOOT));
        let beside = (along_y.as_str(), Vec3::new(x + NAME_GAP, cut.midpoint(y), FOOT));
        log_names(to, root, palette, [below, beside])?;
        let [low, _] = mesh.rigid_range();
        self.stretch(to, [low, low + RELIEF])
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let mesh = &self.mesh;
        let vertices = mesh.vertices(fields);
        let [_, columns] = mesh.counts();
        if let Some(measured) = &self.measured {
            let hidden = mesh.first().0 * columns;
            let above = |vertex: &usize| Some((vertices[vertex.checked_sub(hidden)?] + ABOVE * Vec3::Z).to_array());
            let dashes = measured.dashes(mesh.all_counts());
            let dashes = dashes.iter().map(|dash| dash.iter().filter_map(above).collect::<Vec<_>>());
            to.log(self.outline(), &LineStrips3D::update_fields().with_strips(dashes.filter(|dash| dash.len() > 1)))?;
        }
        let edge = &vertices[..columns];
        let right: Vec<Vec3> = vertices.iter().skip(columns - 1).step_by(columns).copied().collect();
        let [section, side] = &self.walls;
        section.log(to, edge)?;
        side.log(to, &right)?;
        self.log_edge(to, edge, fields)?;
        let relief = Mesh3D::update_fields()
            .with_vertex_colors(mesh.colours(fields, &vertices))
            .with_vertex_positions(vertices.iter().map(|vertex| vertex.to_array()));
        to.log(self.solid(), &relief)
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let relief = range(self.mesh.vertices(fields).into_iter().map(|vertex| f64::from(vertex.z)));
        FieldExtent { relief, ..FieldExtent::NONE }
    }

    /// Stretches the relief so that the final state is [`RELIEF`] high, for all times.
    fn settle(&self, to: &RecordingStream, extent: &FieldExtent) -> RecordingStreamResult<()> {
        self.stretch(to, extent.relief)
    }
}

/// The runs of true values.
fn runs(values: &[bool]) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..values.len()).filter(|&i| values[i] && (i == 0 || !values[i - 1]));
    starts.map(|start| start..start + values[start..].iter().take_while(|value| **value).count())
}

/// Records the names of the sides on the ground, each with the place of its middle: the one along x in front, the one along y on the right.
pub(crate) fn log_names(
    to: &RecordingStream,
    root: &str,
    palette: &Palette,
    [(along_x, below), (along_y, beside)]: [(&str, Vec3); 2],
) -> RecordingStreamResult<()> {
    let below = lines(along_x, |[along, down]| [below.x + along, below.y - down, below.z]);
    let beside = lines(along_y, |[along, down]| [beside.x + down, beside.y + along, beside.z]);
    let words = LineStrips3D::new(below.into_iter().chain(beside))
        .with_colors([colour(palette.ink)])
        .with_radii([Radius::new_scene_units(RADIUS * NAME as f32)]);
    to.log_static(format!("{root}/labels"), &words)
}

/// The lines that fill the letters of words. `place` puts each end from its distance from the middle along the words, and below it.
fn lines(words: &str, place: impl Fn([f32; 2]) -> [f32; 3]) -> Vec<[[f32; 3]; 2]> {
    let half = 0.5 * width(words, NAME) as f32;
    let lines = letter_lines(words, NAME).into_iter();
    lines.map(|line| line.map(|[along, down]| place([along - half, down]))).collect()
}
