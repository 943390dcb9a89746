//! The normal of an edge, from the nodes around a link.

use super::law::{EdgeLaw, EdgeScale, EdgeSide};

/// Rounds in which the cosine is found, where they begin, and how much of it each keeps: rounds alternate about the solution.
const ROUNDS: usize = 4;
const FIRST_COSINE: f64 = 0.85;
const KEPT: f64 = 0.4;

/// The normal of an edge against a link.
#[derive(Clone, Copy)]
pub(super) struct EdgeNormal {
    /// Cosine `k` of the angle between normal and link.
    pub cosine: f64,
    /// Share of the link in the contour: `k^2`, but that differences to either side do not cancel in it at the tip of a contact.
    pub weight: f64,
}

impl EdgeNormal {
    /// Along the link.
    pub(crate) const ALONG: Self = Self { cosine: 1.0, weight: 1.0 };
    /// Where nothing is known.
    const UNKNOWN: Self = Self { cosine: 1.0, weight: 0.5 };

    /// The normal by how the distance from the edge changes along a link, from its node in contact to the other, and from each of
    /// them to its neighbours on both sides; `ratio` is the spacing along the link over that across it. Distances take the
    /// cosine, so that it is found in rounds, each with the law for the share of the link in the contour.
    pub(crate) fn new(
        link: [EdgeSide; 2],
        aside: [[EdgeSide; 2]; 2],
        ratio: f64,
        law: impl Fn(f64) -> EdgeLaw,
    ) -> Self {
        let first = Self { cosine: FIRST_COSINE, ..Self::UNKNOWN };
        let found = (0..ROUNDS).fold(first, |last, _| last.next(link, aside, ratio, law(last.weight)));
        if found.cosine.is_finite() && found.weight.is_finite() { found } else { Self::UNKNOWN }
    }

    fn next(self, link: [EdgeSide; 2], aside: [[EdgeSide; 2]; 2], ratio: f64, law: EdgeLaw) -> Self {
        let scale = EdgeScale::new(law, self.cosine, link);
        let distance = |side: EdgeSide| side.distance(&scale);
        let [inside, outside] = link.map(distance);
        let steps = |here: f64, aside: [EdgeSide; 2]| aside.map(|side| (distance(side) - here) * ratio);
        let [a, b] = steps(inside, aside[0]);
        let [c, d] = steps(outside, aside[1]);
        let along = (inside - outside).powi(2);
        let slope = 0.25 * (a - b + c - d);
        let across = 0.25 * (a * a + b * b + c * c + d * d);
        let cosine = (along / (along + slope * slope)).sqrt();
        Self { cosine: KEPT * self.cosine + (1.0 - KEPT) * cosine, weight: along / (along + across) }
    }
}
