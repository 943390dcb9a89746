//! The normal of an edge, from the nodes around a link.

use super::NODE_EXCESS_PER_SWITCH_LINE;
use std::f64::consts::{E, PI};

/// Pressure and weighted gap of the second node on either side of an edge, in those of the first one, where that is as far from the
/// edge as a first node can be: from the coefficients of the factors.
const SECOND_PRESSURE: f64 = 1.410_510_1;
const SECOND_GAP: f64 = 2.589_489_9;

/// Rounds in which the cosine is found, where they begin, and how much of the cosine before each of them keeps: rounds alternate
/// about the solution.
const ROUNDS: usize = 4;
const FIRST_COSINE: f64 = 0.85;
const DAMPING: f64 = 0.4;

/// What a node on one side of an edge knows of it.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub touches: bool,
    /// `p l / E*`, a length.
    pub pressure: f64,
    /// `(pi / 2e) g`, a length; 0 in contact.
    pub gap: f64,
}

impl Side {
    /// The distance from an edge of the strength `a` into the contact, in spacings of the link projected on the normal:
    /// `P k / a - c` of the last node and `-c - (pi / 2e) G / a` of the next one, exactly; linear up to the second one on either
    /// side, as it is there, and farther as in the continuum.
    fn distance(self, cosine: f64, strength: f64) -> f64 {
        let c = NODE_EXCESS_PER_SWITCH_LINE;
        let (p, g) = (self.pressure * cosine / strength, self.gap / strength);
        match self.touches {
            true if p <= 1.0 => p - c,
            true if p <= SECOND_PRESSURE => 1.0 - c + (p - 1.0) / (SECOND_PRESSURE - 1.0),
            true => PI * PI / (4.0 * E) * p * p,
            false if g <= 1.0 => -c - g,
            false if g <= SECOND_GAP => -c - 1.0 - (g - 1.0) / (SECOND_GAP - 1.0),
            false => -(0.75 * E.sqrt() * g).powi(2).cbrt(),
        }
    }
}

/// The normal of an edge against a link.
#[derive(Clone, Copy)]
pub(super) struct Normal {
    /// Cosine `k` of the angle between normal and link.
    pub cosine: f64,
    /// Share of the link in the contour: `k^2`, but that differences to either side do not cancel in it at the tip of a contact.
    pub weight: f64,
}

impl Normal {
    /// Along the link.
    pub const ALONG: Self = Self { cosine: 1.0, weight: 1.0 };
    /// Where nothing is known.
    const UNKNOWN: Self = Self { cosine: 1.0, weight: 0.5 };

    /// The normal by how the distance from the edge changes along a link, from its node in contact to the other, and from each of
    /// them to its neighbours on both sides; `ratio` is the spacing along the link over that across it. Distances take the
    /// cosine, so that it is found in rounds.
    pub fn of(link: [Side; 2], aside: [[Side; 2]; 2], ratio: f64) -> Self {
        let first = Self { cosine: FIRST_COSINE, ..Self::UNKNOWN };
        let found = (0..ROUNDS).fold(first, |last, _| last.next(link, aside, ratio));
        if found.cosine.is_finite() && found.weight.is_finite() { found } else { Self::UNKNOWN }
    }

    fn next(self, link: [Side; 2], aside: [[Side; 2]; 2], ratio: f64) -> Self {
        let strength = link[0].pressure * self.cosine + link[1].gap;
        let distance = |side: Side| side.distance(self.cosine, strength);
        let [inside, outside] = link.map(distance);
        let steps = |here: f64, aside: [Side; 2]| aside.map(|side| (distance(side) - here) * ratio);
        let [a, b] = steps(inside, aside[0]);
        let [c, d] = steps(outside, aside[1]);
        let along = (inside - outside).powi(2);
        let slope = 0.25 * (a - b + c - d);
        let across = 0.25 * (a * a + b * b + c * c + d * d);
        let cosine = (along / (along + slope * slope)).sqrt();
        Self { cosine: self.cosine.powf(DAMPING) * cosine.powf(1.0 - DAMPING), weight: along / (along + across) }
    }
}
