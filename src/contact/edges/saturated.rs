//! The law of a saturated edge: the pressure falls from a plateau, such as a hardness, to zero within less than a spacing.

use std::f64::consts::PI;

/// `Ci(pi)`, the cosine integral: what a node adds to the difference of the displacements of its two neighbours on one side, besides the
/// logarithm of the continuum, see [`half_width`].
const COSINE_INTEGRAL_OF_PI: f64 = 0.073_667_9;
/// `Euler's constant + ln(pi) - Ci(pi)`: by how much a pressed node is displaced more than its neighbour, in `2 p l / (pi E*)`.
const OWN_OVER_NEIGHBOUR: f64 = 1.648_277_6;

/// The largest half-width of a saturated edge, in spacings: with a wider zone the pressure at the edge is that of an elastic one, and the elastic law
/// is the better one. Of 250 rough lines with a hardness, solved on grids six times as fine, the areas were off by 0.041 spacings an edge (rms) with a
/// limit of 0.35 to 0.5, by 0.043 with 0.9, and by 0.065 with the elastic law alone.
const LARGEST_HALF_WIDTH: f64 = 0.5;

/// The pressure on both sides of a link, and how far the surfaces come apart along it.
#[derive(Clone, Copy)]
pub(crate) struct SaturatedSide {
    /// Pressure of the last node in contact, over that of the plateau: 1 where the node itself is on it.
    pub filled: f64,
    /// Gap of the next node plus overlap of the last one, over `2 l H / (pi E*)`, with the spacing `l` of the link along the normal of the edge.
    pub opening: f64,
}

impl SaturatedSide {
    /// The place of the edge on the link, in spacings from the last node; none where the zone is too wide, so that the edge is an elastic one.
    ///
    /// The plateau ends where its load does: the last node carries what a plateau up to `filled - 1/2` would. The contact ends farther out by the
    /// half-width of the zone over which the pressure falls.
    pub(crate) fn place(self) -> Option<f64> {
        let half_width = half_width(self);
        (half_width < LARGEST_HALF_WIDTH).then_some(self.filled - 0.5 + half_width)
    }
}

/// Half the width `b` of the zone in which the pressure falls from the plateau `H` to zero, in spacings.
///
/// **In the continuum** the surfaces just touch in that zone, so that the displacement has the slope of the heights there. The pressure is
///
/// ```text
/// p(x) = (H / pi) arccos(-x / b),    -b < x < b
/// ```
///
/// whose derivative is that of a flat punch, and the displacement has the slope `-(2 H / pi E*) ln(b / 2) + ...` of all that lies farther away. Outside of the
/// zone the gap opens as an inverse hyperbolic cosine, `g' ~ (2 H / pi E*) arcosh(x / b)`: seen from afar, the gradient has the logarithm that belongs to
/// a jump of the pressure. So the wider the angle at which the surfaces part, the narrower is the zone, exponentially.
///
/// **On the grid** the same plateau ends with one node of the pressure `P`, and the differences of its displacements are known exactly: the node is
/// displaced by `(2 P l / pi E*) OWN_OVER_NEIGHBOUR` more than its neighbours, and the plateau adds `(2 H l / pi E*) (ln(.) + Ci(pi))` between this
/// node and the next one. What lies farther away is the same in both. With the gap `G` of the next node and the overlap `O` of the last one
///
/// ```text
/// ln(b / 2 l) = -(G + O) pi E* / (2 H l) - Ci(pi) - OWN_OVER_NEIGHBOUR P / H
/// ```
///
/// # Source
/// This crate's own.
fn half_width(side: SaturatedSide) -> f64 {
    2.0 * (-side.opening - COSINE_INTEGRAL_OF_PI - OWN_OVER_NEIGHBOUR * side.filled).exp()
}

/// The factor by which the opening of a link is divided, for the pressure of the plateau as a length `H l / E*`.
pub(crate) fn unit_of_opening(plateau: f64) -> f64 {
    2.0 * plateau / PI
}
