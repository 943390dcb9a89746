//! Rough contact in Python: what the package `asperity` is made of.
//!
//! ```text
//! Surface --> Problem --> solve (on a thread, watched) --(Step)--> callback
//!    ^           ^              |
//!    +-- Setup --+              v
//!                            Contact            Recorder <--(pressure)-- a loop of one's own
//!
//! Study --(batches)--> workers --(rows as text)--> Ledger --> Table
//! ```
//!
//! Everything is described by sections and keys of a setup, see [`value`]; nothing is computed here that the library does not compute.

mod certificate;
mod contact;
mod field;
mod halt;
mod ledger;
mod problem;
mod process;
mod recorder;
mod refusal;
mod setup;
mod step;
mod study;
mod surface;
mod table;
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

/// How many threads this machine has for this process.
#[pyfunction]
fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// How many bytes of memory are free, if the system tells.
#[pyfunction]
fn free_memory() -> Option<f64> {
    asperity::setup::available_bytes()
}

/// What the measures of a contact are: by name, the symbol, the unit and one sentence.
#[pyfunction]
fn observables(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    value::python(py, &asperity::contact::OBSERVABLES)
}

#[pymodule]
mod _asperity {
    #[pymodule_export]
    use super::{free_memory, main, observables, threads};
    #[pymodule_export]
    use crate::certificate::{Certificate, Work};
    #[pymodule_export]
    use crate::contact::Contact;
    #[pymodule_export]
    use crate::halt::Halt;
    #[pymodule_export]
    use crate::ledger::{Batch, Ledger};
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
    use crate::study::Study;
    #[pymodule_export]
    use crate::surface::Surface;
    #[pymodule_export]
    use crate::table::Table;
    #[pymodule_export]
    use crate::theory::{
        PowerLaw, Westergaard, counting_excess, cylinder, exact, greenwood_williamson, persson_pressure_density,
        persson_relative_area, sphere,
    };
    #[pymodule_export]
    use crate::verdict::Verdict;
}
