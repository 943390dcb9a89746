//! Why a run took so many steps, for the page.

use super::session_recording::SolvedRun;
use crate::contact::{MonotoneSets, Observer, Solver, Step, Wish};
use crate::diagnosis::{Diagnosis, Findings, Reference, SpectrogramRow};
use serde::Serialize;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Largest number of steps whose errors are reported.
const MOST_STEPS: usize = 240;

/// Why a run was slow, and what the solver did.
#[derive(Serialize)]
pub(crate) struct Why {
    #[serde(flatten)]
    findings: Findings,
    /// Length of the cell along x.
    length: f64,
    errors: Errors,
    decisions: Decisions,
}

/// The error of the displacement of each step in each band of wavelengths, over the displacement of the end in the same band.
#[derive(Serialize)]
struct Errors {
    /// Longest and shortest wavelength of each band, from the longest waves on.
    wavelengths: Vec<[f64; 2]>,
    /// Numbers of the steps.
    steps: Vec<usize>,
    /// Errors, a row for each step.
    rows: Vec<Vec<f64>>,
}

/// What the solver did, stretch by stretch of steps on which it did the same on the same grid level.
#[derive(Default, Serialize)]
struct Decisions {
    stretches: Vec<Stretch>,
    /// Number of steps so far, and after which the solve ends.
    #[serde(skip)]
    steps: [usize; 2],
}

#[derive(Serialize)]
struct Stretch {
    name: &'static str,
    level: usize,
    /// First and last step.
    steps: [usize; 2],
}

impl Why {
    /// Solves the setup again, and compares each step with the final state. None if this fails, and for the states of a process, which are
    /// many solves.
    pub(crate) fn find(solved: &SolvedRun) -> Option<Self> {
        if solved.report.process.is_some() {
            return None;
        }
        let (contact, (method, stop)) = (&solved.last.contact, solved.report.knobs.method());
        let solver: &dyn Solver = if contact.problem.is_moving() { &MonotoneSets } else { method.solver() };
        let mut diagnosis = Diagnosis::new(&contact.problem, Some(Arc::new(Reference::from_contact(contact))));
        let mut decisions = Decisions { steps: [0, contact.work.iterations], ..Decisions::default() };
        solver.solve(&contact.problem, &stop, &mut (&mut diagnosis, &mut decisions)).ok()?;
        let spectrogram = diagnosis.spectrogram();
        let bands = spectrogram.bands();
        let rows: Vec<&SpectrogramRow> =
            spectrogram.history().columns().iter().filter(|row| !row.displacement.is_empty()).collect();
        let rows: Vec<&SpectrogramRow> = rows.iter().copied().step_by(rows.len().div_ceil(MOST_STEPS).max(1)).collect();
        Some(Self {
            findings: diagnosis.findings(),
            length: contact.problem.surface().grid().size()[1],
            errors: Errors {
                wavelengths: (0..bands.count()).map(|band| bands.wavelengths(band)).collect(),
                steps: rows.iter().map(|row| row.step).collect(),
                rows: rows.iter().map(|row| row.displacement.clone()).collect(),
            },
            decisions,
        })
    }
}

impl Observer for Decisions {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        let (index, level) = (step.index(), step.phase().level);
        if let Some(decision) = step.decision() {
            match self.stretches.last_mut().filter(|it| it.name == decision.name() && it.level == level) {
                Some(stretch) => stretch.steps[1] = index,
                None => self.stretches.push(Stretch { name: decision.name(), level, steps: [index; 2] }),
            }
        }
        self.steps[0] += 1;
        let [done, most] = self.steps;
        Ok(if done > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
