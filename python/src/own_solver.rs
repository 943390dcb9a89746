//! Solvers that are written in Python.

use crate::arrays::{ArrayLike, field_on};
use crate::error::bail;
use crate::problem::Problem;
use asperity::error::Failure;
use asperity::foreign::Frame;
use pyo3::prelude::*;
use pyo3::types::PyIterator;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A function of a problem that yields one pressure after the other.
pub struct OwnSolver {
    function: Py<PyAny>,
    pub name: String,
}

/// The pressures of a solver, taken on the thread that certifies them.
pub struct Pressures {
    iterator: Py<PyIterator>,
    shape: [usize; 2],
    start: Instant,
    exception: Mutex<Option<PyErr>>,
}

impl OwnSolver {
    pub fn new(function: &Bound<'_, PyAny>) -> PyResult<Self> {
        let name = function.getattr("__name__").or_else(|_| function.get_type().getattr("__name__"))?;
        Ok(Self { function: function.clone().unbind(), name: name.extract()? })
    }

    /// Calls the function with the problem.
    pub fn begin(&self, py: Python<'_>, problem: &Problem) -> PyResult<Pressures> {
        let given = problem.under(problem.problem.clone(), problem.setup.clone());
        let made = self.function.bind(py).call1((Py::new(py, given)?,))?;
        let Ok(iterator) = made.try_iter() else {
            return bail(format!(
                "the solver {} returns {}: let it yield one pressure after the other",
                self.name,
                made.get_type().name()?
            ));
        };
        let shape = problem.surface.grid().shape();
        Ok(Pressures { iterator: iterator.unbind(), shape, start: Instant::now(), exception: Mutex::default() })
    }
}

impl Pressures {
    /// The pressures up to the last one, or to an exception.
    pub fn iter(&self) -> impl Iterator<Item = Result<Frame, Failure>> + Send + '_ {
        std::iter::from_fn(|| {
            let next = Python::attach(|py| match self.iterator.bind(py).clone().next() {
                Some(given) => given.and_then(|given| self.frame(&given)).map(Some),
                None => Ok(None),
            });
            next.unwrap_or_else(|exception| {
                *self.exception.lock().unwrap_or_else(PoisonError::into_inner) = Some(exception);
                None
            })
            .map(Ok)
        })
    }

    fn frame(&self, given: &Bound<'_, PyAny>) -> PyResult<Frame> {
        let field = field_on(&ArrayLike::new(given, "a pressure of the solver")?, self.shape, "pressure")?;
        Ok(Frame { values: field.into_raw_vec_and_offset().0, seconds: Some(self.start.elapsed().as_secs_f64()) })
    }

    /// The exception that ended the solver, if one did.
    pub fn exception(&self) -> Option<PyErr> {
        self.exception.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}
