//! The quantities of a contact whose errors are measured.

use crate::contact::{Observables, Reading};
use crate::theory::Exact;

/// The names of the quantities: area and `kappa_r` have resolved edges, unless their nodes are counted.
pub(crate) const QUANTITIES: [&str; 6] =
    ["area", "kappa_r", "mean gap", "peak pressure", "area nodes", "kappa_r nodes"];
/// The first of them, which are recommended.
pub(crate) const BEST: usize = 4;
/// The place of `kappa_r` among them.
pub(crate) const KAPPA_R: usize = 1;
/// The place of `kappa_r` of counted nodes.
pub(crate) const KAPPA_R_COUNTED: usize = 5;

/// One value of each quantity, where there is one; or one relative error of each.
pub(crate) type QuantityValues = [Option<f64>; QUANTITIES.len()];

/// The values of a contact, or of a step on the finest grid.
pub(crate) fn found<'a>(state: impl Into<Reading<'a>>) -> QuantityValues {
    let it = Observables::new(state);
    let best = [it.relative_area, it.kappa_r, it.mean_gap, it.max_pressure];
    let [area, kappa_r, gap, peak] = best.map(Some);
    [area, kappa_r, gap, peak, Some(it.relative_area_counted), Some(it.kappa_r_counted)]
}

/// The values of an exact solution.
pub(crate) fn exact(exact: &Exact) -> QuantityValues {
    truth([Some(exact.relative_area), exact.kappa_r, exact.mean_gap, exact.max_pressure])
}

/// The values that all quantities should have: counted nodes those of resolved edges.
pub(crate) fn truth([area, kappa_r, gap, peak]: [Option<f64>; BEST]) -> QuantityValues {
    [area, kappa_r, gap, peak, area, kappa_r]
}

/// Relative errors, with their signs.
pub(crate) fn errors(found: &QuantityValues, truth: &QuantityValues) -> QuantityValues {
    std::array::from_fn(|i| Some(found[i]? / truth[i]? - 1.0))
}

/// Root mean squares of several errors.
pub(crate) fn root_mean_square(all: &[QuantityValues]) -> QuantityValues {
    std::array::from_fn(|i| {
        let squares = all.iter().map(|errors| errors[i].map(|e| e * e)).sum::<Option<f64>>()?;
        Some((squares / all.len() as f64).sqrt())
    })
}
