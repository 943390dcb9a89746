//! When a solver stops.

use crate::error::SettingError;

/// When a solver stops, besides at the wish of its observer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    tolerance: f64,
    max_iterations: usize,
}

impl Stop {
    /// Stops at a certificate `eta <= tolerance` (dimensionless, see [`crate::contact::Certificate`]), or unconverged after
    /// `max_iterations`.
    ///
    /// # Errors
    /// [`SettingError::Range`] for a tolerance that is not positive and finite or for no iterations.
    pub fn new(tolerance: f64, max_iterations: usize) -> Result<Self, SettingError> {
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(SettingError::Range { name: "the tolerance", value: tolerance, range: "(0, infinity)" });
        }
        if max_iterations == 0 {
            return Err(SettingError::Range { name: "the iteration cap", value: 0.0, range: "[1, infinity)" });
        }
        Ok(Self { tolerance, max_iterations })
    }

    /// The certificate to reach.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Iterations at the most.
    pub fn max_iterations(&self) -> usize {
        self.max_iterations
    }
}

impl Default for Stop {
    /// `eta <= 1e-8` within 100 000 iterations.
    fn default() -> Self {
        Self { tolerance: 1e-8, max_iterations: 100_000 }
    }
}
