//! One solver thread, and all of its state in one place.

use super::parameters::{Parameters, Refusal};
use super::report::{Numbers, Report, Run, Sweep, Values};
use super::sweep;
use crate::contact::{Contact, Observer, Problem, Step, archive};
use crate::error::{FileError, SolveError};
use crate::record::{Ghost, Live, Options, Recording, Scene, describe};
use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Recordings that can still be read: those that a page asked for a moment ago.
const RECORDINGS: usize = 6;

/// How often a running solve reports.
const INTERVAL: Duration = Duration::from_millis(60);

/// What is solved, one order at a time; a new one ends what runs.
pub struct Session {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    report: Report,
    /// Grows with every order and ends those before.
    generation: u64,
    order: Option<Order>,
    running: bool,
    closed: bool,
    /// The latest recordings, the newest last.
    recordings: VecDeque<Kept>,
    solved: Option<Arc<Solved>>,
}

/// A recording that can still be read.
struct Kept {
    id: String,
    live: Live,
    /// Its curves, once it is complete.
    curves: Option<Arc<Ghost>>,
}

impl State {
    /// Keeps a recording, and drops the oldest one that is not pinned.
    fn keep(&mut self, id: String, live: Live) {
        self.recordings.push_back(Kept { id, live, curves: None });
        if self.recordings.len() > RECORDINGS {
            let is_free = |kept: &Kept| Some(&kept.id) != self.report.pinned.as_ref();
            self.recordings.iter().position(is_free).map(|place| self.recordings.remove(place));
        }
    }

    fn kept(&mut self, id: &str) -> Option<&mut Kept> {
        self.recordings.iter_mut().find(|kept| kept.id == id)
    }

    /// The curves of the recording that is pinned.
    fn ghost(&mut self) -> Option<Arc<Ghost>> {
        let pinned = self.report.pinned.clone()?;
        self.kept(&pinned)?.curves.clone()
    }
}

/// Something to do.
#[derive(Debug, Clone)]
pub enum Order {
    /// Solve and record.
    Solve(Parameters),
    /// Solve from first touch to full contact.
    Sweep(Parameters),
}

/// The latest result.
struct Solved {
    id: String,
    problem: Problem,
    contact: Contact,
    rank: usize,
}

/// Why an order was not carried out.
#[derive(Debug, thiserror::Error)]
pub(super) enum Fault {
    #[error(transparent)]
    Refusal(#[from] Refusal),
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    File(#[from] FileError),
}

/// The right to work until the next order.
#[derive(Clone, Copy)]
pub(super) struct Turn<'a> {
    session: &'a Session,
    generation: u64,
}

impl Session {
    /// A session with its solver thread, which ends after [`Session::close`].
    pub fn start() -> (Arc<Self>, JoinHandle<()>) {
        let session = Arc::new(Self { state: Mutex::default(), changed: Condvar::new() });
        let worker = Arc::clone(&session);
        (session, std::thread::spawn(move || worker.work()))
    }

    /// Takes an order, and ends what runs. Returns the revision from which on the report speaks of it.
    ///
    /// # Errors
    /// A sentence on parameters that cannot be; what runs then goes on.
    pub fn order(&self, order: Order) -> Result<u64, Refusal> {
        let (Order::Solve(parameters) | Order::Sweep(parameters)) = &order;
        parameters.check()?;
        Ok(self.change(|state| {
            state.generation += 1;
            state.order = Some(order);
            state.report.busy = true;
            state.report.fault = None;
        }))
    }

