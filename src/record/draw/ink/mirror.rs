//! The outline of the measured part of heights that were mirrored.

use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::{Palette, colour};
use crate::record::scene::Scene;
use crate::surface::Mirror;
use rerun::{Radius, RecordingStream, RecordingStreamResult};

/// Edges of a mesh along a dash of the outline.
const DASH: usize = 3;

/// The measured part of heights, all others being its mirror images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasuredPart {
    /// Shares of the cell along y and x, from node 0 on: a half along mirrored axes.
    share: [f64; 2],
}

impl MeasuredPart {
    /// That of the heights of a scene, if they were mirrored.
    pub(crate) fn new(scene: &Scene<'_>) -> Option<Self> {
        let mirror = scene.setup.as_ref()?.surface.prepare.mirror?;
        let is_along = |axis: usize| match mirror {
            Mirror::X => axis == 1,
            Mirror::Y => axis == 0,
            Mirror::Both => true,
        };
        let is_line = scene.problem.surface().grid().is_line();
        Some(Self { share: [0, 1].map(|axis| if is_along(axis) && !(is_line && axis == 0) { 0.5 } else { 1.0 }) })
    }

    /// The outline in a mesh over the whole cell with a number of rows and columns: the numbers of its vertices, as dashes.
    pub(crate) fn dashes(&self, [rows, columns]: [usize; 2]) -> Vec<Vec<usize>> {
        let [top, right] =
            [(0, rows), (1, columns)].map(|(axis, n)| (self.share[axis] * (n - 1) as f64).round() as usize);
        let sides = [
            (0..=right).collect::<Vec<_>>(),
            (0..=top).map(|row| row * columns + right).collect(),
            (0..=right).map(|column| top * columns + column).collect(),
            (0..=top).map(|row| row * columns).collect(),
        ];
        let dashes = |side: &Vec<usize>| side.chunks(DASH + 1).step_by(2).map(<[usize]>::to_vec).collect::<Vec<_>>();
        sides.iter().flat_map(dashes).filter(|dash| dash.len() > 1).collect()
    }

    /// Records its outline, in dashes on a dark or light line, over a box of a width and a height, whose lower left corner is node 0.
    pub(crate) fn log(
        &self,
        to: &RecordingStream,
        entity: &str,
        [width, height]: [f64; 2],
        palette: &Palette,
    ) -> RecordingStreamResult<()> {
        let [y, x] = self.share;
        let (right, top) = (x * width, (1.0 - y) * height);
        let outline = [[0.0, height], [0.0, top], [right, top], [right, height], [0.0, height]];
        let below = outline.map(|point| point.map(|p| p as f32)).to_vec();
        let below = (below, colour(palette.ground), Radius::new_ui_points(2.0));
        let dash = |points| (points, colour(palette.exact), Radius::new_ui_points(1.2));
        let strips = std::iter::once(below).chain(canvas::dashed(&outline).map(dash));
        to.log_static(entity, &canvas::strips(strips).with_draw_order(36.0))
    }
}
