//! The mesh of a relief: the places of its vertices, and their colours with the light that falls on them.

use crate::grid::Grid;
use crate::plot::Colour;
use crate::record::draw::fields::{FrameFields, range};
use crate::record::draw::ink::palette::{ColourMap, Palette, mixed};
use crate::record::draw::ink::reduce::Blocks;
use glam::Vec3;
use rerun::Color;

/// Largest number of vertices along a side, without the one that closes the period.
const VERTICES: usize = 128;
/// Length of the longer side.
pub(crate) const LENGTH: f64 = 10.0;
/// Height of the final relief.
pub(crate) const RELIEF: f64 = 1.6;
/// Where the light comes from: from the left, the front and above.
const LIGHT: Vec3 = Vec3::new(-0.62, -0.28, 0.73);
/// The light in the shade, and on a slope that faces the light.
const SHADE: f64 = 0.3;
const BRIGHT: f64 = 1.2;
/// The colour of the smallest pressure along the map of colours.
const FIRST_COLOUR: f64 = 0.25;

/// A mesh over the cell, or over the rows behind a cut. Its heights are exaggerated: [`ReliefStretch`] makes the final relief [`RELIEF`] high.
///
/// A block of nodes belongs to each vertex, which lies at the first of them.
pub(crate) struct ReliefMesh {
    blocks: Blocks,
    /// Nodes from vertex to vertex along y and x.
    spacing: [usize; 2],
    /// Height of the indenter at the vertices.
    height: Vec<f64>,
    /// Lengths of the cell along y and x as they are drawn.
    pub size: [f32; 2],
    /// Height of the mesh over that of the solid.
    exaggeration: f64,
    /// The first row of vertices that is drawn.
    first: usize,
    highest_pressure: f64,
    shades: ColourMap,
    pub palette: &'static Palette,
}

/// How the heights of a mesh are stretched and shifted: the highest place comes to zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ReliefStretch {
    pub factor: f32,
    pub shift: f32,
}

impl ReliefStretch {
    /// The stretch of a relief between two heights.
    pub(crate) fn new([low, high]: [f64; 2]) -> Self {
        let factor = (RELIEF / (high - low).max(f64::MIN_POSITIVE)).min(1e6) as f32;
        Self { factor, shift: -factor * high as f32 }
    }

    /// A stretched height.
    pub(crate) fn stretched(self, height: f32) -> f32 {
        self.factor * height + self.shift
    }
}

impl ReliefMesh {
    /// The mesh of what lies at a gap below heights, coloured up to the highest pressure.
    pub(crate) fn new(grid: &Grid, heights: &[f64], highest_pressure: f64, palette: &'static Palette) -> Self {
        let shape = grid.shape();
        let spacing = spacing(grid);
        let [rows, columns] = [0, 1].map(|axis| (0..shape[axis]).step_by(spacing[axis]));
        let of_row = |y: usize| columns.clone().map(move |x| heights[y * shape[1] + x]);
        let height: Vec<f64> = rows.clone().flat_map(of_row).collect();
        let [low, high] = range(height.iter().copied());
        let longest = grid.longest_wavelength();
        Self {
            blocks: Blocks { shape, cells: [rows.len(), columns.len()] },
            spacing,
            exaggeration: RELIEF / (high - low).max(f64::MIN_POSITIVE),
            height,
            size: grid.size().map(|length| (LENGTH * length / longest) as f32),
            first: 0,
            highest_pressure,
            shades: ColourMap::inferno(),
            palette,
        }
    }

    /// The mesh without the front half.
    pub(crate) fn behind_the_middle(self) -> Self {
        Self { first: self.blocks.cells[0] / 2, ..self }
    }

    /// The first row of vertices that is drawn, and where it is along y.
    pub(crate) fn first(&self) -> (usize, f32) {
        (self.first, self.place(0, self.first * self.spacing[0]))
    }

    /// Rows and columns of all vertices of the cell, with the ones that close the period.
    pub(crate) fn all_counts(&self) -> [usize; 2] {
        self.blocks.cells.map(|n| n + 1)
    }

    /// Rows and columns of the vertices that are drawn.
    pub(crate) fn counts(&self) -> [usize; 2] {
        let [rows, columns] = self.all_counts();
        [rows - self.first, columns]
    }

    /// A height of the body in the mesh.
    pub(crate) fn drawn(&self, height: f64) -> f32 {
        (height * self.exaggeration) as f32
    }

    /// The length that a height of the mesh means.
    pub(crate) fn length(&self, drawn: f64) -> f64 {
        drawn / self.exaggeration
    }

    /// The heights of the rigid surface: the lowest and the highest one.
    pub(crate) fn rigid_range(&self) -> [f64; 2] {
        range(self.height.iter().map(|height| f64::from(self.drawn(-height))))
    }

    /// The rigid surface at the vertices that are drawn.
    pub(crate) fn rigid(&self) -> Vec<Vec3> {
        self.at_vertices([1, 1], |node| self.at(node, self.drawn(-self.height[self.block(node)])))
    }

