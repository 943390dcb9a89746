//! Errors of the library as exceptions of Python.

use crate::words::{at_place, in_python, keyword_of_flag, unknown_keyword};
use asperity::error::{ClaimError, Conflict, ConflictRule, FileError, SetupError, StudyError};
use asperity::seen::plain;
use pyo3::create_exception;
use pyo3::exceptions::{
    PyFileNotFoundError, PyIndexError, PyKeyError, PyPermissionError, PyTypeError, PyUserWarning, PyValueError,
};
use pyo3::prelude::*;
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

/// The exception for an error in the words of Python, with the keyword that gives what is missing. A file that does not exist makes a
/// `FileNotFoundError`, one that may not be read or written a `PermissionError`, and everything else an `AsperityError`.
pub fn py_error(error: impl Into<BoxedError>) -> PyErr {
    let error = error.into();
    exception(&error, format!("{}{}", sentence(&error), keyword(&error)))
}

/// The exception for an error about a text, whose keys are those of scenes.
pub fn error_in_text(error: SetupError) -> PyErr {
    match error {
        SetupError::Text { .. } => {
            let sentence = error.to_string();
            exception(&error.into(), sentence)
        }
        other => py_error(other),
    }
}

/// The exception for an error of a setup in `solve`, which takes the section `record` as `recording`.
pub fn error_in_solve(error: SetupError) -> PyErr {
    match &error {
        SetupError::Text { place, .. } if place.keys.starts_with("record") => {
            AsperityError::new_err(sentence_of_setup(&error).replacen("record", "recording", 1))
        }
        _ => py_error(error),
    }
}

/// The exception for an error in the keywords of a function, which are the keys of some sections: a `TypeError` for one that it does not take.
pub fn error_of_keywords(py: Python<'_>, function: &str, sections: &[&str], error: impl Into<BoxedError>) -> PyErr {
    let error = error.into();
    let of_study = match error.downcast_ref() {
        Some(StudyError::Setup(error) | StudyError::Row { source: error, .. }) => Some(error),
        _ => None,
    };
    let unknown = match of_study.or(error.downcast_ref()) {
        Some(SetupError::Text { place, fault }) => unknown_keyword(place, fault, sections),
        _ => None,
    };
    match unknown {
        Some((name, known)) => unexpected_keyword(py, function, &name, &known),
        None => py_error(error),
    }
}

/// The exception of the class for an error, with a sentence.
fn exception(error: &BoxedError, sentence: String) -> PyErr {
    let sentence = plain(&sentence).into_owned();
    match io_error(error.as_ref()) {
        Some(io::ErrorKind::NotFound) => PyFileNotFoundError::new_err(sentence),
        Some(io::ErrorKind::PermissionDenied) => PyPermissionError::new_err(sentence),
        _ => AsperityError::new_err(sentence),
    }
}

/// The exception for a keyword that a function does not take, with the keyword that was meant: that of a flag of the command line or a close one,
/// or else all known ones. The names may be keys of scenes.
pub fn unexpected_keyword(py: Python<'_>, function: &str, name: &str, known: &[impl AsRef<str>]) -> PyErr {
    let known: Vec<String> = known.iter().map(|it| it.as_ref().replace('-', "_")).collect();
    let name = name.replace('-', "_");
    let close = || close_name(py, &name, &known).map(|it| format!("'{it}'"));
    let is_known =
        |it: &String| it.split_once('=').is_some_and(|(keyword, _)| known.iter().any(|known| known == keyword));
    let hint = match keyword_of_flag(&name).filter(is_known).or_else(close) {
        Some(meant) => format!(". Did you mean {meant}?"),
        None => format!(". It takes {}", known.join(", ")),
    };
    PyTypeError::new_err(format!("{function}() got an unexpected keyword argument '{name}'{hint}"))
}

/// The exception for a key that a dictionary does not have, with the close name or all names.
pub fn unknown_name(py: Python<'_>, what: &str, name: &str, known: &[&str]) -> PyErr {
    let hint = match close_name(py, name, known) {
        Some(close) => format!("did you mean {close:?}?"),
        None => format!("give one of {}", known.join(", ")),
    };
    PyKeyError::new_err(format!("there is no {what} {name:?}: {hint}"))
}