    /// Ends what runs; its latest state stays.
    pub fn cancel(&self) -> u64 {
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

    /// The report, as soon as it is newer than `revision`, or after `patience`.
    pub fn report(&self, revision: u64, patience: Duration) -> Report {
        let is_old = |state: &mut State| state.report.revision <= revision && !state.closed;
        let waited = self.changed.wait_timeout_while(self.lock(), patience, is_old);
        waited.unwrap_or_else(PoisonError::into_inner).0.report.clone()
    }

    /// Has the curves of the recording of that name stand beside those of new ones, or of none.
    ///
    /// # Errors
    /// If there is no such recording any more.
    pub fn pin(&self, name: Option<String>) -> Result<u64, Refusal> {
        if let Some(name) = name.as_ref().filter(|name| self.recording(name).is_none()) {
            return Err(Refusal(format!(
                "there is no recording {name:?} to pin: choose one of the latest {RECORDINGS}"
            )));
        }
        Ok(self.change(|state| state.report.pinned = name))
    }

    /// The latest recording and its name.
    pub fn latest(&self) -> Option<(String, Live)> {
        self.lock().recordings.back().map(|kept| (kept.id.clone(), kept.live.clone()))
    }

    /// The recording of that name, if it is one of the latest.
    pub fn recording(&self, name: &str) -> Option<Live> {
        self.lock().kept(name).map(|kept| kept.live.clone())
    }

    /// The arrays of the latest result as `.npz`, and its name; none before there is one.
    pub fn archive(&self) -> Option<(String, Vec<u8>)> {
        let solved = self.lock().solved.clone()?;
        Some((solved.id.clone(), archive(&solved.problem, &solved.contact, solved.rank).ok()?))
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the state under a new revision, and returns that.
    fn change(&self, change: impl FnOnce(&mut State)) -> u64 {
        let mut state = self.lock();
        change(&mut state);
        state.report.revision += 1;
        self.changed.notify_all();
        state.report.revision
    }

    fn work(&self) {
        while let Some((generation, order)) = self.next() {
            let turn = Turn { session: self, generation };
            let done = catch_unwind(AssertUnwindSafe(|| match order {
                Order::Solve(parameters) => self.solve(turn, &parameters),
                Order::Sweep(parameters) => sweep::run(turn, &parameters),
            }));
            let fault = match done {
                Ok(done) => done.err().map(|fault| fault.to_string()),
                Err(_) => Some("the solver failed on these settings: please report them".into()),
            };
            self.change(|state| {
                state.report.fault = fault.filter(|_| state.generation == generation);
                state.running = false;
                state.report.busy = state.order.is_some();
            });
        }
    }

    /// Waits for an order; none when the session is closed.
    fn next(&self) -> Option<(u64, Order)> {
        let is_idle = |state: &mut State| state.order.is_none() && !state.closed;
        let waited = self.changed.wait_while(self.lock(), is_idle);
        let mut state = waited.unwrap_or_else(PoisonError::into_inner);
        let order = state.order.take().filter(|_| !state.closed)?;
        state.running = true;
        Some((state.generation, order))
    }

    fn solve(&self, turn: Turn<'_>, parameters: &Parameters) -> Result<(), Fault> {
        let problem = parameters.problem()?;
        let (solver, stop) = (parameters.solver()?, parameters.stop()?);
        let exact = parameters.exact(&problem);
        let (id, title) = (format!("run-{}", turn.number()), parameters.title());
        let values = exact.as_ref().map(Values::of);
        let scene = Scene {
            name: "contact".into(),
            title: title.clone(),
            problem: &problem,
            description: describe(&parameters.description(), &problem, "m", solver.as_ref(), &stop, exact.as_ref()),
            exact,
        };
        let options = Options { what: parameters.parts(), ghost: self.lock().ghost(), ..Options::default() };
        let (recording, live) = Recording::live(&id, &[scene], options)?;
        let run = Run {
            id: id.clone(),
            title,
            command: parameters.command(),
            parameters: parameters.clone(),
            ended: false,
            numbers: None,
            exact: values,
        };
        turn.keep(id.clone(), live);
        self.change(|state| state.report.run = Some(run));
        let (mut recorder, mut curves) = (recording.recorder(0), Ghost::new(&format!("pinned {id}")));
        let mut watch = Watch { turn, reported: Instant::now() };
        let solved = solver.solve(&problem, &stop, &mut (&mut recorder, &mut (&mut curves, &mut watch)));
        let contact = solved.or_else(SolveError::into_contact)?;
        recorder.close(&contact)?;
        curves.close(&contact);
        recording.finish()?;
        let solved = Solved { id, problem, contact, rank: parameters.rank() };
        self.finish(solved, curves);
        Ok(())
    }

    /// Keeps what came out of a solve, and reports it.
    fn finish(&self, solved: Solved, curves: Ghost) {
        let numbers = Numbers::of_contact(&solved.contact, &solved.problem);
        self.change(|state| {
            if let Some(kept) = state.kept(&solved.id) {
                kept.curves = Some(Arc::new(curves));
            }
            state.solved = Some(Arc::new(solved));
            if let Some(run) = &mut state.report.run {
                run.ended = true;
                run.numbers = Some(numbers);
            }
        });
    }
}

impl Turn<'_> {
    /// Whether there was no order since.
    pub fn goes_on(self) -> bool {
        self.session.lock().generation == self.generation
    }

    /// The number of the order, which names what comes out of it.
    pub fn number(self) -> u64 {
        self.generation
    }

    /// Keeps a recording.
    pub fn keep(self, id: String, live: Live) {
        self.session.change(|state| state.keep(id, live));
    }

    /// Reports where a sweep stands.
    pub fn show_sweep(self, sweep: Sweep) {
        self.session.change(|state| state.report.sweep = Some(sweep));
    }
}

/// Reports where a solve stands, and ends it when its turn is over.
struct Watch<'a> {
    turn: Turn<'a>,
    reported: Instant,
}

impl Observer for Watch<'_> {
    fn step(&mut self, step: &Step<'_>) -> ControlFlow<()> {
        if !self.turn.goes_on() {
            return ControlFlow::Break(());
        }
        if self.reported.elapsed() >= INTERVAL {
            self.reported = Instant::now();
            let numbers = Numbers::of_step(step);
            self.turn.session.change(|state| {
                if let Some(run) = &mut state.report.run {
                    run.numbers = Some(numbers);
                }
            });
        }
        ControlFlow::Continue(())
    }
}
