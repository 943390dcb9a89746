//! How all trials went.

use super::report::Report;
use super::verdict::Verdict;
use crate::lab::Rival;
use std::fmt;

/// How many trials ended in which way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    /// Trials that converged.
    pub converged: usize,
    /// Trials that were refused.
    pub refused: usize,
    /// Trials that did not converge, and said so.
    pub not_converged: usize,
    /// Trials that went wrong.
    pub wrong: usize,
    /// Trials in which the multilevel solver missed the end that they demand.
    pub missed: usize,
}

impl Tally {
    /// The tally of some reports.
    pub fn of(reports: &[Report]) -> Self {
        let count = |verdict| reports.iter().filter(|report| report.verdict == verdict).count();
        let is_missed = |report: &&Report| report.solver == Rival::MULTILEVEL.name && !report.as_demanded;
        Self {
            converged: count(Verdict::Converged),
            refused: count(Verdict::Refused),
            not_converged: count(Verdict::NotConverged),
            wrong: count(Verdict::Wrong),
            missed: reports.iter().filter(is_missed).count(),
        }
    }

    /// Whether nothing is wrong, and the multilevel solver did all that was demanded.
    pub fn is_stable(&self) -> bool {
        self.wrong == 0 && self.missed == 0
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { converged, refused, not_converged, wrong, .. } = self;
        let runs = converged + refused + not_converged + wrong;
        write!(f, "{runs} runs: {converged} converged, {refused} refused, {not_converged} not converged, {wrong} wrong")
    }
}
