//! The triangles of a solid with the surface on top.

use super::super::triangles::TITLE;
use super::file_writer::FileWriter;
use crate::formats::Scan;
use std::io::{self, Write};

/// Millimetres in a metre: STL has no unit, and programs for printing take millimetres.
const MILLIMETRES: f64 = 1e3;
/// Thickness of the solid below the deepest height, over its shorter side.
const THICKNESS: f64 = 0.1;

/// Writes a block in millimetres as binary STL: heights about their mean on top, each cell of four nodes as two triangles, upright sides, and a
/// flat bottom. The block is watertight: each edge belongs to two triangles that run along it in opposite directions, and all normals point
/// outwards. It spans from the first to the last node along each axis. Heights must not be void.
///
/// # Source
/// "SLC/STL file specification" of 3D Systems, 1989: 80 bytes, the number of triangles, and for each its normal, its three corners
/// counterclockwise as seen from outside as single-precision numbers, and two bytes.
pub(super) fn write(scan: &Scan, file: &mut FileWriter) -> io::Result<()> {
    let block = SolidBlock::new(scan);
    let [ny, nx] = scan.shape();
    let rim = block.rim();
    let count = 2 * (ny - 1) * (nx - 1) + 3 * rim.len();
    let count =
        u32::try_from(count).map_err(|_| io::Error::other("it has more triangles than the format can count"))?;
    let mut header = [b' '; 80];
    header[..TITLE.len()].copy_from_slice(TITLE);
    file.write_all(&header)?;
    file.write_all(&count.to_le_bytes())?;
    for (y, x) in (0..ny - 1).flat_map(|y| (0..nx - 1).map(move |x| (y, x))) {
        let [a, b, c, d] = [[y, x], [y, x + 1], [y + 1, x + 1], [y + 1, x]].map(|node| block.top(node));
        triangle([a, b, c], file)?;
        triangle([a, c, d], file)?;
    }
    let middle = block.middle();
    for (at, node) in rim.iter().enumerate() {
        let next = rim[(at + 1) % rim.len()];
        let [a, b] = [block.top(*node), block.top(next)];
        let [below_a, below_b] = [block.bottom(*node), block.bottom(next)];
        triangle([below_a, below_b, b], file)?;
        triangle([below_a, b, a], file)?;
        triangle([below_b, below_a, middle], file)?;
    }
    Ok(())
}

/// A corner of triangles: x, y and z in millimetres.
type Corner = [f32; 3];

/// A block with heights on top.
struct SolidBlock<'a> {
    scan: &'a Scan,
    mean: f64,
    base: f32,
}

impl<'a> SolidBlock<'a> {
    fn new(scan: &'a Scan) -> Self {
        let mean = scan.height.mean().unwrap_or_default();
        let deepest = scan.height.iter().copied().fold(f64::INFINITY, f64::min);
        let sides = [0, 1].map(|axis| (scan.shape()[axis] - 1) as f64 * scan.spacing[axis]);
        let base = deepest - mean - THICKNESS * sides[0].min(sides[1]);
        Self { scan, mean, base: (base * MILLIMETRES) as f32 }
    }

    /// The place of a node above the bottom.
    fn place(&self, node: [usize; 2]) -> [f32; 2] {
        [1, 0].map(|axis| (node[axis] as f64 * self.scan.spacing[axis] * MILLIMETRES) as f32)
    }

    fn top(&self, node: [usize; 2]) -> Corner {
        let [x, y] = self.place(node);
        [x, y, ((self.scan.height[node] - self.mean) * MILLIMETRES) as f32]
    }

    fn bottom(&self, node: [usize; 2]) -> Corner {
        let [x, y] = self.place(node);
        [x, y, self.base]
    }

    /// The point of the bottom to which the triangles of all its edges reach: half a cell off the nodes in the middle.
    fn middle(&self) -> Corner {
        let [ny, nx] = self.scan.shape();
        let along = |axis: usize, n: usize| (0.5 * (n - 1) as f64 * self.scan.spacing[axis] * MILLIMETRES) as f32;
        [along(1, nx), along(0, ny), self.base]
    }

    /// The nodes at the rim, counterclockwise as seen from above, where x runs right and y up.
    fn rim(&self) -> Vec<[usize; 2]> {
        let [last_y, last_x] = self.scan.shape().map(|n| n - 1);
        let lower = (0..last_x).map(|x| [0, x]);
        let right = (0..last_y).map(|y| [y, last_x]);
        let upper = (1..=last_x).rev().map(|x| [last_y, x]);
        let left = (1..=last_y).rev().map(|y| [y, 0]);
        lower.chain(right).chain(upper).chain(left).collect()
    }
}

/// Writes a triangle with its normal.
fn triangle(corners: [Corner; 3], file: &mut FileWriter) -> io::Result<()> {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let [u, v] = [[0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i])];
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = normal.iter().map(|it| it * it).sum::<f64>().sqrt();
    let normal = normal.map(|it| if length > 0.0 { (it / length) as f32 } else { 0.0 });
    for number in normal.into_iter().chain(corners.concat()) {
        file.write_all(&number.to_le_bytes())?;
    }
    file.write_all(&[0; 2])
}
