//! The upper side of bodies of triangles, as CAD programs write them in STL.

use super::bytes::{ByteReader, latin};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::{STEPS_OVER_TRIANGLES, check_points};
use std::io;

/// Triangles of three corners `(x, y, z)`: binary, with 80 bytes of text and the number of triangles before them, or as text. The normals in the file are
/// not used. Heights are those of the upper side of the body, seen along -z: at each node the highest point above it, and void where there is none.
///
/// Nodes are the corners of the upper side where these form an even grid with two triangles in each cell, and else `LONGER_SIDE` points along the longer side of the
/// body, at the same distance along the other one. STL has no unit; that of a file which this program has written is the millimetre.
///
/// # Source
/// "SLC/STL file specification" of 3D Systems, 1989.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "STL", is_it, channels };

/// The text with which files of this program begin.
pub(super) const TITLE: &[u8] = b"surface of asperity in millimetres";
/// The nodes along the longer side of a body whose corners are no grid.
const LONGER_SIDE: usize = 512;
/// Bytes of the text before the number of triangles, and of a triangle: its normal, its corners and two bytes more.
const TEXT_BYTES: usize = 80;
const TRIANGLE_BYTES: usize = 50;
/// Bytes among which a file in text has its first triangle.
const FIRST_FACET_WITHIN: usize = 1024;
/// Places of corners that differ by less than this part of the longer side are the same: they have single precision.
const SAME_PLACE: f64 = 2e-6;
/// How far beyond its edges a triangle covers nodes, over its size: nodes on a common edge of two triangles are covered by both.
const EDGE: f64 = 1e-6;
/// Metres in the unit of the program's own files.
const MILLIMETRE: f64 = 1e-3;

/// Three corners: x, y and z.
type Triangle = [[f64; 3]; 3];

fn is_it(bytes: &[u8]) -> bool {
    is_binary(bytes) || is_text(bytes)
}

/// Whether a file has the length that its number of triangles says.
fn is_binary(bytes: &[u8]) -> bool {
    let Some(count) = bytes.get(TEXT_BYTES..TEXT_BYTES + 4).and_then(|it| it.try_into().ok()) else { return false };
    let count = u32::from_le_bytes(count) as usize;
    count > 0 && count.checked_mul(TRIANGLE_BYTES).is_some_and(|length| bytes.len() - TEXT_BYTES - 4 == length)
}

fn is_text(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(FIRST_FACET_WITHIN)];
    head.trim_ascii_start().starts_with(b"solid") && head.windows(5).any(|word| word == b"facet")
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let triangles = if is_binary(bytes) { of_binary(bytes)? } else { of_text(&latin(bytes))? };
    let upper = upper_side(triangles)?;
    let grid = TriangleGrid::new(&upper)?;
    let is_own = bytes.starts_with(TITLE);
    Ok(vec![Channel {
        spacing: Some(grid.spacing),
        lateral_unit: is_own.then_some(MILLIMETRE),
        unit: is_own.then_some(MILLIMETRE),
        ..Channel::map("upper side", grid.shape, move || Ok(grid.heights(&upper)))
    }])
}

fn of_binary(bytes: &[u8]) -> io::Result<Vec<Triangle>> {
    let mut at = ByteReader::new(bytes).seek(TEXT_BYTES + 4)?;
    let mut triangles = Vec::with_capacity(at.rest().len() / TRIANGLE_BYTES);
    while !at.rest().is_empty() {
        at.take(12)?;
        let mut corners = Triangle::default();
        for number in corners.as_flattened_mut() {
            *number = at.f32()?.into();
        }
        at.take(2)?;
        triangles.push(corners);
    }
    Ok(triangles)
}

/// The triangles of a text: of all its words, `vertex` is followed by the three numbers of a corner.
fn of_text(text: &str) -> io::Result<Vec<Triangle>> {
    let mut corners = Vec::new();
    let mut words = text.split_ascii_whitespace();
    while let Some(word) = words.next() {
        if word != "vertex" {
            continue;
        }
        let mut corner = [0.0; 3];
        for number in &mut corner {
            let word = words.next().unwrap_or_default();
            let unreadable = || malformed(format!("corner {} has {word:?} in place of a number", corners.len() + 1));
            *number = word.parse().map_err(|_| unreadable())?;
        }
        corners.push(corner);
    }
    let (triangles, rest) = corners.as_chunks();
    match rest.len() {
        0 => Ok(triangles.to_vec()),
        _ => Err(malformed("its last triangle has no three corners: it is incomplete")),
    }
}

/// Twice the area of the shadow of a triangle on the plane `z = 0`, positive if its corners run counterclockwise as seen from above.
fn shadow([a, b, c]: &Triangle) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The triangles that face upwards: those of a closed body lie above all others. An open surface may have been written the other way round.
fn upper_side(triangles: Vec<Triangle>) -> io::Result<Vec<Triangle>> {
    if let Some(number) = triangles.iter().position(|it| it.as_flattened().iter().any(|it| !it.is_finite())) {
        return Err(malformed(format!("triangle {} has a corner that is not finite", number + 1)));
    }
    let is_up = triangles.iter().any(|it| shadow(it) > 0.0);
    let sign = if is_up { 1.0 } else { -1.0 };
    let upper: Vec<Triangle> = triangles.into_iter().filter(|it| sign * shadow(it) > 0.0).collect();
    if upper.is_empty() {
        Err(malformed("none of its triangles faces along z: its heights must be along z"))
    } else {
        Ok(upper)
    }
}

