//! The walls of a solid that is cut: the section in front, and the side.

use crate::plot::Colour;
use crate::record::draw::field::relief_mesh::{RELIEF, ReliefStretch, triangles};
use crate::record::draw::ink::palette::{Palette, colour, mixed};
use glam::Vec3;
use rerun::{Color, Mesh3D, RecordingStream, RecordingStreamResult, Transform3D};

/// Depth of the solid below the final relief.
pub(crate) const DEPTH: f32 = 1.0;
/// Where the foot of a wall is.
pub(crate) const FOOT: f32 = -(RELIEF as f32 + DEPTH);
/// How far a wall leans, over the distance of its foot in the coordinates of the wall.
const LEAN: f32 = 1e-3;
/// How near the colour of the section is to that of the surface, at its top and at its foot; and those of the side, which is in the shade.
const SECTION: [f64; 2] = [0.45, 0.15];
const SIDE: [f64; 2] = [0.15, 0.0];

/// A wall from an edge of a relief down to its foot.
///
/// The foot stays where it is when the relief is stretched. In the coordinates of the wall it lies at the height zero and at a distance of one in front of the edge; the
/// transform of the wall maps that distance to the height of the foot.
pub(crate) struct Wall {
    root: String,
    /// The axis across the wall, 0 for x and 1 for y, its place there, and the direction in which it is seen from.
    across: usize,
    place: f32,
    towards: f32,
    /// Colours at the top and at the foot.
    colours: [Color; 2],
}

impl Wall {
    /// The section in front, at a place along y.
    pub(crate) fn section(root: &str, place: f32, palette: &Palette) -> Self {
        Self {
            root: format!("{root}/section"),
            across: 1,
            place,
            towards: -1.0,
            colours: wall_colours(palette, SECTION),
        }
    }

    /// The side on the right, at a place along x.
    pub(crate) fn side(root: &str, place: f32, palette: &Palette) -> Self {
        Self { root: format!("{root}/side"), across: 0, place, towards: 1.0, colours: wall_colours(palette, SIDE) }
    }

    /// Records what joins the vertices of an edge of a number of them.
    pub(crate) fn log_static(&self, to: &RecordingStream, vertices: usize) -> RecordingStreamResult<()> {
        to.log_static(self.root.as_str(), &Mesh3D::update_fields().with_triangle_indices(triangles([2, vertices])))
    }

    /// Records the wall below an edge.
    pub(crate) fn log(&self, to: &RecordingStream, edge: &[Vec3]) -> RecordingStreamResult<()> {
        let corner = |vertex: &Vec3, distance: f32, height: f32| {
            let mut corner = vertex.to_array();
            corner[self.across] = distance * self.towards;
            corner[2] = height;
            corner
        };
        let foot = edge.iter().map(|vertex| corner(vertex, 1.0, 0.0));
        let top = edge.iter().map(|vertex| corner(vertex, 0.0, vertex.z));
        let [at_top, at_foot] = self.colours;
        let colours = std::iter::repeat_n(at_foot, edge.len()).chain(std::iter::repeat_n(at_top, edge.len()));
        let mesh = Mesh3D::update_fields().with_vertex_positions(foot.chain(top)).with_vertex_colors(colours);
        to.log(self.root.as_str(), &mesh)
    }

    /// Puts the edge where the stretched relief is, and leaves the foot where it is.
    pub(crate) fn stretch(&self, to: &RecordingStream, stretch: ReliefStretch) -> RecordingStreamResult<()> {
        let mut columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, stretch.factor]];
        columns[self.across][self.across] = LEAN;
        columns[self.across][2] = self.towards * (FOOT - stretch.shift);
        let mut shift = [0.0, 0.0, stretch.shift];
        shift[self.across] = self.place;
        to.log_static(self.root.as_str(), &Transform3D::from_mat3x3(columns).with_translation(shift))
    }
}

/// Colours between that of the solid and that of its surface, at the top and at the foot.
fn wall_colours(palette: &Palette, shares: [f64; 2]) -> [Color; 2] {
    let Palette { solid_fill, solid, .. } = palette;
    shares.map(|share| colour(mixed(*solid_fill, *solid, share)))
}

/// The colour of the edges of the walls.
pub(crate) fn edge(palette: &Palette) -> Colour {
    palette.solid
}
