//! The writer of a solve, step by step.

use super::background_task::BackgroundTask;
use super::output::Output;
use super::pace::Waiting;
use super::schedule::{Schedule, Thinning};
use crate::contact::{Contact, Phase, Problem, Reading, Solver, Step, Stop, Work};
use crate::record::description;
use crate::record::draw::{DrawnRun, FieldExtent, FrameFields, SECONDS, STEP, Stage, TRANSFORMS, level};
use crate::record::layout;
use crate::record::properties;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};
use std::io;
use std::sync::Arc;

/// The result of a run before it begins, until there is one, and where it ended without one.
pub(crate) const NOT_BEGUN: &str = "not begun";
const UNFINISHED: &str = "still running, or killed";
const WITHOUT_RESULT: &str = "ended without a result";

/// The end of an axis of a running solve, divided by the highest pressure: when the axis is fitted, and its largest
/// value later.
const ROOM: f64 = 2.0;
const LOWEST: f64 = 4.0;
/// The highest pressure of a frame over that of the frame before from which on it grows.
const GROWING: f64 = 1.05;

/// Writes the solve of one scene with the given options: numbers at every step, fields at selected steps and at the
/// last step of each coarse grid. Of steps on a grid that is no coarser version of the scene's only numbers are
/// written.
///
/// After a failure, which the output stores, nothing more is written.
pub(crate) struct Writer {
    stream: RecordingStream,
    output: Output,
    stages: Arc<[Stage]>,
    /// The number of the scene.
    scene: usize,
    thinning: Thinning,
    steps: DrawnRun,
    phase: Phase,
    /// Whether the solver was seen on a coarse grid or at an inner step; only of such solvers phases are written.
    has_phases: bool,
    /// The latest state of a coarse grid, as long as it is not drawn.
    undrawn: Option<(Work, Phase, FrameFields<'static>)>,
    waiting: Waiting,
    /// What replaces the axes of the beginning must come after them.
    statics: Arc<BackgroundTask>,
    /// The highest pressure that the axes are fitted to, and that of the last frame.
    axis_end: f64,
    highest: f64,
    /// Rows on the run in the table of parameters.
    run: String,
    /// Whether it has begun and has no result yet.
    is_open: bool,
}

impl Writer {
    /// Writes into `stream` and its `output` what comes of scene number `scene` of `stages`: fields of each n-th step if
    /// `every` is given.
    pub(crate) fn new(
        stream: RecordingStream,
        output: Output,
        stages: Arc<[Stage]>,
        scene: usize,
        statics: Arc<BackgroundTask>,
        every: Option<usize>,
    ) -> Self {
        let stage = &stages[scene];
        Self {
            thinning: Thinning::new(every, Schedule::on(&stage.grid)),
            steps: DrawnRun::new(stage),
            phase: Phase { level: 0, outer: 0, inner: 0 },
            has_phases: false,
            undrawn: None,
            waiting: Waiting::new(output.pace()),
            statics,
            axis_end: stage.highest_pressure,
            highest: 0.0,
            run: String::new(),
            is_open: false,
            stream,
            output,
            stages,
            scene,
        }
    }

    /// Writes the name of the solver.
    pub(crate) fn begin(&mut self, solver: &dyn Solver, problem: &Problem, stop: &Stop) {
        self.run = description::of_run(solver, stop);
        self.is_open = true;
        self.steps.begin(solver, problem, stop);
        let properties = properties::of_run(solver, stop);
        self.attempt(|writer| {
            properties::send(&writer.stream, &writer.stage().root, &properties)?;
            writer.log_description(UNFINISHED)
        });
    }

    /// Writes a step; it reaches the file at the pace of the output.
    pub(crate) fn step(&mut self, step: &Step<'_>) {
        self.attempt(|writer| writer.record(step));
        if self.waiting.add(step.problem().surface().grid().len()) {
            self.flush_traces();
            self.stream.flush_async().ok(); // a failure shows at the next flush
        }
    }

    /// Writes the returned state as the last frame and how the run ended, and fits the axes to it. A contact on another grid than
    /// the scene's, of a solver inside the solver, is left out.
    pub(crate) fn end(&mut self, contact: &Contact) {
        if contact.problem.surface().grid() == &self.stage().grid {
            self.attempt(|writer| writer.log_last(contact));
        }
    }

    /// Sends the numbers that wait at the end of a run, and says that it has no result if there is none.
    pub(crate) fn leave(&mut self) {
        self.flush_traces();
        if self.is_open {
            self.attempt(|writer| writer.log_description(WITHOUT_RESULT));
        }
    }

