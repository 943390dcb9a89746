//! The observer that records a solve.

use super::recording::{Recording, UNFINISHED};
use super::schedule::{Schedule, Thinning};
use crate::contact::{Contact, Failure, Observer, Phase, Problem, Solver, Step, Stop, Wish, Work};
use crate::record::description;
use crate::record::draw::{
    Fields, Instruments, Readings, SECONDS, STEP, Stage, TRANSFORMS, Traces, level, log_off_scale,
};
use crate::setup::Part;
use rerun::RecordingStreamResult;
use std::ops::ControlFlow;
use std::time::Instant;

/// Records the steps of one scene, as far as the options ask for it: numbers at every step, fields at those that they
/// pick and at the last one of each coarse grid. Of steps on a grid that is no coarser version of the scene's only numbers are recorded.
///
/// A failure to write ends the run.
pub struct Recorder<'r> {
    recording: &'r Recording,
    stage: &'r Stage,
    thinning: Thinning,
    traces: Option<Traces>,
    readings: Option<Readings>,
    phase: Phase,
    /// Whether the solver was seen on a coarse grid or at an inner step; only of such solvers phases are recorded.
    has_phases: bool,
    /// The latest state of a coarse grid, as long as it is not drawn.
    undrawn: Option<(Work, Phase, Fields<'static>)>,
    flushed: Instant,
    /// Rows on the run in the table of parameters.
    run: String,
}

impl Recording {
    /// The observer that records the solve of scene number `scene`.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn recorder(&self, scene: usize) -> Recorder<'_> {
        let stage = &self.stages[scene];
        Recorder {
            recording: self,
            stage,
            thinning: Thinning::new(self.options.every, Schedule::on(&stage.grid)),
            traces: stage.what.has(Part::Traces).then(|| Traces::new(&stage.root, stage.exact)),
            readings: stage.instruments.as_ref().map(Instruments::readings),
            phase: Phase { level: 0, outer: 0, inner: 0 },
            has_phases: false,
            undrawn: None,
            flushed: Instant::now(),
            run: String::new(),
        }
    }
}

impl Recorder<'_> {
    fn log_last(&mut self, contact: &Contact) -> RecordingStreamResult<()> {
        let fields = &Fields::of_contact(contact);
        if let Some(traces) = &mut self.traces {
            traces.observables.add_certificate(contact);
            let kappa = contact.resolved().relative_area / contact.measures().reduced_pressure;
            if kappa > self.stage.most_kappa {
                log_off_scale(&self.recording.stream, &self.stage.root, kappa)?;
            }
        }
        self.log_frame(contact.work, Phase { level: 0, ..self.phase }, fields)?;
        self.stage.picture.settle(&self.recording.stream, self.stage.picture.extent(fields))?;
        let result = Stage::result(contact) + &self.end_readings(contact)?;
        self.log_description(&result)?;
        self.flush_traces()
    }

    /// Ends the instruments, and returns what they found in words.
    fn end_readings(&mut self, contact: &Contact) -> RecordingStreamResult<String> {
        let (Some(readings), Some(instruments)) = (&mut self.readings, &self.stage.instruments) else {
            return Ok(String::new());
        };
        let found = readings.end(&self.recording.stream, instruments, contact)?;
        Ok(format!("\n\n**What held it up**: {}", found.trim_end().replace('\n', "\n\n")))
    }

    fn record(&mut self, step: &Step<'_>) -> RecordingStreamResult<()> {
        let stride = self.stage.grid.stride(step.problem().surface().grid());
        self.phase = Phase { level: stride.map_or(step.phase().level, level), ..step.phase() };
        self.has_phases |= self.phase.level > 0 || self.phase.inner > 0;
        if let Some(traces) = &mut self.traces {
            traces.add(step, self.has_phases.then_some(self.phase));
        }
        if let (Some(readings), Some(instruments)) = (&mut self.readings, &self.stage.instruments) {
            readings.add(&self.recording.stream, instruments, step, self.phase.level)?;
        }
        if let Some(stride) = stride.filter(|_| self.stage.what.has_pictures()) {
            self.draw(step, stride)?;
        }
        Ok(())
    }

    /// Draws a step if it is its turn, and before the first one of a level the last one of the level before.
    fn draw(&mut self, step: &Step<'_>, stride: [usize; 2]) -> RecordingStreamResult<()> {
        if self.thinning.is_new(self.phase.level)
            && let Some((work, phase, fields)) = self.undrawn.take()
        {
            self.log_frame(work, phase, &fields)?;
        }
        if self.thinning.picks(step.index(), self.phase.level) {
            self.undrawn = None;
            self.log_frame(step.work(), self.phase, &Fields::of(step, stride, self.stage.what))?;
        } else if self.phase.level > 0 && self.phase.inner == 0 {
            let fields = Fields::of(step, stride, self.stage.what).into_owned();
            self.undrawn = Some((step.work(), self.phase, fields));
        }
        Ok(())
    }

    fn log_description(&self, result: &str) -> RecordingStreamResult<()> {
        self.recording.stream.log_static(self.stage.description(), &self.stage.described(result, &self.run))
    }

    fn flush_traces(&mut self) -> RecordingStreamResult<()> {
        let stream = &self.recording.stream;
        if let (Some(readings), Some(instruments)) = (&mut self.readings, &self.stage.instruments) {
            readings.flush(stream, instruments)?;
        }
        self.traces.as_mut().map_or(Ok(()), |traces| traces.flush(stream))
    }

    fn log_frame(&self, work: Work, phase: Phase, fields: &Fields<'_>) -> RecordingStreamResult<()> {
        let stream = &self.recording.stream;
        stream.set_time_sequence(STEP, work.iterations as i64);
        stream.set_duration_secs(SECONDS, work.seconds);
        stream.set_time_sequence(TRANSFORMS, work.transforms as i64);
        if self.has_phases && self.stage.what.has_planes() {
            self.stage.log_caption(stream, self.stage.caption(phase, fields.stride))?;
        }
        self.stage.log_frame(stream, fields)
    }
}

impl Observer for Recorder<'_> {
    fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
        if let Some(readings) = &mut self.readings {
            readings.begin(solver, problem, stop)?;
        }
        self.run = description::of_run(solver, stop);
        Ok(self.recording.log(|_| self.log_description(UNFINISHED))?)
    }

    fn step(&mut self, step: &Step<'_>) -> Wish {
        let recording = self.recording;
        recording.log(|_| self.record(step))?;
        if self.flushed.elapsed() >= recording.flush_interval {
            self.flushed = Instant::now();
            recording.log(|_| self.flush_traces())?;
            recording.flush_soon()?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Records the returned state as the last frame and how the run ended, fits the axes to it and flushes. A contact on
    /// another grid than the scene's, of a solver inside the solver, is left out.
    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        if contact.problem.surface().grid() == &self.stage.grid {
            let recording = self.recording;
            recording.write(|_| self.log_last(contact))?;
        }
        Ok(())
    }
}

/// A run that ended without a contact still keeps its numbers.
impl Drop for Recorder<'_> {
    fn drop(&mut self) {
        self.flush_traces().ok();
    }
}
