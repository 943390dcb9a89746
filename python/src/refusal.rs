//! Errors of the library as exceptions.

use asperity::error::{ClaimError, SetupError};
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::{PyErr, create_exception};
use std::error::Error;

create_exception!(
    asperity,
    AsperityError,
    PyValueError,
    "What was given makes no contact, or a file cannot be read or written."
);
create_exception!(
    asperity,
    AsperityWarning,
    PyUserWarning,
    "A contact that did not converge: its certificate says how good it is."
);

/// Any error, on its way between threads.
pub type Fault = Box<dyn Error + Send + Sync>;

/// The exception with the sentence of an error, and the keyword by which one gives what is missing.
pub fn refused(error: impl Into<Fault>) -> PyErr {
    let error = error.into();
    AsperityError::new_err(format!("{}{}", without_flags(&error.to_string()), remedy(&error)))
}

/// A sentence without the flags of the command line at its end, such as " (--size)".
fn without_flags(sentence: &str) -> &str {
    sentence.split_once(" (--").map_or(sentence, |(sentence, _)| sentence)
}

/// An exception with a sentence of its own.
pub fn refuse<T>(sentence: impl Into<String>) -> Result<T, PyErr> {
    Err(AsperityError::new_err(sentence.into()))
}

/// The keywords by which one gives what is missing.
fn remedy(error: &Fault) -> &'static str {
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
