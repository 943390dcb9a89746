//! The results of a job.

use super::history::HistoryOutcome;
use crate::contact::{
    Contact, Observables, PartialSlip, warning_of_friction, warning_of_rim, warning_of_trail, warnings_of,
};
use crate::diagnosis::Findings;
use crate::setup::Setup;
use crate::study::Refinement;
use crate::warning::Warning;

/// The results of a job.
pub struct Outcome {
    /// The contact of each run, in their order.
    pub solved: Vec<Solved>,
    /// Why the first run was slow, if the job has a diagnosis.
    pub diagnosis: Option<Findings>,
}

/// What one run has found. A recording that could not be finished stands in [`Contact::failure`], or in [`HistoryOutcome::failure`]; contact and states
/// are complete in any case.
pub struct Solved {
    /// The setup that was solved, on its final grid.
    pub setup: Setup,
    /// The contact; of a run with several states, that of the last one.
    pub contact: Contact,
    /// The states, of a run with several.
    pub history: Option<HistoryOutcome>,
    /// The stick and slip areas under the tangential load of the setup; none for a contact that is not converged.
    pub slip: Option<PartialSlip>,
    /// Whether area and `kappa_r` were accurate enough on the last grid, if the grid was automatic.
    pub is_settled: bool,
}

impl Solved {
    /// Reasons to doubt the surface and the contact.
    pub fn warnings(&self) -> Vec<Warning> {
        let Self { setup, contact, history, is_settled, .. } = self;
        let mut warnings = setup.surface.warnings(contact.problem.surface());
        if let Some(history) = history {
            warnings.extend(history.warnings());
            return warnings;
        }
        warnings.extend(warnings_of_contacts(setup, &[contact]));
        warnings.extend((!is_settled).then(Refinement::warning));
        warnings
    }
}

/// Reasons to doubt contacts of a setup under one load or several, each for itself; not those about their surface.
pub fn warnings_of_contacts(setup: &Setup, contacts: &[&Contact]) -> Vec<Warning> {
    let Some(first) = contacts.first() else { return Vec::new() };
    let found: Vec<Observables> = contacts.iter().map(|it| Observables::new(*it)).collect();
    let mut warnings = warnings_of(&found.iter().collect::<Vec<_>>(), first.problem.law());
    warnings.extend(contacts.iter().find_map(|it| warning_of_rim(it)));
    warnings.extend(warning_of_trail(contacts.iter().copied()));
    warnings.extend(warning_of_friction(contacts.iter().copied()));
    warnings.extend(setup.warning_of_coupling());
    warnings.extend(setup.warnings_of_creep());
    warnings
}

impl Outcome {
    /// Reasons to doubt the surfaces and contacts of all runs.
    pub fn warnings(&self) -> Vec<Warning> {
        self.solved.iter().flat_map(Solved::warnings).collect()
    }
}
