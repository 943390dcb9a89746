//! The laws of the edges of a contact: one in an elastic solid, and one for each direction in a solid over which the contact slides.

use super::law::{EdgeLaw, NODE_EXCESS_PER_SWITCH_LINE};
use crate::contact::Problem;
use crate::elastic::SteadyMotion;
use crate::theory::integral;
use std::f64::consts::PI;

/// Logarithms of the slope of an edge across the motion that the table of laws begins and ends with, and its steps.
const SLOPES: f64 = 12.0;
const STEPS: usize = 64;

/// The laws of the edges of a contact.
///
/// The factors of Wiener and Hopf exist for any stiffness `K(theta)` of the waves of a link, `theta` the phase from node to node. With the
/// factor `M(theta)` of `K` over the half-space of the contact modulus, and `Re log M` even,
///
/// ```text
/// log m = (1/pi) int_0^pi log abs(M(t)) dt
/// c     = c_0 - (1/pi) [int_0^pi log abs(M(t)) (1/(4 sin^2(t/2)) - 1/t^2) dt - int_pi^inf log abs(M(t)) dt / t^2]
/// ```
///
/// since `P` and `G` have the factors at `z = 0`, whose product is the geometric mean of `K`, and the edge lies where a continuum of the
/// same stiffness has it for waves of any length. The phase of `M` does not matter, nor which side is ahead.
///
/// Over a viscoelastic solid the wave of a straight edge with the normal `n` has `q_x = q n_x`. So on a link along `x` it is
/// `q_x = theta / l`, whatever the normal, and on one along `y` it is `q_x = (theta / l) n_x / n_y`: an edge along the motion is at rest.
pub(super) struct EdgeLaws {
    along_x: EdgeLaw,
    along_y: EdgeLaw,
    /// The laws on links along `y` by the logarithm of the slope `n_x / n_y`; empty at rest.
    by_slope: Vec<EdgeLaw>,
}

impl EdgeLaws {
    /// The laws of a problem.
    pub(crate) fn new(problem: &Problem) -> Self {
        let elastic = EdgeLaw::ELASTIC;
        let Some(motion @ SteadyMotion::Sliding { .. }) = problem.compliance().motion() else {
            return Self { along_x: elastic, along_y: elastic, by_slope: Vec::new() };
        };
        let grid = problem.surface().grid();
        let [dy, dx] = grid.spacing();
        let law = |phase: f64| EdgeLaw::new(|t| -motion.factor(t * phase).norm().ln());
        let slope = |i: usize| (SLOPES * (2.0 * i as f64 / STEPS as f64 - 1.0)).exp();
        let steps = if grid.is_line() { 0..0 } else { 0..STEPS + 1 };
        Self { along_x: law(dx.recip()), along_y: law(0.0), by_slope: steps.map(|i| law(slope(i) / dy)).collect() }
    }

    /// The law on a link with a share `k^2` in the contour, `k` the cosine of its angle to the normal of the edge.
    pub(crate) fn at(&self, [dy, _]: [isize; 2], share: f64) -> EdgeLaw {
        match self.by_slope.as_slice() {
            _ if dy == 0 => self.along_x,
            [] => self.along_y,
            laws => self.between(laws, share),
        }
    }

    /// The law of a share between those of the table.
    fn between(&self, laws: &[EdgeLaw], share: f64) -> EdgeLaw {
        let slope = (1.0 / share - 1.0).max(0.0).sqrt().ln();
        let place = (slope + SLOPES) / (2.0 * SLOPES) * STEPS as f64;
        if place.is_nan() || place < 0.0 {
            return self.along_y;
        }
        let before = (place as usize).min(STEPS - 1);
        laws[before].towards(laws[before + 1], (place - before as f64).min(1.0))
    }
}

impl EdgeLaw {
    /// The law of the stiffness whose logarithm, over that of the half-space of the contact modulus, is a function of the phase from node
    /// to node.
    fn new(logarithm: impl Fn(f64) -> f64) -> Self {
        let weight = |t: f64| 0.25 / (0.5 * t).sin().powi(2) - 1.0 / (t * t);
        let (mean, near) = (integral(0.0, PI, &logarithm), integral(0.0, PI, |t| logarithm(t) * weight(t)));
        let far = integral(0.0, 1.0, |s| logarithm(PI / s)) / PI;
        Self { stiffness: (mean / PI).exp(), excess: NODE_EXCESS_PER_SWITCH_LINE - (near - far) / PI }
    }
}
