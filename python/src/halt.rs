//! A switch that ends runs on other threads.

use asperity::contact::{Observer, Step, Wish};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A switch: once it is pulled, the runs on other threads of this process that look at it end at their next step.
#[pyclass(frozen, from_py_object, module = "asperity")]
#[derive(Clone, Default)]
pub struct Halt(Arc<AtomicBool>);

impl Halt {
    pub fn is_pulled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[pymethods]
impl Halt {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Ends the runs that look at it.
    fn pull(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Observer for &Halt {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(if self.is_pulled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }
}
