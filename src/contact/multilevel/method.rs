//! The way in which free updates are made.

use super::support::SparsePressure;
use crate::contact::{Ceiling, Decision, Problem};

/// How free updates are made, from the cheapest way to the most accurate one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum UpdateMethod {
    /// By inner iterations with the split compliance, where it is cheaper than transforms.
    Split,
    /// By inner iterations with transforms in single precision.
    Single,
    /// One update each, whose displacement is computed in double precision; corrections in single precision.
    Exact,
    /// One update each, whose correction and displacement are computed in double precision.
    Double,
}

/// Largest ratio of the stiffnesses of waves for corrections in single precision, with images and without. Short waves displace by so
/// much less than long ones that the rounding of these, some 1e-7, would hide them. Without images the softest field is that of a
/// uniform pressure on the padded grid, which is softer than any that occurs.
const WIDEST: f64 = 2e4;
const WIDEST_FREE: f64 = 1e5;

impl UpdateMethod {
    /// The way to begin with. Lines, on which transforms are cheap and the stiffnesses of waves differ most, do not gain from single
    /// precision, and inner iterations know nothing of nodes that yield.
    pub fn first(problem: &Problem, pressure: &SparsePressure) -> Self {
        let compliance = problem.compliance();
        let [softest, stiffest] = compliance.stiffness_range();
        let widest = if compliance.is_diagonal() { WIDEST } else { WIDEST_FREE };
        if problem.surface().grid().is_line() || stiffest > widest * softest {
            Self::Double
        } else if matches!(problem.ceiling(), Ceiling::Field(_)) || pressure.reaches(problem.ceiling()) {
            Self::Exact
        } else {
            Self::Split
        }
    }

    /// The next more accurate way.
    pub fn slower(self) -> Self {
        match self {
            Self::Split => Self::Single,
            Self::Single => Self::Exact,
            Self::Exact | Self::Double => Self::Double,
        }
    }

    /// The kind of step that recordings and diagnoses show for a free update in this way.
    pub fn decision(self) -> Decision {
        match self {
            Self::Split => Decision::SplitCompliance,
            Self::Single => Decision::SinglePrecision,
            Self::Exact | Self::Double => Decision::WholeSet,
        }
    }

    /// Whether a free update is an inner iteration.
    pub fn has_inner_iterations(self) -> bool {
        matches!(self, Self::Split | Self::Single)
    }
}
