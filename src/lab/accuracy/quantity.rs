//! Quantities that people read off a contact.

use crate::contact::{Observables, State};
use crate::theory::Exact;

/// The names of the quantities: area and `kappa_r` are corrected for counting nodes.
pub const QUANTITIES: [&str; 4] = ["area", "kappa_r", "mean gap", "peak pressure"];
/// The place of `kappa_r` among them.
pub const KAPPA_R: usize = 1;

/// One value of each quantity, where there is one; or one relative error of each.
pub type Values = [Option<f64>; QUANTITIES.len()];

/// The values of a contact, or of a step on the finest grid.
pub fn found<'a>(state: impl Into<State<'a>>) -> Values {
    let it = Observables::of(state);
    [it.relative_area_corrected, it.kappa_r_corrected, it.mean_gap, it.max_pressure].map(Some)
}

/// The values of an exact solution.
pub fn exact(exact: &Exact) -> Values {
    [Some(exact.relative_area), exact.kappa_r, exact.mean_gap, exact.max_pressure]
}

/// Relative errors, with their signs.
pub fn errors(found: &Values, truth: &Values) -> Values {
    std::array::from_fn(|i| Some(found[i]? / truth[i]? - 1.0))
}

/// Root mean squares of several errors.
pub fn root_mean_square(all: &[Values]) -> Values {
    std::array::from_fn(|i| {
        let squares = all.iter().map(|errors| errors[i].map(|e| e * e)).sum::<Option<f64>>()?;
        Some((squares / all.len() as f64).sqrt())
    })
}
