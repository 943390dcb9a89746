//! Errors of the library as exceptions of Python.

use asperity::error::{ClaimError, FileError, SetupError};
use pyo3::exceptions::{PyFileNotFoundError, PyPermissionError, PyUserWarning, PyValueError};
use pyo3::{PyErr, create_exception};
use std::error::Error;
use std::io;

create_exception!(
    asperity,
    AsperityError,
    PyValueError,
    "The input does not describe a contact, or a file has the wrong content. The message says what to change."
);
create_exception!(
    asperity,
    NotConverged,
    AsperityError,
    "A solver ended before it reached its tolerance. The attribute `contact` is the best contact that it found.\n\n\
     Contact.raise_if_not_converged raises it."
);
create_exception!(
    asperity,
    AsperityWarning,
    PyUserWarning,
    "A doubtful result: a solver that did not converge, a grid that is too coarse, or heights that cannot be right."
);

/// Any error that can be sent between threads.
pub type BoxedError = Box<dyn Error + Send + Sync>;

/// The exception for an error, with the keyword of Python that gives what is missing. A file that does not exist makes a
/// `FileNotFoundError`, one that may not be read or written a `PermissionError`, and everything else an `AsperityError`.
pub fn py_error(error: impl Into<BoxedError>) -> PyErr {
    let error = error.into();
    let sentence = format!("{}{}", without_flags(&sentence(&error)), keyword(&error));
    match io_error(error.as_ref()) {
        Some(io::ErrorKind::NotFound) => PyFileNotFoundError::new_err(sentence),
        Some(io::ErrorKind::PermissionDenied) => PyPermissionError::new_err(sentence),
        _ => AsperityError::new_err(sentence),
    }
}

/// Raises an `AsperityError` with a sentence.
pub fn bail<T>(sentence: impl Into<String>) -> Result<T, PyErr> {
    Err(AsperityError::new_err(sentence.into()))
}

/// The error of the operating system behind an error, if there is one.
fn io_error(error: &(dyn Error + 'static)) -> Option<io::ErrorKind> {
    match error.downcast_ref::<io::Error>() {
        Some(io) => Some(io.kind()),
        None => error.source().and_then(io_error),
    }
}

/// The sentence of an error in the words of Python.
fn sentence(error: &BoxedError) -> String {
    match error.downcast_ref() {
        Some(FileError::NoViewer { version }) => format!(
            "no Rerun viewer can be started: install one with `pip install rerun-sdk`, {version} or newer, or write a file (record)"
        ),
        _ => error.to_string(),
    }
}

/// A sentence without the flags of the command line at its end, such as " (--size)".
fn without_flags(sentence: &str) -> &str {
    sentence.split_once(" (--").map_or(sentence, |(sentence, _)| sentence)
}

/// The keywords that give what is missing.
fn keyword(error: &BoxedError) -> &'static str {
    const LOADS: &str = " (mean_pressure, reduced_pressure, mean_gap, force, approach)";
    if let Some(ClaimError::NoLoad) = error.downcast_ref() {
        return LOADS;
    }
    match error.downcast_ref() {
        Some(SetupError::NoLoad) => LOADS,
        Some(SetupError::NoModulus { .. }) => " (solid)",
        Some(SetupError::NoPoints) => " (points)",
        Some(SetupError::NoSize) => " (size)",
        Some(SetupError::Uneven { .. }) => " (prepare={'resample': 'linear'})",
        Some(SetupError::Voids { .. }) => " (prepare={'fill': 'harmonic'}, or prepare='auto')",
        _ => "",
    }
}
