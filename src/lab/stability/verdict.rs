//! How a trial ended, and how it should.

use crate::contact::Status;
use serde::Serialize;
use strum::Display;

/// A certificate that rounding must not prevent.
const ATTAINABLE: f64 = 1e-12;

/// How a trial ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "lowercase")]
pub enum TrialVerdict {
    /// The solver reports convergence, and the check confirms it.
    Converged,
    /// The solver refused it with a clear sentence.
    Refused,
    /// The solver says that it has not converged.
    #[strum(to_string = "not converged")]
    NotConverged,
    /// The solver and the check disagree, or there was a panic: this must never happen.
    #[strum(to_string = "WRONG")]
    Wrong,
}

/// The end that a trial demands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display)]
#[strum(serialize_all = "lowercase")]
pub enum Demand {
    /// The contact must be solved.
    Solution,
    /// The contact must be refused.
    Refusal,
    /// The contact must be solved or refused.
    Either,
    /// The contact must be solved, or the budget run out on the way: of a solver that takes too many steps on a fine grid.
    #[strum(to_string = "solution or budget")]
    Budget,
    /// The solver must come to [`ATTAINABLE`] and say that it comes no further.
    Limit,
}

impl Demand {
    /// Whether a trial is as demanded that ended in `verdict` with the certificate `eta` and the `status` of the solver, if it
    /// returned anything.
    pub fn is_met(self, verdict: TrialVerdict, eta: Option<f64>, status: Option<Status>) -> bool {
        let ended_by = |reason| verdict == TrialVerdict::NotConverged && status == Some(reason);
        match self {
            Self::Solution => verdict == TrialVerdict::Converged,
            Self::Refusal => verdict == TrialVerdict::Refused,
            Self::Either => matches!(verdict, TrialVerdict::Converged | TrialVerdict::Refused),
            Self::Budget => verdict == TrialVerdict::Converged || ended_by(Status::StoppedByObserver),
            Self::Limit => {
                let ended = verdict == TrialVerdict::Converged || ended_by(Status::Stalled);
                ended && eta.is_some_and(|eta| eta < ATTAINABLE)
            }
        }
    }
}
