//! When a solver stops.

use crate::error::SettingError;
use serde::{Deserialize, Serialize};

/// When a solver stops, besides at the wish of its observer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
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
        let stop = Self { tolerance, max_iterations };
        stop.check()?;
        Ok(stop)
    }

    /// Checks what was read from elsewhere.
    ///
    /// # Errors
    /// The errors of [`Stop::new`].
    pub fn check(&self) -> Result<(), SettingError> {
        let Self { tolerance, max_iterations } = *self;
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(SettingError::Range { name: "the tolerance", value: tolerance, range: "(0, infinity)" });
        }
        if max_iterations == 0 {
            return Err(SettingError::Range { name: "the iteration cap", value: 0.0, range: "[1, infinity)" });
        }
        Ok(())
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
