//! The solid under the indenter as a relief in three dimensions, coloured by the pressure.

use crate::grid::Grid;
use crate::plot::{letters, width};
use crate::record::draw::drawing::{Drawing, Place, Subject};
use crate::record::draw::fields::{FieldExtent, FrameFields, range};
use crate::record::draw::ink::canvas::{LETTER, PANE};
use crate::record::draw::ink::eye::Eye;
use crate::record::draw::ink::fill;
use crate::record::draw::ink::mirror::MeasuredPart;
use crate::record::draw::ink::palette::{ColourMap, FAINT, Palette, colour};
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::record::draw::ink::reduce::Blocks;
use crate::record::draw::ink::ruler::measured;
use glam::Vec3;
use rerun::{Color, LineStrips3D, Mesh3D, Radius, RecordingStream, RecordingStreamResult, Transform3D};

/// Largest number of vertices along a side, without the one that closes the period.
const VERTICES: usize = 128;
/// Length of the longer side.
const LENGTH: f64 = 10.0;
/// Size of the names of the sides, and from a side to the middle of its name.
const NAME: f64 = 0.6;
const NAME_GAP: f32 = 0.6;
/// Height of the final relief.
const RELIEF: f64 = 1.6;
/// Height of the outline of the measured part above the relief, which would hide it else.
const ABOVE: f32 = 0.02;

/// A mesh over the cell. Its heights are exaggerated so that the final relief is [`RELIEF`] high.
///
/// A block of nodes belongs to each vertex, which lies at the first of them.
pub struct Relief {
    /// The title of its pane.
    title: String,
    blocks: Blocks,
    /// Nodes from vertex to vertex along y and x.
    spacing: [usize; 2],
    /// Height of the indenter at the vertices.
    height: Vec<f64>,
    size: [f32; 2],
    /// Height of the drawing over that of the solid, before the final state is known.
    exaggeration: f64,
    highest_pressure: f64,
    shades: ColourMap,
    palette: &'static Palette,
    /// Lengths along y and x, in words.
    lengths: [String; 2],
    /// The part that was measured, if the rest is its mirror images.
    measured: Option<MeasuredPart>,
    /// Width and height of its pane.
    pane: [f64; 2],
    root: String,
}

/// The drawing of the relief of a surface.
pub fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(Relief::new(subject)))
}

impl Relief {
    /// The relief of the solid in a scene.
    fn new(subject: &Subject<'_>) -> Self {
        let Subject { scene, forecast, root, options, palette, .. } = subject;
        let unit = &options.length_unit;
        let relief = Self::over(subject.grid(), scene.problem.height(), forecast.max_pressure, palette, root, unit);
        let title = format!("{}: the solid's surface, coloured by pressure", scene.title);
        Self { title, measured: MeasuredPart::new(scene), ..relief }
    }

    /// The relief of what lies at a gap below heights, coloured up to the highest pressure.
    pub fn over(
        grid: &Grid,
        heights: &[f64],
        highest_pressure: f64,
        palette: &'static Palette,
        root: &str,
        unit: &str,
    ) -> Self {
        let shape = grid.shape();
        let spacing = spacing(grid);
        let [rows, columns] = [0, 1].map(|axis| (0..shape[axis]).step_by(spacing[axis]));
        let of_row = |y: usize| columns.clone().map(move |x| heights[y * shape[1] + x]);
        let height: Vec<f64> = rows.clone().flat_map(of_row).collect();
        let [low, high] = range(height.iter().copied());
        let longest = grid.longest_wavelength();
        Self {
            title: String::new(),
            blocks: Blocks { shape, cells: [rows.len(), columns.len()] },
            spacing,
            exaggeration: RELIEF / (high - low).max(f64::MIN_POSITIVE),
            height,
            size: grid.size().map(|length| (LENGTH * length / longest) as f32),
            highest_pressure,
            shades: ColourMap::inferno(),
            palette,
            lengths: [0, 1].map(|axis| measured(["y", "x"][axis], unit, grid.size()[axis])),
            measured: None,
            pane: PANE,
            root: format!("{root}/relief"),
        }
    }

    /// Takes the proportions of a pane, width and height in points.
    pub fn fit_pane(&mut self, pane: [f64; 2]) {
        self.pane = pane;
    }