    /// Sends the numbers that wait.
    fn flush_traces(&mut self) {
        self.attempt(|writer| writer.steps.flush(&writer.stream));
    }

    /// Whether it writes something of every step, not only of those that it draws.
    pub(crate) fn sees_every_step(&self) -> bool {
        self.steps.sees_every_step()
    }

    /// Nodes of the finest grid.
    pub(crate) fn nodes(&self) -> usize {
        self.stage().grid.len()
    }

    /// Writes by `log`, unless there was a failure before.
    fn attempt(&mut self, log: impl FnOnce(&mut Self) -> RecordingStreamResult<()>) {
        if self.output.check().is_ok()
            && let Err(failure) = log(self)
        {
            self.output.fail(io::Error::other(failure));
        }
    }

    fn stage(&self) -> &Stage {
        &self.stages[self.scene]
    }

    fn log_last(&mut self, contact: &Contact) -> RecordingStreamResult<()> {
        let (fields, reading) = (&FrameFields::from_contact(contact), &Reading::from(contact));
        if self.stage().what.has(Part::Traces) && self.stage().fit_curves(reading) {
            layout::send_steps(&self.stages, &self.stream)?;
        }
        self.log_frame(contact.work, Phase { level: 0, ..self.phase }, fields)?;
        self.stage().log_contact(&self.stream, contact)?;
        self.stage().settle(&self.stream, &self.stage().extent(fields).touching())?;
        let found = self.steps.end(&self.stream, contact)?.map_or_else(String::new, |found| {
            let words = found.to_string();
            format!("\n\n**Why it was slow**: {}\n\n{}", words.trim_end().replace('\n', "\n\n"), found.table())
        });
        self.log_description(&(Stage::result(contact, reading) + &found))?;
        self.is_open = false;
        properties::send(&self.stream, &self.stage().root, &properties::of_contact(contact, reading))
    }

    fn record(&mut self, step: &Step<'_>) -> RecordingStreamResult<()> {
        let stride = self.stage().grid.stride(step.problem().surface().grid());
        self.phase = Phase { level: stride.map_or(step.phase().level, level), ..step.phase() };
        self.has_phases |= self.phase.level > 0 || self.phase.inner > 0;
        self.steps.add(&self.stream, step, self.phase.level, self.has_phases.then_some(self.phase))?;
        if let Some(stride) = stride.filter(|_| self.stage().what.has_pictures()) {
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
            self.log_frame(step.work(), self.phase, &self.fields(step, stride))?;
        } else if self.phase.level > 0 && self.phase.inner == 0 {
            let fields = self.fields(step, stride).into_owned();
            self.undrawn = Some((step.work(), self.phase, fields));
        }
        Ok(())
    }

    /// The fields of a step, with the past of its patches if that is watched.
    fn fields<'a>(&self, step: &'a Step<'_>, stride: [usize; 2]) -> FrameFields<'a> {
        let fields = FrameFields::from_step(step, stride, self.stage().what);
        match self.steps.contact() {
            Some(contact) => fields.with_past(contact),
            None => fields,
        }
    }

    /// Fits the axes to a state whose pressure they cut off, or which they show too low once the pressure no longer grows, so that a
    /// run can be followed whose end is far from its forecast.
    fn fit_axes(&mut self, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        let highest = fields.pressure.iter().copied().fold(0.0, f64::max);
        let is_cut_off = highest > self.axis_end;
        let is_low = highest > 0.0 && self.axis_end > LOWEST * highest && highest <= GROWING * self.highest;
        self.highest = highest;
        if is_cut_off || is_low {
            self.axis_end = ROOM * highest;
            self.statics.wait();
            let extent = self.stage().extent(fields).touching();
            self.stage().settle(&self.stream, &FieldExtent { pressure: self.axis_end, ..extent })?;
        }
        Ok(())
    }

    fn log_description(&self, result: &str) -> RecordingStreamResult<()> {
        let stage = self.stage();
        self.stream.log_static(stage.description(), &stage.described(result, &self.run))
    }

    fn log_frame(&mut self, work: Work, phase: Phase, fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        if phase.level == 0 {
            self.fit_axes(fields)?;
        }
        let (stream, stage) = (&self.stream, self.stage());
        stream.set_time_sequence(STEP, work.iterations as i64);
        stream.set_duration_secs(SECONDS, work.seconds);
        stream.set_time_sequence(TRANSFORMS, work.transforms as i64);
        if self.has_phases && stage.what.has_planes() {
            stage.log_caption(stream, &stage.caption(phase, fields.stride))?;
        }
        stage.log_frame(stream, fields)
    }
}
