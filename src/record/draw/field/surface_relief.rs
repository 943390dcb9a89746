//! A surface as a relief, coloured by its height.

use crate::record::draw::field::relief::{NAME_GAP, NAMES, log_names};
use crate::record::draw::field::relief_mesh::{RELIEF, ReliefMesh};
use crate::record::draw::fields::{FrameFields, Outline, range};
use crate::record::draw::ink::canvas::PANE;
use crate::record::draw::ink::eye::Eye;
use crate::record::draw::ink::palette::{FAINT, Palette, colour};
use crate::record::draw::ink::ruler::measured;
use crate::surface::Surface;
use glam::Vec3;
use rerun::{LineStrips3D, Mesh3D, Radius, RecordingStream, RecordingStreamResult};
use std::borrow::Cow;

/// Heights of the eye that are tried, in radians above the horizon.
const ELEVATIONS: [f32; 6] = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// A surface in three dimensions, peaks up.
pub(crate) struct SurfaceRelief {
    mesh: ReliefMesh,
    fields: FrameFields<'static>,
    /// Lengths along y and x, in words.
    lengths: [String; 2],
    /// Width and height of its pane.
    pane: [f64; 2],
    root: String,
}

impl SurfaceRelief {
    /// The relief of a surface under `root`, lengths in `unit`.
    pub(crate) fn new(surface: &Surface, palette: &'static Palette, root: &str, unit: &str) -> Self {
        let (heights, grid) = (surface.heights(), surface.grid());
        let [low, high] = range(heights.iter().copied());
        // what is drawn lies at the negative of height and gap: that of the surface as far below its highest peak as it is
        let gap = heights.iter().map(|h| high - 2.0 * h).collect::<Vec<_>>().into();
        let pressure = heights.iter().map(|h| h - low).collect::<Vec<_>>().into();
        let (outline, patches, candidates) = (Outline::default(), Vec::new(), Cow::default());
        Self {
            mesh: ReliefMesh::new(grid, heights, high - low, palette),
            fields: FrameFields { stride: [1, 1], pressure, gap, candidates, outline, patches, further: Vec::new() },
            lengths: [0, 1].map(|axis| measured(["y", "x"][axis], unit, grid.size()[axis])),
            pane: PANE,
            root: format!("{root}/relief"),
        }
    }

    /// The root of its entities, and the eye that sees it.
    pub(crate) fn view(&self) -> (&str, Eye) {
        let [y, x] = self.mesh.size.map(|length| length / 2.0);
        let ends = |side: bool, low: f32, high: f32| if side { high } else { low };
        let corner = |i: u8| {
            let [right, back, up] = [0, 1, 2].map(|axis| i >> axis & 1 == 1);
            let names = if up { 0.0 } else { NAMES };
            Vec3::new(ends(right, -x, x + names), ends(back, -y - names, y), ends(up, -RELIEF as f32, 0.0))
        };
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(corner);
        (&self.root, Eye::around(&corners, (self.pane[0] / self.pane[1]) as f32, ELEVATIONS))
    }

    /// Takes the proportions of a pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        self.pane = pane;
    }

    /// Records it.
    pub(crate) fn log(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { mesh, root, .. } = self;
        let [y, x] = mesh.size.map(|length| length / 2.0);
        let base = -RELIEF as f32;
        let outline = [[-x, -y, base], [x, -y, base], [x, y, base], [-x, y, base], [-x, -y, base]];
        let outline = LineStrips3D::new([outline]).with_colors([colour(FAINT)]);
        to.log_static(format!("{root}/outline"), &outline.with_radii([Radius::new_ui_points(0.8)]))?;
        let [along_y, along_x] = &self.lengths;
        let below = (along_x.as_str(), Vec3::new(0.0, -y - NAME_GAP, base));
        let beside = (along_y.as_str(), Vec3::new(x + NAME_GAP, 0.0, base));
        log_names(to, root, mesh.palette, [below, beside])?;
        let vertices = mesh.vertices(&self.fields);
        let relief = Mesh3D::new(vertices.iter().map(|vertex| vertex.to_array()))
            .with_vertex_colors(mesh.colours(&self.fields, &vertices))
            .with_triangle_indices(mesh.triangles());
        to.log_static(format!("{root}/solid"), &relief)
    }
}
