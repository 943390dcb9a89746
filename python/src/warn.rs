//! Sentences as warnings of Python.

use crate::error::AsperityWarning;
use asperity::seen::plain;
use pyo3::prelude::*;
use std::ffi::CString;

/// Raises a warning with one sentence, at the line of code outside of the package that has called it.
pub fn warn_sentence(py: Python<'_>, sentence: &str) -> PyResult<()> {
    PyErr::warn(py, &py.get_type::<AsperityWarning>(), &CString::new(&*plain(sentence))?, stack_level(py)?)
}

/// The level of the stack at which the calling code stands: above the functions of the package.
fn stack_level(py: Python<'_>) -> PyResult<i32> {
    let frame = py.import("sys")?.call_method1("_getframe", (0,))?;
    let module = frame.getattr("f_globals")?.get_item("__name__")?;
    Ok(if module.extract::<String>()?.split('.').next() == Some("asperity") { 2 } else { 1 })
}
