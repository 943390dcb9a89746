//! One session: the orders of the page, and their results.

use super::description::Description;
use super::hand::{HandMemory, Held, Hold};
use super::height_knobs::HeightKnobs;
use super::knobs::Knobs;
use super::listener::Listener;
use super::motion::Motion;
use super::refusal::{KnownFault, Refusal, RefusalRule};
use super::report::{Numbers, Report, SweepReport, sentence_of_failure};
use super::section::Section;
use super::session_recording::{Ended, LastState, RecordingReport, SessionRecording, SolvedRun};
use super::source::{SceneFile, SurfaceSource};
use super::step_numbers::StepNumbers;
use super::tape::{TapeCurves, TapeView};
use crate::contact::Failure;
use crate::formats::HeightFile;
use crate::setup::{Method, Setup};
use std::collections::VecDeque;
use std::ops::RangeInclusive;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Recordings that can still be read, with the contacts behind them: of the largest surface here a contact takes 34 MB, four
/// fields of 1024 x 1024 nodes.
const RECORDINGS: usize = 6;

/// Lengths of a window in points.
const WINDOW: RangeInclusive<f64> = 1.0..=1e5;

/// A file of heights, and its last description for the page.
pub(crate) type Heights = (HeightFile, Description);

/// What a session begins with, if there is any: a file of heights, and a scene.
#[derive(Clone, Default)]
pub struct Stock {
    /// A file of heights with its description.
    pub heights: Option<Heights>,
    /// A scene.
    pub scene: Option<Arc<SceneFile>>,
    /// The interval of steps at which fields are recorded (not for GFMD, which needs many steps); if it is left out, as
    /// in every recording.
    pub every: Option<usize>,
    /// Who hears of the session while it solves.
    pub listener: Option<Listener>,
}

/// The orders of the page, one at a time, and their results; a new order ends the previous one.
pub struct Session {
    state: Mutex<SessionState>,
    /// What the hand has left, of which there is one at a time.
    hand: Mutex<HandMemory>,
    changed: Condvar,
    listener: Option<Listener>,
}

#[derive(Default)]
struct SessionState {
    report: Report,
    /// Grows with every order and ends those before.
    generation: u64,
    order: Option<Order>,
    running: bool,
    closed: bool,
    /// The latest recordings, the newest last.
    recordings: VecDeque<SessionRecording>,
    heights: Option<Heights>,
    scene: Option<Arc<SceneFile>>,
    every: Option<usize>,
    /// Width and height of the viewer on the page in points, if the page has sent them.
    window: Option<[f64; 2]>,
}

impl SessionState {
    /// Keeps a recording, and drops the oldest one that is not pinned.
    fn keep(&mut self, recording: SessionRecording) {
        self.recordings.push_back(recording);
        if self.recordings.len() > RECORDINGS {
            let is_free = |recording: &SessionRecording| Some(&recording.id) != self.report.pinned.as_ref();
            self.recordings.iter().position(is_free).map(|place| self.recordings.remove(place));
        }
    }

    fn recording(&self, id: &str) -> Option<&SessionRecording> {
        self.recordings.iter().find(|recording| recording.id == id)
    }

    /// Stores the result of a recording.
    fn end(&mut self, id: &str, ended: Ended) {
        let recording = self.recordings.iter_mut().find(|recording| recording.id == id);
        recording.into_iter().for_each(|recording| recording.ended = Some(ended.clone()));
    }

    /// The curves of the recording that is pinned.
    fn pinned_curves(&self) -> Option<Arc<TapeCurves>> {
        Some(Arc::clone(&self.recording(self.report.pinned.as_ref()?)?.solved()?.curves))
    }
}

/// An order of the page: what to do with the knobs and the setup that they describe.
pub(crate) struct Order {
    pub kind: RunKind,
    pub knobs: Knobs,
    pub setup: Setup,
    /// The surface that is pressed beside, if there is one.
    pub beside: Option<Setup>,
}

/// What is done with a setup.
#[derive(Clone, Copy, PartialEq)]
pub enum RunKind {
    /// One solve.
    Solve,
    /// Solves from first touch to full contact.
    Sweep,
}

/// The right to work until the next order.
#[derive(Clone, Copy)]
pub(crate) struct Turn<'a> {
    session: &'a Session,
    /// The number of the order, which names what comes of it.
    pub number: u64,
}

impl Session {
    /// A session with what it begins with, whose orders are numbered on from `after`.
    pub fn new(Stock { heights, scene, every, listener }: Stock, after: u64) -> Self {
        let state = SessionState { heights, scene, every, generation: after, ..SessionState::default() };
        Self { state: Mutex::new(state), hand: Mutex::default(), changed: Condvar::new(), listener }
    }

