//! When a solver stops.

use crate::contact::Certificate;
use crate::error::SettingError;
use serde::{Deserialize, Serialize};

/// The smallest tolerance of the pressure, whose square is still a normal double.
const LEAST_PRESSURE_TOLERANCE: f64 = 1e-100;

/// When a solver stops: the goals for its [`Certificate`], all of which must be met, and the largest number of
/// iterations. (An observer can stop it, too.)
///
/// | goal                                          | where                                    |
/// |-----------------------------------------------|------------------------------------------|
/// | `eta <= tolerance`                            | always                                   |
/// | `eta_gap <= sqrt(tolerance)`                  | at a given mean gap                      |
/// | `pressure_error_bound <= pressure_tolerance`  | where a pressure tolerance is given      |
///
/// `eta` is an error in energy, of second order in that of the pressure; the relative error of a load, which `eta_gap`
/// estimates, is of first order, so its goal is the root of the tolerance. `eta` is divided by the rms height, which is
/// not the relevant height for an indenter that is narrow in its cell, or for very small loads. Use a pressure
/// tolerance in these cases.
///
/// ```
/// use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// // a sphere that touches on a three-thousandth of its cell
/// let sphere = Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([256, 256], [4.0, 4.0])?)?;
/// let problem = Problem::new(sphere, ContactModulus(1.0), Load::MeanPressure(4e-6))?;
/// let [loose, tight] = [Stop::default(), Stop::default().with_pressure_tolerance(1e-4)?]
///     .map(|stop| Multilevel.solve(&problem, &stop, &mut ()).and_then(asperity::Contact::converged));
/// assert!(loose?.certificate.pressure_error_bound > 1e-3 && tight?.certificate.pressure_error_bound <= 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Stop {
    tolerance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pressure_tolerance: Option<f64>,
    max_iterations: usize,
}

impl Stop {
    /// Stops at a certificate `eta <= tolerance` (dimensionless, see [`Certificate`]), or unconverged after `max_iterations`.
    ///
    /// # Errors
    /// [`SettingError::Range`] for a tolerance that is not positive and finite or for no iterations.
    pub fn new(tolerance: f64, max_iterations: usize) -> Result<Self, SettingError> {
        let stop = Self { tolerance, pressure_tolerance: None, max_iterations };
        stop.check()?;
        Ok(stop)
    }

    /// The stop with a goal for the bound of the relative error of the pressure, too, see
    /// [`Certificate::pressure_error_bound`].
    ///
    /// # Errors
    /// [`SettingError::Range`] for a tolerance that is not finite, or below 1e-100.
    pub fn with_pressure_tolerance(self, pressure_tolerance: f64) -> Result<Self, SettingError> {
        let stop = Self { pressure_tolerance: Some(pressure_tolerance), ..self };
        stop.check()?;
        Ok(stop)
    }

    /// Checks values that were read from a file.
    ///
    /// # Errors
    /// The errors of [`Stop::new`] and [`Stop::with_pressure_tolerance`].
    pub fn check(&self) -> Result<(), SettingError> {
        let Self { tolerance, pressure_tolerance, max_iterations } = *self;
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(SettingError::Range { name: "the tolerance", value: tolerance, range: "(0, infinity)" });
        }
        if let Some(value) = pressure_tolerance
            && !(value.is_finite() && value >= LEAST_PRESSURE_TOLERANCE)
        {
            return Err(SettingError::Range { name: "the pressure tolerance", value, range: "[1e-100, infinity)" });
        }
        if max_iterations == 0 {
            return Err(SettingError::Range { name: "the iteration cap", value: 0.0, range: "[1, infinity)" });
        }
        Ok(())
    }

    /// The certificate `eta` to reach.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// The certificate `eta_gap` to reach at a given mean gap.
    pub fn gap_tolerance(&self) -> f64 {
        self.tolerance.sqrt()
    }

    /// The bound of the relative error of the pressure to reach, if there is one.
    pub fn pressure_tolerance(&self) -> Option<f64> {
        self.pressure_tolerance
    }

    /// The stop with another largest number of iterations, at least one.
    pub(crate) fn within(self, max_iterations: usize) -> Self {
        Self { max_iterations: max_iterations.max(1), ..self }
    }

    /// The stop with another certificate to reach, which must be positive.
    pub(crate) fn at(self, tolerance: f64) -> Self {
        Self { tolerance, pressure_tolerance: None, ..self }
    }

    /// Largest number of iterations.
    pub fn max_iterations(&self) -> usize {
        self.max_iterations
    }

    /// Whether a certificate meets all goals.
    pub fn is_met(&self, certificate: &Certificate) -> bool {
        certificate.eta <= self.tolerance
            && certificate.eta_gap <= self.gap_tolerance()
            && self.pressure_tolerance.is_none_or(|tolerance| certificate.pressure_error_bound <= tolerance)
    }

    /// How far a certificate is from the goals: `eta`, or the `eta` that would be as far from its tolerance as another
    /// error is from its own, if that is larger. The bound of the pressure enters with its square.
    pub fn distance(&self, certificate: &Certificate) -> f64 {
        let gap = certificate.eta_gap / self.gap_tolerance() * self.tolerance;
        let pressure = self.pressure_tolerance.map_or(0.0, |it| (certificate.pressure_error_bound / it).powi(2));
        certificate.eta.max(gap).max(pressure * self.tolerance)
    }
}

impl Default for Stop {
    /// `eta <= 1e-8` within 100 000 iterations.
    fn default() -> Self {
        Self { tolerance: 1e-8, pressure_tolerance: None, max_iterations: 100_000 }
    }
}
