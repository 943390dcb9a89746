//! The observer that records a solve.

use super::part::Part;
use super::scene::{Fields, with_fields};
use super::snapshot::{Moment, Snapshot};
use super::stage::{self, Stage};
use super::thinning::{Pace, Thinning};
use super::traces::{self, Traces};
use super::{Options, Recording};
use crate::contact::{Contact, Observer, Phase, Step};
use crate::error::FileError;
use rerun::{RecordingStreamError, RecordingStreamResult};
use std::ops::ControlFlow;
use std::time::Instant;

/// Records the steps of one scene, as far as the [`Options`] ask for it: numbers at every step, fields at those that they
/// pick and at the last one of each coarse grid. Of steps on a grid that is no coarser version of the scene's only numbers are recorded.
///
/// A failure to write does not stop the solver; [`Recorder::close`] reports it.
pub struct Recorder<'r> {
    recording: &'r Recording,
    stage: &'r Stage,
    thinning: Thinning,
    traces: Option<Traces>,
    phase: Phase,
    /// Whether the solver was seen on a coarse grid or at an inner step; only of such solvers phases are recorded.
    has_phases: bool,
    /// The latest state of a coarse grid, as long as it is not drawn.
    undrawn: Option<Snapshot>,
    flushed: Instant,
    failure: Option<RecordingStreamError>,
}

impl<'r> Recorder<'r> {
    pub(super) fn new(recording: &'r Recording, stage: &'r Stage, options: &Options) -> Self {
        Self {
            recording,
            stage,
            thinning: Thinning::new(options.every.map_or(stage.pace(), Pace::Every)),
            traces: stage.what.has(Part::Traces).then(|| Traces::new(&stage.root, stage.reference)),
            phase: Phase { level: 0, outer: 0, inner: 0 },
            has_phases: false,
            undrawn: None,
            flushed: Instant::now(),
            failure: None,
        }
    }

    /// Records the returned state as the last frame and how the run ended, fits the axes to it and flushes.
    ///
    /// # Errors
    /// [`FileError::Write`] if a step could not be recorded or the file not be written.
    pub fn close(mut self, contact: &Contact) -> Result<(), FileError> {
        let failure = self.failure.take();
        let recording = self.recording;
        recording.write(|_| failure.map_or_else(|| with_fields(contact, |fields| self.log_last(contact, fields)), Err))
    }

    fn log_last(&mut self, contact: &Contact, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        if let Some(traces) = &mut self.traces {
            traces.add_certificate(contact.work, contact.certificate.eta);
        }
        self.log_frame(Moment { work: contact.work, phase: Phase { level: 0, ..self.phase } }, fields)?;
        self.stage.settle(&self.recording.stream, self.stage.extent(fields))?;
        self.recording.stream.log_static(self.stage.description(), &self.stage.result(contact))?;
        self.flush_traces()
    }

    fn record(&mut self, step: &Step<'_>) -> RecordingStreamResult<()> {
        let stride = self.stage.stride(step.problem().surface().grid());
        self.phase = Phase { level: stride.map_or(step.phase().level, stage::level), ..step.phase() };
        self.has_phases |= self.phase.level > 0 || self.phase.inner > 0;
        if let Some(traces) = &mut self.traces {
            traces.add(step, self.has_phases.then_some(self.phase));
        }
        if let Some(stride) = stride.filter(|_| self.stage.what.has_pictures()) {
            self.draw(step, stride)?;
        }
        if self.flushed.elapsed() >= self.recording.flush_interval {
            self.flushed = Instant::now();
            self.flush_traces()?;
            self.recording.stream.flush_async().ok(); // a failure shows when the recorder is closed
        }
        Ok(())
    }

    /// Draws a step if it is its turn, and before the first one of a level the last one of the level before.
    fn draw(&mut self, step: &Step<'_>, stride: [usize; 2]) -> RecordingStreamResult<()> {
        let moment = Moment { work: step.work(), phase: self.phase };
        if self.thinning.is_new(self.phase.level)
            && let Some(last) = self.undrawn.take()
        {
            self.log_frame(last.moment, &last.fields())?;
        }
        if self.thinning.picks(step.index(), self.phase.level) {
            self.undrawn = None;
            self.log_frame(moment, &Fields::of(step, stride, self.stage.what))?;
        } else if self.phase.level > 0 && self.phase.inner == 0 {
            self.undrawn = Some(Snapshot::of(step, moment, stride, self.stage.what));
        }
        Ok(())
    }

    fn flush_traces(&mut self) -> RecordingStreamResult<()> {
        self.traces.as_mut().map_or(Ok(()), |traces| traces.flush(&self.recording.stream))
    }

    fn log_frame(&self, moment: Moment, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let stream = &self.recording.stream;
        stream.set_time_sequence(traces::STEP, moment.work.iterations as i64);
        stream.set_duration_secs(traces::SECONDS, moment.work.seconds);
        stream.set_time_sequence(traces::TRANSFORMS, moment.work.transforms as i64);
        if self.has_phases && self.stage.what.has_planes() {
            self.stage.log_caption(stream, self.stage.caption(moment.phase, fields.stride))?;
        }
        self.stage.log_frame(stream, fields)
    }
}

impl Observer for Recorder<'_> {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        if self.failure.is_none() {
            self.failure = self.record(step).err();
        }
        ControlFlow::Continue(())
    }
}

/// A run that ended without a contact still keeps its numbers.
impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        if self.failure.is_none() {
            self.flush_traces().ok();
        }
    }
}
