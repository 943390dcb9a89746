//! A setup and its loads.

use crate::contact::{Contact, Load, Observer};
use crate::error::{ProblemError, SetupError, StudyError};
use crate::grid::Grid;
use crate::history::{Loading, Process};
use crate::setup::Setup;

/// A setup and its loads, which are solved one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Realisation {
    /// Name in tables.
    pub name: String,
    /// The contact, without its load.
    pub setup: Setup,
    /// Loads, which replace that of the setup; each solve starts from the previous contact.
    pub loads: Vec<Load>,
}

impl Realisation {
    /// Solves the setup under its loads, each from the previous contact. `watch` makes the observer of each load.
    /// `each` is called with each contact, and an error of it ends the realisation.
    ///
    /// # Errors
    /// [`StudyError::OneContact`] for a setup with a history; for impossible surfaces and loads, and the errors of `each`. Contacts that did not converge are shown,
    /// too.
    pub fn press<O: Observer, E: From<StudyError>>(
        &self,
        mut watch: impl FnMut(usize) -> O,
        mut each: impl FnMut(&Contact) -> Result<(), E>,
    ) -> Result<(), E> {
        let Some(&first) = self.loads.first() else { return Ok(()) };
        if self.setup.is_history().map_err(StudyError::from)? {
            return Err(StudyError::OneContact.into());
        }
        let problem = self.under(first).problem().map_err(StudyError::from)?;
        let mut loading = Loading::new(problem, self.setup.solver(), self.setup.stop).along(self.loads.clone());
        for number in 0..self.loads.len() {
            let Some(state) = loading.next(&mut watch(number)) else { break };
            each(&state.map_err(StudyError::from)?.contact)?;
        }
        Ok(())
    }

    /// Checks everything that can be checked without generating a surface, and returns the grid.
    ///
    /// # Errors
    /// The errors of [`Setup::check`], and for a load that is not positive.
    pub fn check(&self) -> Result<Grid, SetupError> {
        let is_wrong = |load: &&Load| !(load.value().is_finite() && load.value() > 0.0);
        // with adhesion, surfaces may be pulled
        let wrong = self.loads.iter().find(is_wrong).filter(|_| self.setup.adhesion.is_none());
        match (wrong, self.loads.first()) {
            (Some(load), _) => Err(ProblemError::NotPositive { name: load.name(), value: load.value() }.into()),
            (_, Some(&first)) => self.under(first).check(),
            (_, None) => self.setup.check(),
        }
    }

    /// The setup under a load.
    pub fn under(&self, load: Load) -> Setup {
        self.setup.under(load)
    }

    /// Loads that are reduced pressures `p* = <p>/(gbar E*)`.
    pub fn reduced_pressures(values: &[f64]) -> Vec<Load> {
        values.iter().copied().map(Load::ReducedPressure).collect()
    }
}
