//! Rough contact in Python: what the package `asperity` is made of.
//!
//! ```text
//! Surface --> Problem --> solve (on a thread, watched) --(Step)--> callback
//!    ^           ^              |
//!    +-- Setup --+              v
//!                            Contact            Recorder <--(pressure)-- a loop of one's own
//! ```
//!
//! Everything is described by sections and keys of a setup, see [`value`]; nothing is computed here that the library does not compute.

mod certificate;
mod contact;
mod field;
mod problem;
mod process;
mod recorder;
mod refusal;
mod setup;
mod step;
mod surface;
mod target;
mod theory;
mod value;
mod verdict;
mod watch;
mod wishes;

use pyo3::prelude::*;

/// The command line, with the words behind the name of the program; returns the exit code.
#[pyfunction]
fn main(py: Python<'_>, words: Vec<String>) -> u8 {
    let words = std::iter::once("asperity".to_owned()).chain(words);
    py.detach(|| asperity::cli::run(words.map(Into::into)))
}

/// What the measures of a contact are: by name, the symbol, the unit and one sentence.
#[pyfunction]
fn observables(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    value::python(py, &asperity::contact::OBSERVABLES)
}

#[pymodule]
mod _asperity {
    #[pymodule_export]
    use super::{main, observables};
    #[pymodule_export]
    use crate::certificate::{Certificate, Work};
    #[pymodule_export]
    use crate::contact::Contact;
    #[pymodule_export]
    use crate::problem::Problem;
    #[pymodule_export]
    use crate::recorder::Recorder;
    #[pymodule_export]
    use crate::refusal::{AsperityError, AsperityWarning};
    #[pymodule_export]
    use crate::setup::Setup;
    #[pymodule_export]
    use crate::step::Step;
    #[pymodule_export]
    use crate::surface::Surface;
    #[pymodule_export]
    use crate::theory::{
        PowerLaw, Westergaard, counting_excess, cylinder, exact, greenwood_williamson, persson_pressure_density,
        persson_relative_area, sphere,
    };
    #[pymodule_export]
    use crate::verdict::Verdict;
}
