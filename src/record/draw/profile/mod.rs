//! Pictures of the two bodies along a line.

mod bodies;

use super::drawing::{Bytes, PartRow};
use super::ink::reduce::curve_points;
use crate::setup::Part;

/// The parts of this group.
pub(crate) const PARTS: &[PartRow] =
    &[PartRow { part: Part::Profile, draw: bodies::draw, bytes: |grid| Bytes::per_frame(12.0 * curve_points(grid)) }];
