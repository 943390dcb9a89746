//! What the drawings of a scene collect in one run.

use super::drawing::{RunDrawing, RunStep};
use super::stage::Stage;
use crate::contact::{Contact, Observer, Phase, Problem, Solver, Step, Stop};
use crate::diagnosis::{ContactHistory, Diagnosis, Findings};
use rerun::{RecordingStream, RecordingStreamResult};

/// Images of a run are recorded anew whenever the number of steps has grown by this factor.
const GROWTH: usize = 2;
/// Steps after which they are recorded first.
const FIRST: usize = 16;

/// One run of a scene, seen by its drawings.
pub(crate) struct DrawnRun {
    drawings: Vec<Box<dyn RunDrawing>>,
    /// The diagnosis of the run, if an instrument is recorded.
    diagnosis: Option<Diagnosis>,
    steps: usize,
    /// Steps at which images are recorded next.
    shown: usize,
}

impl DrawnRun {
    /// A run of a scene, before its first step.
    pub(crate) fn new(stage: &Stage) -> Self {
        Self { drawings: stage.runs().collect(), diagnosis: stage.diagnosis(), steps: 0, shown: FIRST }
    }

    /// Whether anything is recorded of every step, not only of frames.
    pub(crate) fn sees_every_step(&self) -> bool {
        !self.drawings.is_empty()
    }

    /// Begins with what the solver says of itself.
    pub(crate) fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) {
        if let Some(diagnosis) = &mut self.diagnosis {
            diagnosis.begin(solver, problem, stop).ok(); // it does not fail
        }
    }

    /// Adds a step on a grid level, in a phase if its solver has any.
    pub(crate) fn add(
        &mut self,
        to: &RecordingStream,
        step: &Step<'_>,
        level: usize,
        phase: Option<Phase>,
    ) -> RecordingStreamResult<()> {
        if let Some(diagnosis) = &mut self.diagnosis {
            diagnosis.step(step).ok(); // it neither fails nor ends a run
        }
        let seen = RunStep { step, phase, level, diagnosis: self.diagnosis.as_ref() };
        self.drawings.iter_mut().for_each(|drawing| drawing.add(&seen));
        self.steps += 1;
        if self.steps < self.shown {
            return Ok(());
        }
        self.shown *= GROWTH;
        self.show(to)
    }

    /// The contact so far, if it is watched.
    pub(crate) fn contact(&self) -> Option<&ContactHistory> {
        self.diagnosis.as_ref().map(Diagnosis::contact)
    }

    /// Records the images of the steps so far.
    fn show(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let Some(diagnosis) = &self.diagnosis else { return Ok(()) };
        self.drawings.iter_mut().try_for_each(|drawing| drawing.show(to, diagnosis))
    }

    /// Sends the numbers that wait.
    pub(crate) fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.drawings.iter_mut().try_for_each(|drawing| drawing.flush(to))
    }

    /// Ends with the resulting contact, and returns why the run was slow, if there is a diagnosis.
    pub(crate) fn end(&mut self, to: &RecordingStream, contact: &Contact) -> RecordingStreamResult<Option<Findings>> {
        if let Some(diagnosis) = &mut self.diagnosis {
            diagnosis.end(contact).ok(); // it does not fail
        }
        self.drawings.iter_mut().for_each(|drawing| drawing.end(contact));
        self.show(to)?;
        self.flush(to)?;
        Ok(self.diagnosis.as_ref().map(Diagnosis::findings))
    }
}
