//! Pictures of the contact and its patches.

mod mask;
pub(crate) mod patch_map;
mod patch_points;
pub(crate) mod patch_tree;
mod segments;

use super::drawing::{Bytes, Drawing, PartRow, Subject};
use super::ink::reduce::{curve_points, has_contour, pixels};
use super::plane::Plane;
use crate::grid::Grid;
use crate::setup::Part;

/// The parts of this group.
pub(crate) const PARTS: &[PartRow] = &[PartRow { part: Part::Mask, draw: contact, bytes: bytes_of_contact }];

/// The contact: segments of a line, an image of a surface.
fn contact(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(match subject.plane {
        Plane::Line(plane) => Box::new(segments::ContactSegments::new(subject, plane)),
        Plane::Surface(plane) => Box::new(mask::ContactMask::new(subject, plane)),
    })
}

fn bytes_of_contact(grid: &Grid) -> Bytes {
    // the classes of a surface, packed, and some lines of the contour where there is one
    Bytes::per_frame(match grid.is_line() {
        true => curve_points(grid),
        false if has_contour(grid) => 1.3 * pixels(grid) as f64,
        false => 0.1 * pixels(grid) as f64,
    })
}