    /// Takes an order, and ends what runs. Returns the revision from which on the report speaks of it. Invalid knobs
    /// are refused; a running solve then continues.
    ///
    /// # Errors
    /// A refusal for knobs that describe no contact.
    pub fn order(&self, kind: RunKind, knobs: Knobs) -> Result<u64, Refusal> {
        let source = self.source_of(&knobs)?;
        let (mut setup, beside) = (knobs.setup_with(source.as_ref())?, knobs.beside_with(source.as_ref())?);
        if let (RunKind::Sweep, Some(drive)) = (kind, setup.history_drive()?) {
            return Err(RefusalRule::SweepOfHistory.with([("drive", drive.given.name)]));
        }
        Ok(self.change(|state| {
            setup.record.every = state.every.filter(|_| !matches!(setup.solver, Method::Gfmd(_)));
            state.generation += 1;
            state.order = Some(Order { kind, knobs, setup, beside });
            state.report.busy = true;
            state.report.fault = None;
            state.report.known_fault = None;
        }))
    }

    /// Notes width and height of the viewer on the page, for whose panes the next recordings are drawn.
    ///
    /// # Errors
    /// For lengths that no window has.
    pub(super) fn set_window(&self, size: [f64; 2]) -> Result<(), Refusal> {
        if !size.iter().all(|length| WINDOW.contains(length)) {
            let [width, height] = size;
            let given = [("width", width.to_string()), ("height", height.to_string())];
            return Err(RefusalRule::ViewerSize.with(given));
        }
        self.lock().window = Some(size);
        Ok(())
    }

    /// The file of heights, or the scene, that knobs are for, if it is here.
    fn source_of(&self, knobs: &Knobs) -> Result<Option<SurfaceSource>, Refusal> {
        let state = self.lock();
        if knobs.takes_scene() {
            return Ok(state.scene.clone().map(SurfaceSource::Scene));
        }
        if let Some((_, description)) = state.heights.as_ref().filter(|_| knobs.takes_file()) {
            description.check(&knobs.heights)?;
        }
        Ok(state.heights.as_ref().map(|(file, _)| SurfaceSource::Heights(file.clone())))
    }

    /// Solves the contact that is dragged, while a running solve continues.
    pub(super) fn hold(&self, hold: &Hold) -> Result<Held, Refusal> {
        let source = self.source_of(hold.knobs())?;
        hold.solve(source.as_ref(), &mut self.hand.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Replaces the file of heights, and describes it with the preparation steps that it needs.
    ///
    /// # Errors
    /// For a file that cannot be read; the one before is then kept.
    pub(super) fn open(&self, file: HeightFile) -> Result<Description, Refusal> {
        self.describe_as(file, HeightKnobs::default())
    }

    /// Describes the file of heights as other knobs take it.
    pub(super) fn describe(&self, knobs: HeightKnobs) -> Result<Description, Refusal> {
        let (file, description) = self.lock().heights.clone().ok_or(RefusalRule::NoHeightsToDescribe)?;
        description.check(&knobs)?;
        knobs.check()?;
        self.describe_as(file, knobs)
    }

    fn describe_as(&self, file: HeightFile, knobs: HeightKnobs) -> Result<Description, Refusal> {
        let description = Description::new(&file, knobs)?;
        self.lock().heights = Some((file, description.clone()));
        Ok(description)
    }

    /// The last description of the file of heights for the page, if there is a file.
    pub(super) fn description(&self) -> Option<Description> {
        self.lock().heights.as_ref().map(|(_, description)| description.clone())
    }

    /// Ends what runs; its latest state stays.
    pub(super) fn cancel(&self) -> u64 {
        self.change(|state| {
            state.generation += 1;
            state.order = None;
            state.report.busy = state.running;
        })
    }

    /// Ends what runs and the solver thread.
    pub fn close(&self) {
        self.change(|state| {
            state.generation += 1;
            state.closed = true;
        });
    }

    /// The report.
    pub fn report(&self) -> Report {
        self.lock().report.clone()
    }

    /// The report, as soon as it is newer than `revision`, or after `patience`. It blocks the thread.
    pub fn report_after(&self, revision: u64, patience: Duration) -> Report {
        let is_old = |state: &mut SessionState| state.report.revision <= revision && !state.closed;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, is_old);
        waited.unwrap_or_else(PoisonError::into_inner).0.report.clone()
    }

    /// Has the curves of the recording of that name, if it can still be read, stand beside those of new ones, or of none.
    pub(super) fn pin(&self, name: Option<String>) -> Result<u64, Refusal> {
        if let Some(name) = name.as_ref().filter(|name| self.recording(name).is_none()) {
            let given = [("name", format!("{name:?}")), ("most", RECORDINGS.to_string())];
            return Err(RefusalRule::NoRecordingToPin.with(given));
        }
        Ok(self.change(|state| state.report.pinned = name))
    }

    /// The recording of that name, if it is one of the latest.
    pub(crate) fn recording(&self, name: &str) -> Option<SessionRecording> {
        self.lock().recording(name).cloned()
    }

    /// Reports of the latest complete recordings, oldest first.
    pub(super) fn reports(&self) -> Vec<RecordingReport> {
        self.lock().recordings.iter().filter_map(SessionRecording::report).collect()
    }

    /// Waits for an order; none when the session is closed.
    pub(super) fn next(&self) -> Option<(Turn<'_>, Order)> {
        let is_idle = |state: &mut SessionState| state.order.is_none() && !state.closed;
        let waited = self.changed.wait_while(self.lock(), is_idle);
        self.begin_turn(waited.unwrap_or_else(PoisonError::into_inner))
    }

    /// The order that waits, if there is one.
    pub(super) fn take_order(&self) -> Option<(Turn<'_>, Order)> {
        self.begin_turn(self.lock())
    }

    fn begin_turn<'s>(&'s self, mut state: MutexGuard<'s, SessionState>) -> Option<(Turn<'s>, Order)> {
        let order = state.order.take().filter(|_| !state.closed)?;
        state.running = true;
        Some((Turn { session: self, number: state.generation }, order))
    }

