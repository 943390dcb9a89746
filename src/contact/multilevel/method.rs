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
    /// By inner iterations with transforms in double precision.
    Nested,
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

/// A node without pressure belongs to the first set if it penetrates by more than this part of the deepest penetration. Where the
/// pressure comes from a coarser grid, half of all nodes near the set penetrate a little. From a pressure near the solution the part is
/// `DEEPENING` times the certificate, if that is less.
const DEEP: f64 = 0.5;
const DEEPENING: f64 = 30.0;

/// Reduction of the residual in an inner update, and in one near the solution.
const REDUCTION: f64 = 0.05;
const NEAR_REDUCTION: f64 = 0.1;

impl UpdateMethod {
    /// The way to begin with. Lines, on which transforms are cheap and the stiffnesses of waves differ most, do not gain from single
    /// precision, and inner iterations know nothing of nodes that yield.
    pub(crate) fn first(problem: &Problem, pressure: &SparsePressure) -> Self {
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

    /// The way to begin with from a given pressure that is near the solution: inner iterations wherever they are possible. Each of their
    /// updates saves a displacement, and few updates are needed.
    pub(crate) fn near(problem: &Problem, pressure: &SparsePressure) -> Self {
        match Self::first(problem, pressure) {
            Self::Double
                if matches!(problem.ceiling(), Ceiling::Uniform(_)) && !pressure.reaches(problem.ceiling()) =>
            {
                Self::Nested
            }
            first => first,
        }
    }

    /// The next more accurate way.
    pub(crate) fn slower(self) -> Self {
        match self {
            Self::Split => Self::Single,
            Self::Single => Self::Exact,
            Self::Nested | Self::Exact | Self::Double => Self::Double,
        }
    }

    /// The kind of step that recordings and diagnoses show for a free update in this way.
    pub(crate) fn decision(self) -> Decision {
        match self {
            Self::Split => Decision::SplitCompliance,
            Self::Single => Decision::SinglePrecision,
            Self::Nested | Self::Exact | Self::Double => Decision::WholeSet,
        }
    }

    /// Whether a free update is an inner iteration.
    pub(crate) fn has_inner_iterations(self) -> bool {
        matches!(self, Self::Split | Self::Single | Self::Nested)
    }
}

/// How an inner iteration goes about its updates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum InnerPace {
    /// From a pressure that was interpolated, or is far off.
    Wide,
    /// From a given pressure near the solution. Most nodes that penetrate belong to the first set. Updates are loose until the set
    /// stays as it is. From then on conjugate gradients go on to the goal without a restart.
    Near,
}

impl InnerPace {
    /// The part of the deepest penetration from which on a node belongs to the first set, at a certificate.
    pub(crate) fn deep(self, eta: f64) -> f64 {
        if self == Self::Near { DEEP.min(DEEPENING * eta) } else { DEEP }
    }

    /// The reduction of the residual in the first updates.
    pub(crate) fn reduction(self) -> f64 {
        if self == Self::Near { NEAR_REDUCTION } else { REDUCTION }
    }
}
