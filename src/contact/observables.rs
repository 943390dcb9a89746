//! Observables of a contact whose estimated error on its grid is smaller than their value.

use super::Observables;

impl Observables {
    /// The relative area, where the grid resolves it.
    pub fn resolved_area(&self) -> Option<f64> {
        resolved(self.relative_area, self.relative_area_error)
    }

    /// `kappa`, where the grid resolves the relative area.
    pub fn resolved_kappa(&self) -> Option<f64> {
        resolved(self.kappa, self.relative_area_error)
    }

    /// `kappa_r`, where the grid resolves it.
    pub fn resolved_kappa_r(&self) -> Option<f64> {
        resolved(self.kappa_r, self.kappa_r_error)
    }
}

/// A value whose error is smaller than the value. If patches have too few nodes, the value is 0 or NaN, or its error is
/// unknown or infinite.
fn resolved(value: f64, error: f64) -> Option<f64> {
    (value.is_finite() && value > 0.0 && error < 1.0).then_some(value)
}
