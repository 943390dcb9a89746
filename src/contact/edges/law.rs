//! The law of a straight edge: its position, computed from the nodes on both sides.

use std::f64::consts::{E, PI};

/// Excess `c` of counted nodes over the true contact of a line, per switch between contact and gap, in nodes: exactly
/// `1/4 + sum_{m >= 1} (1/2 - Si(m pi)/pi)`, the mean over all places of the edge between two nodes, see [`super::Edges`].
pub const NODE_EXCESS_PER_SWITCH_LINE: f64 = 0.190_009_5;

/// Weight of the gap against the pressure in the law of the edge: half of the square of the factor of the symbol at 0.
pub(crate) const GAP_WEIGHT: f64 = PI / (2.0 * E);

/// Pressure and weighted gap of the second node on either side of an edge, in those of the first one, where that is as far from the
/// edge as a first node can be: from the coefficients of the factors.
const SECOND_PRESSURE: f64 = 1.410_510_1;
const SECOND_GAP: f64 = 2.589_489_9;

/// Excesses that differ by less are those of one law.
const ELASTIC_EXCESS: f64 = 1e-3;

/// The law of an edge in one solid: `s = -c + P / (P + (pi / 2e) m G)`, see [`super::Edges`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeLaw {
    /// `m`, the geometric mean of the stiffness of the waves of a link over that of the half-space of the contact modulus.
    pub stiffness: f64,
    /// `c`, the mean excess of counted nodes, in spacings of the link.
    pub excess: f64,
}

impl EdgeLaw {
    /// That of an elastic half-space.
    pub(crate) const ELASTIC: Self = Self { stiffness: 1.0, excess: NODE_EXCESS_PER_SWITCH_LINE };

    /// Whether it is that of an elastic half-space of some modulus.
    pub(crate) fn is_elastic(self) -> bool {
        (self.excess - Self::ELASTIC.excess).abs() < ELASTIC_EXCESS
    }

    /// The strength of the edge on the link from a node under the pressure `p`, as a length in the law, to one with the gap `gap`.
    pub(crate) fn strength(self, p: f64, gap: f64) -> f64 {
        p + self.stiffness * gap
    }

    /// The place of an edge of some strength.
    pub(crate) fn place(self, p: f64, strength: f64) -> f64 {
        p / strength - self.excess
    }

    /// The law between this one and another one, at a share of the way.
    pub(crate) fn towards(self, other: Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + share * (b - a);
        Self {
            stiffness: between(self.stiffness.ln(), other.stiffness.ln()).exp(),
            excess: between(self.excess, other.excess),
        }
    }
}

/// Pressure and gap of a node on one side of an edge, as lengths in the law of the edge.
#[derive(Clone, Copy)]
pub(crate) struct EdgeSide {
    pub touches: bool,
    /// `p l / E*`, a length.
    pub pressure: f64,
    /// `(pi / 2e) g`, a length; 0 in contact.
    pub gap: f64,
}

impl EdgeSide {
    /// The distance from an edge into the contact, in spacings of the link projected on the normal: `P k / a - c` of the last node and
    /// `-c - (pi / 2e) m G / a` of the next one, exactly, `a` being the strength of the edge; linear up to the second one on either side, as
    /// it is there, and farther as in the continuum.
    #[inline]
    pub(crate) fn distance(self, edge: &EdgeScale) -> f64 {
        let c = edge.excess;
        if self.touches {
            let p = self.pressure * edge.per_pressure;
            match p {
                _ if p <= 1.0 => p - c,
                _ if p <= SECOND_PRESSURE => 1.0 - c + (p - 1.0) / (SECOND_PRESSURE - 1.0),
                _ => PI * PI / (4.0 * E) * p * p,
            }
        } else {
            let g = self.gap * edge.per_gap;
            match g {
                _ if g <= 1.0 => -c - g,
                _ if g <= SECOND_GAP => -c - 1.0 - (g - 1.0) / (SECOND_GAP - 1.0),
                _ => -(0.75 * E.sqrt() * g).powi(2).cbrt(),
            }
        }
    }
}

/// The scale of pressures and gaps beside an edge: its strength `a = P k + (pi / 2e) m G`.
pub(crate) struct EdgeScale {
    /// `k / a`.
    per_pressure: f64,
    /// `m / a`.
    per_gap: f64,
    excess: f64,
}

impl EdgeScale {
    /// That of the edge on a link from the last node in contact to the next one, for the cosine `k`.
    pub(crate) fn new(law: EdgeLaw, cosine: f64, [last, next]: [EdgeSide; 2]) -> Self {
        let per_strength = 1.0 / (last.pressure * cosine + law.stiffness * next.gap);
        Self { per_pressure: cosine * per_strength, per_gap: law.stiffness * per_strength, excess: law.excess }
    }
}