    /// The solid, a gap below the rigid surface.
    pub(crate) fn vertices(&self, fields: &FrameFields<'_>) -> Vec<Vec3> {
        let FrameFields { stride, gap, .. } = fields;
        let nx = self.blocks.shape[1];
        self.at_vertices(*stride, |node| {
            let [y, x] = self.within(node);
            let gap = gap[y / stride[0] * (nx / stride[1]) + x / stride[1]];
            self.at(node, self.drawn(-self.height[self.block(node)] - gap))
        })
    }

    /// Whether each vertex that is drawn is in contact, row by row.
    pub(crate) fn touching(&self, fields: &FrameFields<'_>) -> Vec<bool> {
        let pressure = self.blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
        self.at_vertices(fields.stride, |node| pressure[self.block(node)] > 0.0)
    }

    /// The colours by pressure in the light on a relief of these vertices, as if it was as high as the final one.
    pub(crate) fn colours(&self, fields: &FrameFields<'_>, vertices: &[Vec3]) -> Vec<Color> {
        let pressure = self.blocks.fold(&fields.pressure, fields.stride, 0.0, f64::max);
        let colour = |p: f64| match p > 0.0 {
            true => {
                let colour = self.shades.at(FIRST_COLOUR + (1.0 - FIRST_COLOUR) * p / self.highest_pressure);
                let [r, g, b, _] = colour.0.to_array();
                Colour([r, g, b])
            }
            false => self.palette.relief,
        };
        let colours = self.at_vertices(fields.stride, |node| colour(pressure[self.block(node)]));
        let light = self.light(vertices, fields.stride);
        colours.into_iter().zip(light).map(|(colour, light)| lit(colour, light)).collect()
    }

    /// The light on each vertex.
    fn light(&self, vertices: &[Vec3], stride: [usize; 2]) -> Vec<f64> {
        let [rows, columns] = self.counts();
        let stretch = ReliefStretch::new(range(vertices.iter().map(|vertex| f64::from(vertex.z))));
        let [down, right] = [0, 1].map(|axis| (stride[axis] / self.spacing[axis]).max(1));
        let at = |row: usize, column: usize| {
            let vertex = vertices[row.min(rows - 1) * columns + column.min(columns - 1)];
            Vec3::new(vertex.x, vertex.y, stretch.stretched(vertex.z))
        };
        let light = |i: usize| {
            let (row, column) = (i / columns, i % columns);
            let along_x = at(row, column + right) - at(row, column.saturating_sub(right));
            let along_y = at(row + down, column) - at(row.saturating_sub(down), column);
            let normal = along_x.cross(along_y).normalize_or(Vec3::Z);
            SHADE + (BRIGHT - SHADE) * f64::from(normal.dot(LIGHT).max(0.0))
        };
        (0..vertices.len()).map(light).collect()
    }

    /// The triangles between the vertices.
    pub(crate) fn triangles(&self) -> Vec<[u32; 3]> {
        let [rows, columns] = self.counts();
        triangles([rows, columns])
    }

    /// The results of `value` at the vertices that are drawn, in nodes of the scene along y and x. On a grid coarser than the mesh, vertices
    /// fall on the node before them: what is left of the triangles spans the nodes of that grid.
    fn at_vertices<T>(&self, stride: [usize; 2], value: impl Fn([usize; 2]) -> T) -> Vec<T> {
        let [rows, columns] = self.counts();
        let node = |axis: usize, i: usize| {
            let node = (i * self.spacing[axis]).min(self.blocks.shape[axis]);
            node - node % stride[axis]
        };
        (0..rows * columns).map(|i| value([node(0, self.first + i / columns), node(1, i % columns)])).collect()
    }

    fn at(&self, node: [usize; 2], height: f32) -> Vec3 {
        Vec3::new(self.place(1, node[1]), self.place(0, node[0]), height)
    }

    fn place(&self, axis: usize, node: usize) -> f32 {
        (node.min(self.blocks.shape[axis]) as f32 / self.blocks.shape[axis] as f32 - 0.5) * self.size[axis]
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
}

/// A colour in a light.
fn lit(colour: Colour, light: f64) -> Color {
    let Colour([r, g, b]) =
        if light <= 1.0 { mixed(Colour::BLACK, colour, light) } else { mixed(colour, Colour::WHITE, light - 1.0) };
    Color::from_rgb(r, g, b)
}

/// Two triangles for each square between rows and columns of vertices.
pub(crate) fn triangles([rows, columns]: [usize; 2]) -> Vec<[u32; 3]> {
    let [rows, columns] = [rows as u32, columns as u32];
    let square = |row: u32, column: u32| {
        let corner = row * columns + column;
        [[corner, corner + 1, corner + columns + 1], [corner, corner + columns + 1, corner + columns]]
    };
    (0..rows - 1).flat_map(|row| (0..columns - 1).flat_map(move |column| square(row, column))).collect()
}

/// Nodes from vertex to vertex along y and x.
fn spacing(grid: &Grid) -> [usize; 2] {
    grid.shape().map(|nodes| nodes.div_ceil(VERTICES).next_power_of_two())
}

/// Vertices of the mesh of a surface on `grid` behind the cut.
pub(crate) fn vertices(grid: &Grid) -> usize {
    let (shape, spacing) = (grid.shape(), spacing(grid));
    let [rows, columns] = [0, 1].map(|axis| shape[axis].div_ceil(spacing[axis]));
    (rows - rows / 2 + 1) * (columns + 1)
}
