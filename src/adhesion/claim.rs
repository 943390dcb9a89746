//! The claim of a state in equilibrium: stable, marginal, a saddle, stationary or the solution.

use super::attraction::Attraction;
use super::control::AdhesiveControl;
use super::curvature::MARGINAL;
use crate::contact::{Problem, ResultClaim};

/// The claim of a state in equilibrium with a gap, and with its least curvature and the error of it, over the softest stiffness. A state in which
/// all nodes touch has no curvature and is stable.
pub(super) fn claim(
    problem: &Problem,
    attraction: &Attraction,
    control: AdhesiveControl,
    gap: &[f64],
    curvature: Option<(f64, f64)>,
) -> ResultClaim {
    let uniform = problem.solid().uniform_compliance().map_or(0.0, f64::recip);
    let [softest, _] = problem.compliance().stiffness_range();
    let is_periodic = problem.surface().grid().is_periodic();
    let stiffness = match control {
        AdhesiveControl::MeanPressure(_) => 0.0,
        AdhesiveControl::MeanGap(_) => softest,
        AdhesiveControl::Approach(_) if is_periodic => softest.min(uniform),
        AdhesiveControl::Approach(_) => 0.0,
    };
    match curvature {
        _ if attraction.steepest() < stiffness => ResultClaim::Solution,
        None if is_periodic && gap.iter().all(|gap| *gap == 0.0) => ResultClaim::Stable,
        None => ResultClaim::Stationary,
        Some((least, error)) if least - error > MARGINAL => ResultClaim::Stable,
        Some((least, _)) if least >= -MARGINAL => ResultClaim::Marginal,
        Some(_) => ResultClaim::Saddle,
    }
}
