//! The solid under the indenter as a relief in three dimensions, coloured by the pressure.

use super::forecast::Forecast;
use super::palette::{self, Map, colour};
use super::reduce::Blocks;
use super::scene::{self, Fields, Scene, range};
use glam::Vec3;
use rerun::{
    Color, EntityPath, LineStrips3D, Mesh3D, Points3D, Radius, RecordingStream, RecordingStreamResult, Transform3D,
};

/// Vertices along the longer side.
const VERTICES: usize = 128;
/// Length of the longer side.
const LENGTH: f64 = 10.0;
/// Height of the final relief.
const RELIEF: f64 = 1.6;

/// A mesh over the cell. Its heights are exaggerated so that the final relief is [`RELIEF`] high.
pub struct Relief {
    blocks: Blocks,
    /// Mean height of the indenter over each block.
    height: Vec<f64>,
    size: [f32; 2],
    /// Height of the drawing over that of the solid, before the final state is known.
    exaggeration: f64,
    highest_pressure: f64,
    map: Map,
    titles: [String; 2],
    mesh: EntityPath,
}

impl Relief {
    /// The relief of `scene`, with lengths in `unit`.
    pub fn new(scene: &Scene<'_>, forecast: Forecast, root: &str, unit: &str) -> Self {
        let problem = scene.problem;
        let grid = problem.surface().grid();
        let blocks = Blocks::square(grid.shape(), grid.size(), VERTICES);
        let height = blocks.mean(problem.height());
        let (low, high) = range(height.iter().copied());
        let longest = grid.longest_wavelength();
        let title = |symbol, length| scene::length_axis(symbol, unit, 0.0, length).full_length();
        Self {
            blocks,
            exaggeration: RELIEF / (high - low).max(f64::MIN_POSITIVE),
            height,
            size: grid.size().map(|length| (LENGTH * length / longest) as f32),
            highest_pressure: forecast.max_pressure,
            map: Map::inferno(),
            titles: [title("y", grid.size()[0]), title("x", grid.size()[1])],
            mesh: format!("{root}/relief/solid").into(),
        }
    }

    /// Records triangles and the outline of the cell.
    pub fn log_static(&self, to: &RecordingStream, root: &str) -> RecordingStreamResult<()> {
        to.log_static(self.mesh.clone(), &Mesh3D::update_fields().with_triangle_indices(self.triangles()))?;
        let [y, x] = self.size.map(|length| length / 2.0);
        let base = -RELIEF as f32;
        let outline = [[-x, -y, base], [x, -y, base], [x, y, base], [-x, y, base], [-x, -y, base]];
        let strip = LineStrips3D::new([outline]).with_colors([colour(palette::FAINT)]);
        to.log_static(format!("{root}/relief/outline"), &strip.with_radii([Radius::new_ui_points(0.8)]))?;
        let [along_y, along_x] = self.titles.clone();
        let labels = Points3D::new([[0.0, -1.1 * y, base], [1.1 * x, 0.0, base]])
            .with_labels([along_x, along_y])
            .with_show_labels(true)
            .with_colors([colour(palette::INK)])
            .with_radii([Radius::new_ui_points(0.0)]);
        to.log_static(format!("{root}/relief/labels"), &labels)
    }

    /// Records a state at the current time.
    pub fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let vertices = self.vertices(fields.gap);
        let mesh = Mesh3D::update_fields()
            .with_vertex_normals(self.normals(&vertices).into_iter().map(|n| n.to_array()))
            .with_vertex_positions(vertices.into_iter().map(|v| v.to_array()))
            .with_vertex_colors(self.colours(fields.pressure));
        to.log(self.mesh.clone(), &mesh)
    }

    /// Stretches the relief so that the final state is [`RELIEF`] high, for all times.
    pub fn settle(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let (low, high) = range(self.levels(fields.gap));
        let stretch = (RELIEF / (high - low).max(f64::MIN_POSITIVE)).min(1e6) as f32;
        let transform = Transform3D::from_scale([1.0, 1.0, stretch]);
        to.log_static(self.mesh.clone(), &transform.with_translation([0.0, 0.0, -stretch * high as f32]))
    }

    /// Exaggerated heights of the solid's surface.
    fn levels<'a>(&'a self, gap: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let gaps = self.blocks.mean(gap);
        self.height.iter().zip(gaps).map(|(h, g)| -(h + g) * self.exaggeration)
    }

    fn vertices(&self, gap: &[f64]) -> Vec<Vec3> {
        let [rows, columns] = self.blocks.cells;
        let [ly, lx] = self.size;
        let place = |i: usize, n: usize, length: f32| ((i as f32 + 0.5) / n as f32 - 0.5) * length;
        let level =
            |(i, z): (usize, f64)| Vec3::new(place(i % columns, columns, lx), place(i / columns, rows, ly), z as f32);
        self.levels(gap).enumerate().map(level).collect()
    }

    fn normals(&self, vertices: &[Vec3]) -> Vec<Vec3> {
        let [rows, columns] = self.blocks.cells;
        let at = |row: usize, column: usize| vertices[row * columns + column];
        let normal = |i: usize| {
            let (row, column) = (i / columns, i % columns);
            let along_x = at(row, (column + 1).min(columns - 1)) - at(row, column.saturating_sub(1));
            let along_y = at((row + 1).min(rows - 1), column) - at(row.saturating_sub(1), column);
            along_x.cross(along_y).normalize_or(Vec3::Z)
        };
        (0..vertices.len()).map(normal).collect()
    }

    fn colours(&self, pressure: &[f64]) -> Vec<Color> {
        let shade = |p: f64| {
            if p > 0.0 { self.map.at(0.25 + 0.75 * p / self.highest_pressure) } else { colour(palette::SOLID_RELIEF) }
        };
        self.blocks.fold(pressure, 0.0, f64::max).into_iter().map(shade).collect()
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        let [rows, columns] = self.blocks.cells.map(|n| n as u32);
        let square = |row: u32, column: u32| {
            let corner = row * columns + column;
            [[corner, corner + 1, corner + columns + 1], [corner, corner + columns + 1, corner + columns]]
        };
        (0..rows - 1).flat_map(|row| (0..columns - 1).flat_map(move |column| square(row, column))).collect()
    }
}