    /// The eye that sees it, with the names of its sides, as large as its pane allows.
    pub fn eye(&self) -> Eye {
        let [y, x] = self.size.map(|length| length / 2.0);
        let names = NAME_GAP + NAME as f32;
        let ends = |side: bool, low: f32, high: f32| if side { high } else { low };
        let corner = |i: u8| {
            let [right, back, up] = [0, 1, 2].map(|axis| i >> axis & 1 == 1);
            let names = if up { 0.0 } else { names };
            Vec3::new(ends(right, -x, x + names), ends(back, -y - names, y), ends(up, -RELIEF as f32, 0.0))
        };
        Eye::around(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner), (self.pane[0] / self.pane[1]) as f32)
    }

    /// The root of its entities.
    pub fn root(&self) -> &str {
        &self.root
    }

    fn mesh(&self) -> String {
        format!("{}/solid", self.root)
    }

    /// The outline of the measured part, which is stretched with the mesh.
    fn measured(&self) -> String {
        format!("{}/measured", self.mesh())
    }

    /// Vertices along y and x, with the ones that close the period.
    fn counts(&self) -> [usize; 2] {
        self.blocks.cells.map(|n| n + 1)
    }

    /// The results of `value` at the positions of all vertices along y and x, in nodes of the scene. On a grid coarser than
    /// the mesh, vertices fall on the node before them: what is left of the triangles spans the nodes of that grid.
    fn at_vertices<T>(&self, stride: [usize; 2], value: impl Fn([usize; 2]) -> T) -> Vec<T> {
        let [rows, columns] = self.counts();
        let node = |axis: usize, i: usize| {
            let node = (i * self.spacing[axis]).min(self.blocks.shape[axis]);
            node - node % stride[axis]
        };
        (0..rows * columns).map(|i| value([node(0, i / columns), node(1, i % columns)])).collect()
    }

    /// The block whose vertex lies at `node`, which may be the one that closes the period.
    fn block(&self, node: [usize; 2]) -> usize {
        let [y, x] = self.within(node);
        y / self.spacing[0] * self.blocks.cells[1] + x / self.spacing[1]
    }

    /// `node`, or its image in the period.
    fn within(&self, node: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|axis| node[axis] % self.blocks.shape[axis])
    }

    fn vertices(&self, fields: &FrameFields<'_>) -> Vec<Vec3> {
        let FrameFields { stride, gap, .. } = fields;
        let ([ny, nx], [ly, lx]) = (self.blocks.shape, self.size);
        let place = |node: usize, nodes: usize, length: f32| (node as f32 / nodes as f32 - 0.5) * length;
        self.at_vertices(*stride, |node| {
            let [y, x] = self.within(node);
            let level = self.height[self.block(node)] + gap[y / stride[0] * (nx / stride[1]) + x / stride[1]];
            Vec3::new(place(node[1], nx, lx), place(node[0], ny, ly), (-level * self.exaggeration) as f32)
        })
    }

    fn normals(&self, vertices: &[Vec3], stride: [usize; 2]) -> Vec<Vec3> {
        let [rows, columns] = self.counts();
        let [down, right] = [0, 1].map(|axis| (stride[axis] / self.spacing[axis]).max(1));
        let at = |row: usize, column: usize| vertices[row.min(rows - 1) * columns + column.min(columns - 1)];
        let normal = |i: usize| {
            let (row, column) = (i / columns, i % columns);
            let along_x = at(row, column + right) - at(row, column.saturating_sub(right));
            let along_y = at(row + down, column) - at(row.saturating_sub(down), column);
            along_x.cross(along_y).normalize_or(Vec3::Z)
        };
        (0..vertices.len()).map(normal).collect()
    }

    fn colours(&self, fields: &FrameFields<'_>) -> Vec<Color> {
        let pressure = self.blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
        let shade = |p: f64| {
            if p > 0.0 { self.shades.at(0.25 + 0.75 * p / self.highest_pressure) } else { colour(self.palette.relief) }
        };
        self.at_vertices(fields.stride, |node| shade(pressure[self.block(node)]))
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        let [rows, columns] = self.counts().map(|n| n as u32);
        let square = |row: u32, column: u32| {
            let corner = row * columns + column;
            [[corner, corner + 1, corner + columns + 1], [corner, corner + columns + 1, corner + columns]]
        };
        (0..rows - 1).flat_map(|row| (0..columns - 1).flat_map(move |column| square(row, column))).collect()
    }
}

