//! The state of a session as the page is told.

use super::knobs::Knobs;
use crate::contact::{Contact, Observables, Step};
use crate::theory::Exact;
use serde::Serialize;

/// The state of a session.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Report {
    /// Grows with every change.
    pub revision: u64,
    /// Whether something is being solved.
    pub busy: bool,
    /// The latest solve.
    pub run: Option<RunReport>,
    /// The latest sweep over the load.
    pub sweep: Option<SweepReport>,
    /// Name of the recording whose curves stand beside those of new ones.
    pub pinned: Option<String>,
    /// The fault that kept the last order from being carried out, in one sentence.
    pub fault: Option<String>,
}

/// A solve, running or ended.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// Name of its recording.
    pub id: String,
    /// Name for people.
    pub title: String,
    /// Command that repeats the solve.
    pub command: String,
    /// Setup that repeats the solve, in TOML.
    pub setup: String,
    /// The state of the knobs.
    pub knobs: Knobs,
    /// Whether solver and recording have ended.
    pub ended: bool,
    /// Numbers of its latest state.
    pub numbers: Option<Numbers>,
    /// Exact values.
    pub exact: Option<ExactNumbers>,
}

/// Exact values of a contact.
#[derive(Debug, Clone, Serialize)]
pub struct ExactNumbers {
    /// Name of the theory.
    pub name: &'static str,
    /// Share of the area in contact.
    pub relative_area: f64,
    /// `kappa_r`.
    pub kappa_r: Option<f64>,
}

/// The numbers of a state; those that are infinite or not known are null in JSON.
#[derive(Debug, Clone, Serialize)]
pub struct Numbers {
    /// Status in words: `running`, or how the solve ended.
    pub status: String,
    /// Grid level of a running solve.
    pub level: usize,
    /// Seconds of the solver, recording left out.
    pub seconds: f64,
    /// All observables.
    #[serde(flatten)]
    pub observables: Observables,
}

/// A sweep over the load.
#[derive(Debug, Clone, Serialize)]
pub struct SweepReport {
    /// Name of its recording.
    pub id: String,
    /// Name for people.
    pub title: String,
    /// The state of the knobs; the load does not count.
    pub knobs: Knobs,
    /// Whether solver and recording have ended.
    pub ended: bool,
    /// Contacts, from the smallest load on.
    pub points: Vec<SweepPoint>,
}

/// A contact of a sweep, and what theories say.
#[derive(Debug, Clone, Serialize)]
pub struct SweepPoint {
    /// All observables.
    #[serde(flatten)]
    pub observables: Observables,
    /// Persson's relative area.
    pub persson: f64,
    /// Exact values.
    pub exact: Option<ExactNumbers>,
}

impl From<&Exact> for ExactNumbers {
    fn from(exact: &Exact) -> Self {
        Self { name: exact.name, relative_area: exact.relative_area, kappa_r: exact.kappa_r }
    }
}

impl Numbers {
    /// The numbers of a step.
    pub fn of_step(step: &Step<'_>) -> Self {
        let (level, seconds) = (step.phase().level, step.work().seconds);
        Self { status: "running".into(), level, seconds, observables: Observables::of(step) }
    }

    /// The numbers of a result.
    pub fn of_contact(contact: &Contact) -> Self {
        let (status, seconds) = (contact.status.to_string(), contact.work.seconds);
        Self { status, level: 0, seconds, observables: Observables::of(contact) }
    }
}
