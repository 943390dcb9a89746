//! Work without the lock of the interpreter, whose faults are exceptions of the package.

use crate::error::{AsperityError, BoxedError, py_error};
use asperity::seen::plain;
use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Work without the lock of the interpreter.
pub trait Detached {
    /// What some work returns.
    ///
    /// # Errors
    /// `AsperityError` where the program has a fault.
    fn detached<T: Send>(self, work: impl FnOnce() -> T + Send) -> PyResult<T>;

    /// What some work returns that may fail.
    ///
    /// # Errors
    /// The exception for the error, and `AsperityError` where the program has a fault.
    fn try_detached<T: Send, E: Into<BoxedError> + Send>(
        self,
        work: impl FnOnce() -> Result<T, E> + Send,
    ) -> PyResult<T>;
}

impl Detached for Python<'_> {
    fn detached<T: Send>(self, work: impl FnOnce() -> T + Send) -> PyResult<T> {
        self.detach(|| catch_unwind(AssertUnwindSafe(work))).map_err(|panic| fault(&*panic))
    }

    fn try_detached<T: Send, E: Into<BoxedError> + Send>(
        self,
        work: impl FnOnce() -> Result<T, E> + Send,
    ) -> PyResult<T> {
        self.detached(work)?.map_err(py_error)
    }
}

/// The exception for a panic: a fault of the program that no input should reach.
pub fn fault(panic: &(dyn Any + Send)) -> PyErr {
    let words = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref().copied());
    let words = plain(words.unwrap_or("no reason is known")).replace('\n', " ");
    AsperityError::new_err(format!(
        "this is a fault of the program, not of your input ({words}): report it with the call that led to it"
    ))
}
