//! The observer that records a solve.

use super::scene::Fields;
use super::stage::Stage;
use super::thinning::{Pace, Thinning};
use super::traces::{self, Traces};
use super::{Options, Recording};
use crate::contact::{Contact, Observer, Step, Work};
use crate::error::FileError;
use rerun::{RecordingStreamError, RecordingStreamResult};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// What a killed run may lose.
const FLUSH_INTERVAL: Duration = Duration::from_millis(200);

/// Records the steps of one scene: numbers at every step, fields at those that the [`Options`] pick.
///
/// A failure to write does not stop the solver; [`Recorder::close`] reports it.
pub struct Recorder<'r> {
    recording: &'r Recording,
    stage: &'r Stage,
    thinning: Thinning,
    traces: Traces,
    flushed: Instant,
    failure: Option<RecordingStreamError>,
}

impl<'r> Recorder<'r> {
    pub(super) fn new(recording: &'r Recording, stage: &'r Stage, options: &Options) -> Self {
        Self {
            recording,
            stage,
            thinning: Thinning::new(options.every.map_or(stage.picture.pace(), Pace::Every)),
            traces: Traces::new(&stage.root, stage.reference),
            flushed: Instant::now(),
            failure: None,
        }
    }

    /// Records the returned state as the last frame and how the run ended, fits the axes to it and flushes.
    ///
    /// # Errors
    /// [`FileError::Write`] if a step could not be recorded or the file not be written.
    pub fn close(mut self, contact: &Contact) -> Result<(), FileError> {
        let recorded = match self.failure.take() {
            Some(failure) => Err(failure),
            None => self.log_last(contact),
        };
        recorded.map_err(|failure| self.recording.write_error(std::io::Error::other(failure)))?;
        self.recording.flush()
    }

    fn log_last(&mut self, contact: &Contact) -> RecordingStreamResult<()> {
        let (pressure, gap) = (contact.pressure.as_standard_layout(), contact.gap.as_standard_layout());
        let (Some(pressure), Some(gap)) = (pressure.as_slice(), gap.as_slice()) else { return Ok(()) };
        let fields = Fields { pressure, gap };
        self.traces.add_certificate(contact.work, contact.certificate.eta);
        self.log_frame(contact.work, &fields)?;
        self.stage.settle(&self.recording.stream, &fields)?;
        self.stage.log_result(&self.recording.stream, contact)?;
        self.traces.flush(&self.recording.stream)
    }

    fn record(&mut self, step: &Step<'_>) -> RecordingStreamResult<()> {
        self.traces.add(step);
        if self.thinning.picks(step.index()) {
            self.log_frame(step.work(), &Fields { pressure: step.pressure(), gap: step.gap() })?;
        }
        if self.flushed.elapsed() >= FLUSH_INTERVAL {
            self.flushed = Instant::now();
            self.traces.flush(&self.recording.stream)?;
            self.recording.stream.flush_async().ok(); // a failure shows when the recorder is closed
        }
        Ok(())
    }

    fn log_frame(&self, work: Work, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let stream = &self.recording.stream;
        stream.set_time_sequence(traces::STEP, work.iterations as i64);
        stream.set_duration_secs(traces::SECONDS, work.seconds);
        stream.set_time_sequence(traces::TRANSFORMS, work.transforms as i64);
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
            self.traces.flush(&self.recording.stream).ok();
        }
    }
}
