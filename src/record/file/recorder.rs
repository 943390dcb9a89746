//! The observer that records a solve.

use super::recording::Recording;
use super::writer::Writer;
use super::writer_thread::WriterThread;
use crate::contact::{Contact, Failure, Observer, Problem, Solver, Step, Stop, Wish};
use std::ops::ControlFlow;
use std::panic::resume_unwind;

/// Records the steps of one scene with the given options: numbers at every step, fields at selected steps and at the
/// last step of each coarse grid. Of steps on a grid that is no coarser version of the scene's only numbers are
/// recorded.
///
/// The solver continues while a thread writes its states, with a delay of at most a few states. A failure to write ends
/// the run at one of the next steps or at its end.
pub struct Recorder<'r> {
    recording: &'r Recording,
    /// The writer, unless it is with the worker.
    writer: Option<Writer>,
    worker: Option<WriterThread>,
}

impl Recording {
    /// The observer that records the solve of scene number `scene`.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn recorder(&self, scene: usize) -> Recorder<'_> {
        Recorder { recording: self, writer: Some(self.writer(scene)), worker: None }
    }
}

impl Recorder<'_> {
    /// The writer, after it has written everything; none after a panic.
    fn writer(&mut self) -> Option<&mut Writer> {
        if let Some(worker) = self.worker.take() {
            self.writer = Some(worker.end().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        self.writer.as_mut()
    }
}

impl Observer for Recorder<'_> {
    fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
        if let Some(writer) = self.writer() {
            writer.begin(solver, problem, stop);
        }
        Ok(self.recording.check()?)
    }

    fn step(&mut self, step: &Step<'_>) -> Wish {
        self.recording.check()?;
        if let Some(writer) = self.writer.take_if(|writer| writer.sees_every_step()) {
            self.worker = Some(WriterThread::start(writer));
        }
        if !self.worker.as_mut().is_some_and(|worker| worker.step(step)) {
            // the writer is here, or has panicked, which goes on from here
            self.writer().into_iter().for_each(|writer| writer.step(step));
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Records the returned state as the last frame and how the run ended, fits the axes to it and flushes. A contact on
    /// another grid than the scene's, of a solver inside the solver, is left out.
    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        // what is fitted to the end comes after what it replaces
        self.recording.wait_for_statics();
        if let Some(writer) = self.writer() {
            writer.end(contact);
        }
        Ok(self.recording.flush()?)
    }
}

/// A run that ended without a contact keeps its numbers.
impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        let written = self.worker.take().and_then(|worker| worker.end().ok());
        if let Some(mut writer) = written.or(self.writer.take()) {
            writer.leave();
        }
    }
}