    fn lock(&self) -> MutexGuard<'_, SessionState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the state under a new revision, and returns that.
    fn change(&self, change: impl FnOnce(&mut SessionState)) -> u64 {
        let mut state = self.lock();
        change(&mut state);
        state.report.revision += 1;
        self.changed.notify_all();
        if let Some(listener) = self.listener {
            (listener.report)(&state.report);
        }
        state.report.revision
    }
}

impl Turn<'_> {
    /// Whether there was no order since.
    pub(crate) fn goes_on(self) -> bool {
        self.session.listener.is_none_or(|listener| (listener.goes_on)())
            && self.session.lock().generation == self.number
    }

    /// How a recording is drawn: for the viewer on the page, and with the curves of the run that is pinned.
    pub(crate) fn view(self) -> TapeView {
        let state = self.session.lock();
        (state.window, state.pinned_curves())
    }

    pub(crate) fn keep(self, recording: SessionRecording) {
        self.session.change(|state| state.keep(recording));
    }

    pub(crate) fn update_report(self, news: impl FnOnce(&mut Report)) {
        self.session.change(|state| news(&mut state.report));
    }

    /// Reports the numbers of the latest state of a run, and its section.
    pub(crate) fn update_run(self, numbers: Numbers, section: Section) {
        self.update_report(|news| {
            if let Some(run) = &mut news.run {
                (run.numbers, run.section) = (Some(numbers), Some(section));
            }
        });
    }

    /// Keeps the result of a solve, that of the surface beside, the curves of the recording, and numbers and sections of
    /// the steps, and reports it.
    pub(crate) fn finish(
        self,
        rank: usize,
        last: LastState,
        beside: Option<LastState>,
        curves: TapeCurves,
        (steps, motion): (StepNumbers, Motion),
    ) {
        let numbers = Numbers::from_contact(&last.contact);
        let numbers_beside = beside.as_ref().map(|it| Numbers::from_contact(&it.contact));
        self.session.change(|state| {
            let Some(run) = &mut state.report.run else { return };
            run.ended = true;
            run.numbers = Some(numbers);
            run.section = None;
            run.beside.iter_mut().for_each(|it| it.numbers = numbers_beside.clone());
            let report = run.clone();
            let id = report.id.clone();
            let curves = Arc::new(curves);
            state.end(&id, Ended::Run(Arc::new(SolvedRun { report, rank, last, beside, curves, steps, motion })));
        });
    }

    /// Keeps the points of a sweep and the sections of its loads, and reports it.
    pub(crate) fn finish_sweep(self, report: SweepReport, motion: Motion) {
        self.session.change(|state| {
            state.end(&report.id, Ended::Sweep(Arc::new(report.clone()), Arc::new(motion)));
            state.report.sweep = Some(report);
        });
    }

    /// Ends the turn; a failure is reported unless another order has come.
    pub(crate) fn end(self, failure: Option<Failure>) {
        self.session.change(|state| {
            let failure = failure.filter(|_| state.generation == self.number);
            state.report.known_fault = failure.as_ref().and_then(KnownFault::from_failure);
            state.report.fault = failure.as_ref().map(sentence_of_failure);
            state.running = false;
            state.report.busy = state.order.is_some();
        });
    }
}
