//! A run on a thread of its own, while the thread that called handles callbacks and Ctrl-C.
//!
//! The calling thread waits without the lock of the interpreter. A step stays on the thread of the solver: what Python
//! asks of it is sent there as a [`Query`], so that only requested data are computed or copied.

use crate::detached::fault;
use crate::fork;
use asperity::contact::{Observer, Step, Wish};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::thread;
use std::time::Duration;

/// The longest time between two checks for Ctrl-C.
const CHECK_INTERVAL: Duration = Duration::from_millis(50);

/// A function of a step, called on the thread of the solver.
type Query = Box<dyn FnOnce(&Step<'_>) + Send>;

/// A message to a solver that waits with a step.
enum Message {
    Query(Query),
    /// The callback is done; the run continues if this is true.
    Done(bool),
}

/// A callback for steps, which returns whether the run continues.
pub type StepCallback<'a> = dyn Fn(Python<'_>, &StepHandle) -> PyResult<bool> + Sync + 'a;

/// What the calling thread does during a run.
#[derive(Clone, Copy)]
pub struct Foreground<'a> {
    /// Called with every step.
    pub on_step: Option<&'a StepCallback<'a>>,
    /// Called between the steps, and at every check for Ctrl-C.
    pub on_idle: &'a (dyn Fn(Python<'_>) -> PyResult<()> + Sync),
}

impl Foreground<'_> {
    /// Only checks for Ctrl-C.
    pub const IDLE: Self = Self { on_step: None, on_idle: &|_| Ok(()) };
}

/// A step on the thread of its solver, which answers until its callback is done.
#[derive(Clone)]
pub struct StepHandle(Sender<Message>);

impl StepHandle {
    /// The result of a function of the step, or nothing if the step is over.
    pub fn query<T: Send + 'static>(&self, function: impl FnOnce(&Step<'_>) -> T + Send + 'static) -> Option<T> {
        let (sender, receiver) = channel();
        let query: Query = Box::new(move |step| {
            sender.send(function(step)).ok(); // the thread that asked may have ended
        });
        self.0.send(Message::Query(query)).ok()?;
        receiver.recv().ok()
    }
}

/// The observer on the thread of the solver: it sends steps to the calling thread.
#[derive(Clone)]
pub struct StepSender {
    is_cancelled: Arc<AtomicBool>,
    steps: SyncSender<StepHandle>,
    sends_steps: bool,
}

impl StepSender {
    /// The same without the steps: an observer that ends the run at Ctrl-C.
    pub fn silent(&self) -> Self {
        Self { sends_steps: false, ..self.clone() }
    }

    /// Whether the calling thread has ended the run.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    /// Sends a step, answers the queries about it, and returns whether the run continues.
    fn send(&self, step: &Step<'_>) -> bool {
        let (sender, messages) = channel();
        if self.steps.send(StepHandle(sender)).is_err() {
            return false;
        }
        for message in messages {
            match message {
                Message::Query(query) => query(step),
                Message::Done(goes_on) => return goes_on,
            }
        }
        false
    }
}

impl Observer for StepSender {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        let goes_on = !self.is_cancelled() && (!self.sends_steps || self.send(step));
        Ok(if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
    }

    fn ask(&mut self) -> Wish {
        Ok(if self.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}

/// Does some work on a thread of its own. An exception of a callback, or Ctrl-C, ends the work and is raised.
pub fn run_in_background<T: Send>(
    py: Python<'_>,
    foreground: Foreground<'_>,
    work: impl FnOnce(&mut StepSender) -> T + Send,
) -> PyResult<T> {
    fork::check_not_forked()?;
    let is_cancelled = Arc::new(AtomicBool::new(false));
    let (sender, steps) = sync_channel(0);
    let sends_steps = foreground.on_step.is_some();
    let mut sender = StepSender { is_cancelled: is_cancelled.clone(), steps: sender, sends_steps };
    py.detach(|| {
        thread::scope(|scope| {
            let worker = scope.spawn(move || work(&mut sender));
            let exception = wait(&steps, &is_cancelled, foreground);
            drop(steps);
            let done = worker.join().map_err(|panic| fault(&*panic));
            exception.map_or(done, Err)
        })
    })
}

/// Handles all steps until the run ends, and returns the first exception.
fn wait(steps: &Receiver<StepHandle>, is_cancelled: &AtomicBool, foreground: Foreground<'_>) -> Option<PyErr> {
    let mut exception = None;
    loop {
        let goes_on = match (steps.recv_timeout(CHECK_INTERVAL), foreground.on_step) {
            (Ok(step), Some(on_step)) => {
                let goes_on = Python::attach(|py| (foreground.on_idle)(py).and_then(|()| on_step(py, &step)));
                if !matches!(goes_on, Ok(true)) {
                    is_cancelled.store(true, Ordering::Relaxed); // before the solver makes another step
                }
                step.0.send(Message::Done(*goes_on.as_ref().unwrap_or(&false))).ok(); // the solver waits for it
                goes_on
            }
            (Err(RecvTimeoutError::Timeout), _) => Python::attach(|py| {
                py.check_signals()?;
                (foreground.on_idle)(py).map(|()| true)
            }),
            (Ok(_), None) | (Err(RecvTimeoutError::Disconnected), _) => return exception,
        };
        if let Err(error) = goes_on {
            is_cancelled.store(true, Ordering::Relaxed);
            exception.get_or_insert(error);
        }
    }
}
