//! A run on a thread of its own, while Python looks on.
//!
//! The thread that called waits for steps to show and for Ctrl-C, without the lock of the interpreter. A step stays where the solver
//! is: what Python asks of it goes there as a [`Question`], so that nothing is computed or copied that nobody asks for.

use crate::process;
use asperity::contact::{Observer, Step, Wish};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::thread;
use std::time::Duration;

/// How long Ctrl-C may go unseen.
const PATIENCE: Duration = Duration::from_millis(50);

/// Something that is asked of a step where it is.
type Question = Box<dyn FnOnce(&Step<'_>) + Send>;

/// A word to a solver that shows a step.
enum Word {
    Asked(Question),
    /// All is seen, and whether the run goes on.
    Seen(bool),
}

/// What looks at a step, and says whether to go on.
pub type Look<'a> = dyn Fn(Python<'_>, &Shown) -> PyResult<bool> + Sync + 'a;

/// What the thread that called does while the work goes on.
#[derive(Clone, Copy)]
pub struct Sight<'a> {
    /// What looks at the steps.
    pub see: Option<&'a Look<'a>>,
    /// What is done between them, and every few hundredths of a second.
    pub meanwhile: &'a (dyn Fn(Python<'_>) -> PyResult<()> + Sync),
}

impl Sight<'_> {
    /// Nothing but Ctrl-C is looked for.
    pub const NONE: Self = Self { see: None, meanwhile: &|_| Ok(()) };
}

/// A step that is shown: it can be asked until it is over.
#[derive(Clone)]
pub struct Shown(Sender<Word>);

impl Shown {
    /// What the step answers; none if it is over.
    pub fn ask<T: Send + 'static>(&self, of: impl FnOnce(&Step<'_>) -> T + Send + 'static) -> Option<T> {
        let (answer, answered) = channel();
        let question: Question = Box::new(move |step| {
            answer.send(of(step)).ok(); // who asked may be gone
        });
        self.0.send(Word::Asked(question)).ok()?;
        answered.recv().ok()
    }
}

/// The observer on the thread of the solver.
pub struct Watch {
    is_over: Arc<AtomicBool>,
    shown: SyncSender<Shown>,
    is_shown: bool,
}

impl Watch {
    /// The watch that sees Ctrl-C and shows nothing, for a run before the one that is shown.
    pub fn quiet(&self) -> Self {
        Self { is_over: self.is_over.clone(), shown: self.shown.clone(), is_shown: false }
    }

    /// Shows a step, answers what is asked of it, and returns whether to go on.
    fn show(&self, step: &Step<'_>) -> bool {
        let (words, spoken) = channel();
        if self.shown.send(Shown(words)).is_err() {
            return false;
        }
        for word in spoken {
            match word {
                Word::Asked(question) => question(step),
                Word::Seen(goes_on) => return goes_on,
            }
        }
        false
    }
}

impl Observer for Watch {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        let goes_on = !self.is_over.load(Ordering::Relaxed) && (!self.is_shown || self.show(step));
        Ok(if goes_on { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
    }
}

/// Does some work on a thread of its own, in sight of the one that called. What is raised there, or Ctrl-C, ends the work and is raised.
pub fn watched<T: Send>(py: Python<'_>, sight: Sight<'_>, work: impl FnOnce(&mut Watch) -> T + Send) -> PyResult<T> {
    process::check()?;
    let is_over = Arc::new(AtomicBool::new(false));
    let (shown, steps) = sync_channel(0);
    let mut watch = Watch { is_over: is_over.clone(), shown, is_shown: sight.see.is_some() };
    py.detach(|| {
        thread::scope(|scope| {
            let worker = scope.spawn(move || work(&mut watch));
            let raised = look_on(&steps, &is_over, sight);
            drop(steps);
            let done = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            raised.map_or(Ok(done), Err)
        })
    })
}

/// Sees all steps to the end of the run, and returns what was raised first.
fn look_on(steps: &Receiver<Shown>, is_over: &AtomicBool, sight: Sight<'_>) -> Option<PyErr> {
    let mut raised = None;
    loop {
        let goes_on = match (steps.recv_timeout(PATIENCE), sight.see) {
            (Ok(step), Some(see)) => {
                let goes_on = Python::attach(|py| (sight.meanwhile)(py).and_then(|()| see(py, &step)));
                step.0.send(Word::Seen(*goes_on.as_ref().unwrap_or(&false))).ok(); // the solver waits for it
                goes_on
            }
            (Err(RecvTimeoutError::Timeout), _) => Python::attach(|py| {
                py.check_signals()?;
                (sight.meanwhile)(py).map(|()| true)
            }),
            (Ok(_), None) | (Err(RecvTimeoutError::Disconnected), _) => return raised,
        };
        if let Err(error) = goes_on {
            is_over.store(true, Ordering::Relaxed);
            raised.get_or_insert(error);
        }
    }
}
