//! How all trials went.

use super::kernel::Kernel;
use super::report::TrialReport;
use super::time_step::TimeSteps;
use super::verdict::TrialVerdict;
use std::fmt;

/// How many trials ended in which way; displays as a sentence, and a second one if not all is well.
pub struct Tally {
    converged: usize,
    refused: usize,
    not_converged: usize,
    wrong: usize,
    /// Runs that missed the end that their trial demands, of whichever solver.
    missed: usize,
    /// Whether the displacement of the check is a sum over images, as far as it was measured.
    has_kernel: bool,
    /// Whether the time steps are those of theory, as far as they were measured.
    agrees: bool,
}

impl Tally {
    /// The tally of some reports, and of the kernel and the time steps if they were measured.
    pub fn new(reports: &[TrialReport], kernel: Option<&Kernel>, time_steps: Option<&TimeSteps>) -> Self {
        let count = |verdict| reports.iter().filter(|report| report.verdict == verdict).count();
        Self {
            converged: count(TrialVerdict::Converged),
            refused: count(TrialVerdict::Refused),
            not_converged: count(TrialVerdict::NotConverged),
            wrong: count(TrialVerdict::Wrong),
            missed: reports.iter().filter(|report| !report.as_demanded).count(),
            has_kernel: kernel.is_none_or(Kernel::agrees),
            agrees: time_steps.is_none_or(TimeSteps::agrees),
        }
    }

    /// Whether nothing is wrong, every solver did all that was demanded of it, the displacement of the check is a sum over images, and
    /// the time steps are those of theory.
    pub fn is_stable(&self) -> bool {
        self.wrong == 0 && self.missed == 0 && self.has_kernel && self.agrees
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { converged, refused, not_converged, wrong, missed, has_kernel, agrees } = self;
        let runs = converged + refused + not_converged + wrong;
        write!(
            f,
            "{runs} runs: {converged} converged, {refused} refused, {not_converged} not converged, {wrong} wrong"
        )?;
        if self.is_stable() {
            return Ok(());
        }
        let steps = if *agrees { "" } else { ", and a time step differs from theory" };
        let kernel =
            if *has_kernel { "" } else { ", and the displacement of the check differs from the sum over images" };
        write!(f, "\nnot stable: {wrong} runs are wrong, {missed} have not the required verdict{kernel}{steps}")
    }
}
