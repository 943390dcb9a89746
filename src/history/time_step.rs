//! A step in time of a viscoelastic contact.

use super::maxwell::MaxwellStep;
use super::profile::StepProfile;
use crate::elastic::PronyTerm;
use crate::surface::Field;

/// A step in time: what its elements do, and what follows for the contact.
pub(super) struct TimeStep {
    pub dt: f64,
    pub elements: Vec<MaxwellStep>,
    /// `g = 1 - sum g_k`.
    pub left: f64,
    /// `m`.
    pub compliance: f64,
}

impl TimeStep {
    /// The step of a solid in relaxation form by a profile.
    pub(crate) fn new(relaxation: &[PronyTerm], relaxed_ratio: f64, profile: &StepProfile) -> Self {
        let elements: Vec<_> = relaxation.iter().map(|term| MaxwellStep::new(term, profile)).collect();
        let left = 1.0 / relaxed_ratio;
        let compliance = 1.0 / (left + elements.iter().map(MaxwellStep::share).sum::<f64>());
        Self { dt: profile.dt(), elements, left, compliance }
    }

    /// `hist = m sum (g_k psi_k p_e0 - e_k y_k)` of fields or of their displacements.
    pub(crate) fn history(&self, effective: &Field, memory: &[Field]) -> Field {
        let share: f64 = self.elements.iter().map(MaxwellStep::share).sum();
        let mut hist = effective * (self.compliance * share);
        for (element, held) in self.elements.iter().zip(memory) {
            hist.scaled_add(-self.compliance * element.keep, held);
        }
        hist
    }
}
