//! The rigid surface above a relief, as a grid of lines through which the solid is seen.

use crate::record::draw::field::relief_mesh::{RELIEF, ReliefMesh, ReliefStretch};
use crate::record::draw::ink::palette::{colour, mixed};
use glam::Vec3;
use rerun::{LineStrips3D, Radius, RecordingStream, RecordingStreamResult};

/// The height above the highest place of the solid at which the rigid surface is cut off.
pub(crate) const CEILING: f32 = 0.65 * RELIEF as f32;
/// The height at which the grid of a rough surface is cut off: of more than some parts for each line on average, which would hide the solid.
const LOW_CEILING: f32 = 0.25 * RELIEF as f32;
const MOST_PARTS: usize = 3;
/// The largest number of lines along the longer side.
const LINES: usize = 20;
/// Radii of the lines of the grid, and of the line along the cut.
const FINE: f32 = 0.4;
const THICK: f32 = 1.4;
/// How near the colour of the grid is to that of the rigid surface, from that of the ground on.
const FAINT: f64 = 0.75;

/// Records the part of the rigid surface of a mesh that is below the ceiling.
pub(crate) fn log(
    to: &RecordingStream,
    root: &str,
    mesh: &ReliefMesh,
    stretch: ReliefStretch,
) -> RecordingStreamResult<()> {
    let [rows, columns] = mesh.counts();
    let vertices: Vec<Vec3> =
        mesh.rigid().into_iter().map(|vertex| Vec3::new(vertex.x, vertex.y, stretch.stretched(vertex.z))).collect();
    let row = |row: usize| (0..columns).map(|column| vertices[row * columns + column]).collect::<Vec<_>>();
    let column = |column: usize| (0..rows).map(|row| vertices[row * columns + column]).collect::<Vec<_>>();
    let every = (columns - 1).max(rows - 1).div_ceil(LINES);
    let lines: Vec<Vec<Vec3>> =
        (0..rows).step_by(every).map(row).chain((0..columns).step_by(every).map(column)).collect();
    let parts = |ceiling: f32| lines.iter().flat_map(|line| below(line, ceiling)).collect::<Vec<_>>();
    let smooth = Some(parts(CEILING)).filter(|parts| parts.len() <= MOST_PARTS * lines.len());
    let grid = LineStrips3D::new(smooth.unwrap_or_else(|| parts(LOW_CEILING)))
        .with_colors([colour(mixed(mesh.palette.ground, mesh.palette.indenter, FAINT))])
        .with_radii([Radius::new_ui_points(FINE)]);
    to.log_static(format!("{root}/rigid/grid"), &grid)?;
    let edge = LineStrips3D::new(below(&row(0), CEILING))
        .with_colors([colour(mesh.palette.ink)])
        .with_radii([Radius::new_ui_points(THICK)]);
    to.log_static(format!("{root}/rigid/edge"), &edge)
}

/// The parts of a line below a height.
fn below(line: &[Vec3], height: f32) -> Vec<Vec<[f32; 3]>> {
    let mut parts: Vec<Vec<[f32; 3]>> = Vec::new();
    let mut part: Vec<[f32; 3]> = Vec::new();
    for pair in line.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let crossing = || from.lerp(to, (height - from.z) / (to.z - from.z)).to_array();
        match [from, to].map(|end| end.z <= height) {
            [false, false] => {}
            [true, true] => {
                if part.is_empty() {
                    part.push(from.to_array());
                }
                part.push(to.to_array());
            }
            [true, false] => {
                if part.is_empty() {
                    part.push(from.to_array());
                }
                part.push(crossing());
                parts.push(std::mem::take(&mut part));
            }
            [false, true] => part = vec![crossing(), to.to_array()],
        }
    }
    parts.extend((!part.is_empty()).then_some(part));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_the_ceiling() {
        let line: Vec<Vec3> =
            [2.0, 0.0, 0.5, 3.0, 3.0, 0.0].into_iter().enumerate().map(|(i, z)| Vec3::new(i as f32, 0.0, z)).collect();
        let parts = below(&line, 1.0);
        let places: Vec<Vec<f32>> = parts.iter().map(|part| part.iter().map(|point| point[0]).collect()).collect();
        assert_eq!(places.len(), 2);
        assert!((places[0][0] - 0.5).abs() < 1e-6 && (places[0].last().unwrap() - 2.2).abs() < 1e-6, "{places:?}");
        assert!((places[1][0] - (4.0 + 2.0 / 3.0)).abs() < 1e-6 && *places[1].last().unwrap() == 5.0);
        assert!(parts.iter().flatten().all(|point| point[2] <= 1.0 + 1e-6));
    }
}