/// The index of one of some rows or realisations, which count from 0; a negative one counts from the end.
pub fn index_of(what: &str, given: isize, count: usize) -> PyResult<usize> {
    let index = if given < 0 { given.saturating_add_unsigned(count) } else { given };
    let index = usize::try_from(index).ok().filter(|index| *index < count);
    let sentence = || format!("there is no {what} {given}: give one from 0 to {}", count - 1);
    index.ok_or_else(|| PyIndexError::new_err(sentence()))
}

/// The known name that is close to another one.
fn close_name<'py>(py: Python<'py>, name: &str, known: impl IntoPyObject<'py>) -> Option<String> {
    let close = || py.import("difflib")?.call_method1("get_close_matches", (name, known, 1))?.extract::<Vec<String>>();
    close().ok()?.pop()
}

/// An argument of a type, or the exception that names it and the type that is wanted.
pub fn argument<'a, 'py, T: FromPyObject<'a, 'py>>(
    given: &'a Bound<'py, PyAny>,
    name: &str,
    wanted: &str,
) -> PyResult<T> {
    given.extract().map_err(|_| wrong_type(name, wanted, given))
}

/// The exception for an argument of another type.
pub fn wrong_type(name: &str, wanted: &str, given: &Bound<'_, PyAny>) -> PyErr {
    match given.get_type().name() {
        Ok(class) => PyTypeError::new_err(format!("{name} must be {wanted}, not {class}")),
        Err(error) => error,
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
        Some(StudyError::Setup(error)) => return sentence_of_setup(error),
        // rows of Python count from 0
        Some(StudyError::Row { row, values, source }) => {
            return format!("row {} ({}): {}", row - 1, values, sentence_of_setup(source));
        }
        Some(StudyError::HistoryLoads) => {
            return "a study of histories goes along a path in each row: give one load, and further ones as path={'load': ...}"
                .into();
        }
        Some(StudyError::Missing { rows, first, of, .. }) => {
            let first = first - 1;
            return format!("{rows} of {of} rows are missing; the first is row {first}: solve them, and add them");
        }
        Some(StudyError::OtherStudy { path, points }) => {
            return format!(
                "{} holds {points} rows of another study, or of another version: give another file, or delete this one",
                path.display()
            );
        }
        _ => {}
    }
    match error.downcast_ref() {
        Some(error) => sentence_of_setup(error),
        None => in_python(&error.to_string()),
    }
}

/// The sentence of an error of a setup in the words of Python.
fn sentence_of_setup(error: &SetupError) -> String {
    match error {
        SetupError::Text { place, fault } => at_place(place, fault),
        SetupError::Conflict(conflict) => sentence_of_conflict(conflict),
        other => in_python(&other.to_string()),
    }
}

/// The sentence of a conflict in the words of Python.
fn sentence_of_conflict(conflict: &Conflict) -> String {
    match conflict.rule {
        ConflictRule::NoRefinement => "refine is 0: give 1 or more".into(),
        ConflictRule::JoinedWithoutSecond => {
            "joined needs two spectra: give surface={'second_spectrum': ...} as well, or leave it out".into()
        }
        ConflictRule::SecondSpectrum => {
            "a second spectrum is given without a first one: give surface={'spectrum': ...} as well".into()
        }
        _ => in_python(&conflict.to_string()),
    }
}

/// The keywords that give what is missing.
fn keyword(error: &BoxedError) -> &'static str {
    const LOADS: &str = " (mean_pressure, reduced_pressure, mean_gap, force, approach)";
    if let Some(ClaimError::NoLoad) = error.downcast_ref() {
        return LOADS;
    }
    if let Some(FileError::NoViewer { .. }) = error.downcast_ref() {
        return " (record)";
    }
    match error.downcast_ref() {
        Some(SetupError::File(FileError::NoViewer { .. })) => " (record)",
        Some(SetupError::Conflict(conflict)) => match conflict.rule {
            ConflictRule::NoLoad => LOADS,
            ConflictRule::NoTangential => " (friction={'tangential': ...}, path={'tangential': ...} or rolling)",
            ConflictRule::NoPoints => " (points)",
            ConflictRule::NoSize => " (size)",
            _ => "",
        },
        Some(SetupError::NoModulus { .. } | SetupError::UnitWithoutModulus { .. }) => " (solid)",
        Some(SetupError::Uneven { .. }) => " (prepare={'resample': 'linear'})",
        Some(SetupError::Voids { .. }) => " (prepare={'fill': 'harmonic'}, or prepare='auto')",
        _ => "",
    }
}
