//! How all trials went.

use super::report::Report;
use super::time_step::TimeSteps;
use super::verdict::Verdict;
use crate::lab::Rival;
use std::fmt;

/// How many trials ended in which way; displays as a sentence, and a second one if not all is well.
pub struct Tally {
    converged: usize,
    refused: usize,
    not_converged: usize,
    wrong: usize,
    /// Trials in which the multilevel solver missed the end that they demand.
    missed: usize,
    /// Whether the time steps are those of theory, as far as they were measured.
    agrees: bool,
}

impl Tally {
    /// The tally of some reports, and of the time steps if they were measured.
    pub fn of(reports: &[Report], time_steps: Option<&TimeSteps>) -> Self {
        let count = |verdict| reports.iter().filter(|report| report.verdict == verdict).count();
        let is_missed = |report: &&Report| report.solver == Rival::MULTILEVEL.name && !report.as_demanded;
        Self {
            converged: count(Verdict::Converged),
            refused: count(Verdict::Refused),
            not_converged: count(Verdict::NotConverged),
            wrong: count(Verdict::Wrong),
            missed: reports.iter().filter(is_missed).count(),
            agrees: time_steps.is_none_or(TimeSteps::agrees),
        }
    }

    /// Whether nothing is wrong, the multilevel solver did all that was demanded, and the time steps are those of theory.
    pub fn is_stable(&self) -> bool {
        self.wrong == 0 && self.missed == 0 && self.agrees
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { converged, refused, not_converged, wrong, missed, agrees } = self;
        let runs = converged + refused + not_converged + wrong;
        write!(
            f,
            "{runs} runs: {converged} converged, {refused} refused, {not_converged} not converged, {wrong} wrong"
        )?;
        if self.is_stable() {
            return Ok(());
        }
        let steps = if *agrees { "" } else { ", and a time step is not what theory says" };
        write!(f, "\nnot stable: {wrong} runs are wrong, the multilevel solver misses the end of {missed} cases{steps}")
    }
}
