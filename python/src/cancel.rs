//! Cancelling runs on other threads.

use asperity::contact::{Observer, Step, Wish};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cancels runs on other threads of this process: each run that was given this token ends at its next step after `cancel()`.
#[pyclass(frozen, from_py_object, module = "asperity")]
#[derive(Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[pymethods]
impl CancelToken {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Ends the runs that were given this token.
    fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Observer for &CancelToken {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        self.ask()
    }

    fn ask(&mut self) -> Wish {
        Ok(if self.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
