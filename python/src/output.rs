//! Files that are written, apart from those that a setup reads.

use crate::error::py_error;
use asperity::files::{check_apart, check_named};
use asperity::setup::Setup;
use pyo3::prelude::*;
use std::path::Path;

/// Refuses a place where nothing can be written, a name that promises another content than one of the `endings`, and a file that the setup reads.
pub fn check_output(path: &Path, endings: &[&str], setup: &Setup) -> PyResult<()> {
    check_named(path, endings).map_err(py_error)?;
    check_not_read(path, setup)
}

/// Refuses a file that the setup reads.
pub fn check_not_read(path: &Path, setup: &Setup) -> PyResult<()> {
    let read = setup.files().map(|file| file.path().to_owned());
    check_apart([path], read).map_err(py_error)
}