impl Drawing for Relief {
    fn panes(&self) -> Vec<(Place, Pane)> {
        vec![(Place::Main, PaneView::space(&self.title, (&self.root, self.eye()), self.palette))]
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        size(&self.root).into_iter().for_each(|size| self.fit_pane(size));
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        to.log_static(self.mesh(), &Mesh3D::update_fields().with_triangle_indices(self.triangles()))?;
        if self.measured.is_some() {
            let style = LineStrips3D::update_fields().with_colors([colour(self.palette.exact)]);
            to.log_static(self.measured(), &style.with_radii([Radius::new_ui_points(1.5)]))?;
        }
        let [y, x] = self.size.map(|length| length / 2.0);
        let base = -RELIEF as f32;
        let outline = [[-x, -y, base], [x, -y, base], [x, y, base], [-x, y, base], [-x, -y, base]];
        let strip = LineStrips3D::new([outline]).with_colors([colour(FAINT)]);
        to.log_static(format!("{}/outline", self.root), &strip.with_radii([Radius::new_ui_points(0.8)]))?;
        let [along_y, along_x] = self.lengths.clone();
        let below = lines(&along_x, |[along, down]| [along, -y - NAME_GAP - down, base]);
        let beside = lines(&along_y, |[along, down]| [x + NAME_GAP + down, along, base]);
        let words = LineStrips3D::new(below.into_iter().chain(beside))
            .with_colors([colour(self.palette.ink)])
            .with_radii([Radius::new_scene_units(LETTER[1] * NAME as f32)]);
        to.log_static(format!("{}/labels", self.root), &words)
    }

    fn log_frame(&self, to: &RecordingStream, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let vertices = self.vertices(fields);
        if let Some(measured) = &self.measured {
            let above = |vertex: usize| (vertices[vertex] + ABOVE * Vec3::Z).to_array();
            let dashes =
                measured.dashes(self.counts()).into_iter().map(|dash| dash.into_iter().map(above).collect::<Vec<_>>());
            to.log(self.measured(), &LineStrips3D::update_fields().with_strips(dashes))?;
        }
        let mesh = Mesh3D::update_fields()
            .with_vertex_normals(self.normals(&vertices, fields.stride).into_iter().map(|n| n.to_array()))
            .with_vertex_positions(vertices.into_iter().map(|v| v.to_array()))
            .with_vertex_colors(self.colours(fields));
        to.log(self.mesh(), &mesh)
    }

    fn extent(&self, fields: &FrameFields<'_>) -> FieldExtent {
        let relief = range(self.vertices(fields).into_iter().map(|v| f64::from(v.z)));
        FieldExtent { relief, ..FieldExtent::NONE }
    }

    /// Stretches the relief so that the final state is [`RELIEF`] high, for all times.
    fn settle(&self, to: &RecordingStream, extent: FieldExtent) -> RecordingStreamResult<()> {
        let [low, high] = extent.relief;
        let stretch = (RELIEF / (high - low).max(f64::MIN_POSITIVE)).min(1e6) as f32;
        let transform = Transform3D::from_scale([1.0, 1.0, stretch]);
        to.log_static(self.mesh(), &transform.with_translation([0.0, 0.0, -stretch * high as f32]))
    }
}

/// The lines that fill the letters of words. `place` puts each end from its distance from the middle along the words, and below it.
fn lines(words: &str, place: impl Fn([f32; 2]) -> [f32; 3]) -> Vec<[[f32; 3]; 2]> {
    let half = 0.5 * width(words, NAME) as f32;
    let pitch = f64::from(LETTER[0]) * NAME;
    let spans = letters(words, NAME).into_iter().flat_map(|letter| fill::spans(&letter, pitch));
    spans.map(|span| span.map(|[along, down]| place([along - half, down]))).collect()
}

/// Nodes from vertex to vertex along y and x.
fn spacing(grid: &Grid) -> [usize; 2] {
    grid.shape().map(|nodes| nodes.div_ceil(VERTICES).next_power_of_two())
}

/// Vertices of the mesh of a surface on `grid`.
pub fn vertices(grid: &Grid) -> usize {
    let (shape, spacing) = (grid.shape(), spacing(grid));
    (0..2).map(|axis| shape[axis].div_ceil(spacing[axis]) + 1).product()
}
