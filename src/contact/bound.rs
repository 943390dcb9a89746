//! Steps along gradients that displace nothing.

/// A gradient is uniform whose curvature is this part of that of the longest wave: a few roundings.
const UNIFORM: f64 = 64.0 * f64::EPSILON;

/// Whether a gradient is uniform on all nodes: one whose squares add up to `square`, and its products with what it displaces to
/// `curvature`. A uniform pressure displaces nothing, so that the energy falls evenly along such a gradient.
pub(super) fn is_uniform(square: f64, curvature: f64, softest_stiffness: f64) -> bool {
    curvature.is_nan() || curvature * softest_stiffness <= UNIFORM * square
}

/// Length of the step from pressures against gradients, in pairs, at which the first node leaves the contact; none if none does.
pub(super) fn to_bound(nodes: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    nodes.filter(|(_, gradient)| *gradient > 0.0).map(|(p, gradient)| p / gradient).min_by(f64::total_cmp)
}