/// The nodes at which heights of triangles are taken.
struct TriangleGrid {
    shape: [usize; 2],
    spacing: [f64; 2],
    /// The place of the first node, `y` and `x`.
    first: [f64; 2],
}

impl TriangleGrid {
    /// The grid of some triangles, one or more.
    fn new(triangles: &[Triangle]) -> io::Result<Self> {
        // the place along y is the second number of a corner
        let places = [1, 0].map(|number| distinct(triangles, number));
        let extent = places.each_ref().map(|it| it[it.len() - 1] - it[0]);
        let longer = extent[0].max(extent[1]);
        let merged = places.each_ref().map(|it| without_equal(it, SAME_PLACE * longer));
        let first = merged.each_ref().map(|it| it[0]);
        // each cell of a map is two triangles
        let cells: usize = merged.iter().map(|it| it.len() - 1).product();
        let is_grid = triangles.len() == 2 * cells && merged.iter().all(|it| is_even(it, SAME_PLACE * longer));
        let shape = match is_grid {
            true => merged.each_ref().map(Vec::len),
            false => extent.map(|it| ((LONGER_SIDE - 1) as f64 * it / longer).floor() as usize + 1),
        };
        if shape.contains(&1) {
            return Err(malformed(format!(
                "its upper side is {:?} by {:?} wide: too narrow for a map",
                extent[0], extent[1]
            )));
        }
        check_points(&shape)?;
        let spacing = match is_grid {
            true => [0, 1].map(|axis| extent[axis] / (shape[axis] - 1) as f64),
            false => [longer / (LONGER_SIDE - 1) as f64; 2],
        };
        let grid = Self { shape, spacing, first };
        let steps =
            triangles.iter().map(|it| grid.below(it)).map(|[y, x]| y.len() as f64 * x.len() as f64).sum::<f64>();
        if steps > STEPS_OVER_TRIANGLES {
            let times = steps / (shape[0] * shape[1]) as f64;
            return Err(malformed(format!(
                "its triangles lie above each other {times:.0} times: save its upper side alone"
            )));
        }
        Ok(grid)
    }

    /// The rows and columns of the nodes in the rectangle around a triangle.
    fn below(&self, triangle: &Triangle) -> [std::ops::Range<usize>; 2] {
        [0, 1].map(|axis| {
            let places = triangle.map(|corner| (corner[1 - axis] - self.first[axis]) / self.spacing[axis]);
            let [low, high] =
                [places.into_iter().fold(f64::INFINITY, f64::min), places.into_iter().fold(0.0, f64::max)];
            // half a step more on both sides than rounding needs
            let last = ((high + 0.5).floor() as usize + 1).min(self.shape[axis]);
            ((low - 0.5).ceil().max(0.0) as usize).min(last)..last
        })
    }

    /// The heights of the highest of some triangles at each node, row by row.
    fn heights(&self, triangles: &[Triangle]) -> Vec<f64> {
        let mut all = vec![f64::NAN; self.shape[0] * self.shape[1]];
        for triangle in triangles {
            let [rows, columns] = self.below(triangle);
            for row in rows {
                for column in columns.clone() {
                    let place =
                        [column as f64 * self.spacing[1] + self.first[1], row as f64 * self.spacing[0] + self.first[0]];
                    let highest = &mut all[row * self.shape[1] + column];
                    // the maximum with a void is the other height
                    *highest = height_at(triangle, place).map_or(*highest, |height| highest.max(height));
                }
            }
        }
        all
    }
}

/// The places of all corners along x (0) or y (1), rising.
fn distinct(triangles: &[Triangle], number: usize) -> Vec<f64> {
    let mut places: Vec<f64> = triangles.as_flattened().iter().map(|corner| corner[number]).collect();
    places.sort_unstable_by(f64::total_cmp);
    places.dedup();
    places
}

/// Rising places without those that are the same as the one before.
fn without_equal(places: &[f64], same: f64) -> Vec<f64> {
    let mut merged: Vec<f64> = Vec::new();
    for place in places {
        if merged.last().is_none_or(|last| place - last > same) {
            merged.push(*place);
        }
    }
    merged
}

/// Whether places are evenly spaced.
fn is_even(places: &[f64], same: f64) -> bool {
    let step = (places[places.len() - 1] - places[0]) / (places.len() - 1).max(1) as f64;
    places.iter().enumerate().all(|(i, place)| (place - places[0] - i as f64 * step).abs() <= same)
}

/// The height of a triangle above a place `[x, y]`, if it is there.
fn height_at(triangle: &Triangle, [x, y]: [f64; 2]) -> Option<f64> {
    let whole = shadow(triangle);
    let part = |i: usize, j: usize| shadow(&[[x, y, 0.0], triangle[i], triangle[j]]) / whole;
    let parts = [part(1, 2), part(2, 0), part(0, 1)];
    let is_inside = parts.iter().all(|it| *it >= -EDGE);
    is_inside.then(|| parts.iter().zip(triangle).map(|(part, corner)| part * corner[2]).sum())
}
