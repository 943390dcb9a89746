//! One solver thread, and all of its state in one place.

use super::parameters::{Parameters, Refusal};
use super::report::{Numbers, Report, Run, Sweep, Values};
use super::sweep;
use crate::contact::{Contact, Observer, Problem, Step, archive};
use crate::error::{FileError, SolveError};
use crate::record::{Live, Options, Recording, Scene, describe};
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
    /// The latest recordings and their names, the newest last.
    recordings: VecDeque<(String, Live)>,
    solved: Option<Arc<Solved>>,
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
    problem: Problem,
    contact: Contact,
    rank: usize,
}

/// Why an order was not carried out.
#[derive(Debug, thiserror::Error)]
enum Fault {
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

    /// The recording of the latest solve, and its name.
    pub fn latest(&self) -> Option<(String, Live)> {
        self.lock().recordings.back().cloned()
    }

    /// The recording of that name, if it is one of the latest.
    pub fn recording(&self, name: &str) -> Option<Live> {
        self.lock().recordings.iter().find(|(id, _)| id == name).map(|(_, live)| live.clone())
    }

    /// The arrays of the latest result as `.npz`; none before there is one.
    pub fn archive(&self) -> Option<Vec<u8>> {
        let solved = self.lock().solved.clone()?;
        archive(&solved.problem, &solved.contact, solved.rank).ok()
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
                Order::Sweep(parameters) => Ok(sweep::run(turn, &parameters)?),
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
        let (id, title) = (format!("run-{}", turn.generation), parameters.title());
        let values = exact.as_ref().map(Values::of);
        let scene = Scene {
            name: "contact".into(),
            title: title.clone(),
            problem: &problem,
            description: describe(&parameters.description(), &problem, "m", solver.as_ref(), &stop, exact.as_ref()),
            exact,
        };
        let options = Options { what: parameters.parts(), ..Options::default() };
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
        self.change(|state| {
            state.recordings.push_back((id, live));
            if state.recordings.len() > RECORDINGS {
                state.recordings.pop_front();
            }
            state.report.run = Some(run);
        });
        let mut recorder = recording.recorder(0);
        let solved = solver.solve(&problem, &stop, &mut (&mut recorder, &mut Watch::new(turn)));
        let contact = solved.or_else(SolveError::into_contact)?;
        recorder.close(&contact)?;
        recording.finish()?;
        let numbers = Numbers::of_contact(&contact, &problem);
        let solved = Arc::new(Solved { problem, contact, rank: parameters.rank() });
        self.change(|state| {
            state.solved = Some(solved);
            if let Some(run) = &mut state.report.run {
                run.ended = true;
                run.numbers = Some(numbers);
            }
        });
        Ok(())
    }
}

impl Turn<'_> {
    /// Whether there was no order since.
    pub fn goes_on(self) -> bool {
        self.session.lock().generation == self.generation
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

impl<'a> Watch<'a> {
    fn new(turn: Turn<'a>) -> Self {
        Self { turn, reported: Instant::now() }
    }
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
