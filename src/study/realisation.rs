//! A setup and the loads it is solved under.

use super::load_curve::LoadCurve;
use crate::contact::{Contact, Load};
use crate::error::{ProblemError, SetupError, StudyError};
use crate::grid::Grid;
use crate::setup::Setup;

/// A setup and the loads it is solved under, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Realisation {
    /// Name in tables.
    pub name: String,
    /// The contact, but for its load.
    pub setup: Setup,
    /// Reduced pressures `p* = <p>/(gbar E*)` instead of its load, each but the first started from the contact before.
    pub loads: Vec<f64>,
}

impl Realisation {
    /// Solves the setup under its loads, each from the contact before, and shows each contact to `each`, which may end that.
    ///
    /// # Errors
    /// For surfaces and loads that cannot be, and those of `each`. What did not converge is shown all the same.
    pub fn press<E: From<StudyError>>(&self, mut each: impl FnMut(&Contact) -> Result<(), E>) -> Result<(), E> {
        let Some(&first) = self.loads.first() else { return Ok(()) };
        let loads = self.loads.iter().copied().map(Load::ReducedPressure).collect();
        let curve = LoadCurve { setup: self.under(first), loads };
        let problem = curve.setup.problem().map_err(StudyError::from)?;
        curve.press(&problem, |_| (), |_, contact| each(contact))
    }

    /// Checks all that can be checked before a surface is made, and returns the grid.
    ///
    /// # Errors
    /// The errors of [`Setup::check`], and for a load that is not positive.
    pub fn check(&self) -> Result<Grid, SetupError> {
        let is_wrong = |load: &&f64| !(load.is_finite() && **load > 0.0);
        match self.loads.iter().find(is_wrong) {
            Some(&value) => Err(ProblemError::NotPositive { name: "reduced pressure", value }.into()),
            None => self.under(1.0).check(),
        }
    }

    /// The setup under a reduced pressure.
    pub fn under(&self, reduced_pressure: f64) -> Setup {
        Setup { load: Load::ReducedPressure(reduced_pressure), ..self.setup.clone() }
    }
}
