//! Rough contact in Python: the compiled part of the package `asperity`.
//!
//! ```text
//! Surface --> Problem --> solve (on its own thread) --(Step)--> callback
//!    ^           ^              |
//!    +-- Setup --+              v
//!                            Contact            Recorder <--(pressure)-- your own loop
//!
//! Study --(batches)--> workers --(rows as text)--> Ledger --> Table
//! ```
//!
//! Sections and keys of a setup describe everything, see [`conversion`]. All computations are those of the library.
//! A file uses only files that come before it in this chain: setup, problem, contact, then what makes or examines contacts (solve, slip,
//! stress, certification, recorder). Methods of a class that need later files, such as `Problem.solve`, stand in these files.

mod arrays;
mod background;
mod cancel;
mod certificate;
mod certification;
mod contact;
mod contact_files;
mod contact_parts;
mod conversion;
mod depth_cut;
mod detached;
mod error;
mod flow;
mod fork;
mod history;
mod history_files;
mod history_parts;
mod ledger;
mod load;
mod measures;
mod operator;
mod output;
mod own_solver;
mod patches;
mod prepared_array;
mod problem;
mod recorder;
mod setup;
mod shared_state;
mod sink;
mod slip;
mod solve;
mod solve_options;
mod step;
mod stress;
mod study;
mod surface;
mod surface_files;
mod surface_numbers;
mod surface_parts;
mod table;
mod theory;
mod warn;
mod warnings;
mod words;

use crate::detached::Detached;
use pyo3::prelude::*;

/// Runs the command line with some arguments, and returns the exit code.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<String>) -> PyResult<u8> {
    let arguments = std::iter::once("asperity".to_owned()).chain(arguments);
    py.detached(|| asperity::cli::run(arguments.map(Into::into)))
}

/// The number of threads that this machine has for this process.
#[pyfunction]
fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The number of free bytes of memory, if the system knows it.
#[pyfunction]
fn free_memory() -> Option<f64> {
    asperity::setup::available_bytes()
}

/// Explains the measures of a contact: a dictionary for each, with its name, symbol, unit and one sentence.
#[pyfunction]
fn observables(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let rows: Vec<_> = asperity::contact::Quantity::found().map(asperity::contact::Quantity::row).collect();
    conversion::to_python(py, &rows)
}

/// The exception for a keyword that a function does not take, with the keyword that was probably meant.
#[pyfunction]
fn unexpected_keyword(py: Python<'_>, function: &str, name: &str, known: Vec<String>) -> Py<PyAny> {
    error::unexpected_keyword(py, function, name, &known).into_value(py).into_any()
}

#[pymodule]
mod _asperity {
    #[pymodule_export]
    use super::{free_memory, main, observables, threads, unexpected_keyword};
    #[pymodule_export]
    use crate::cancel::CancelToken;
    #[pymodule_export]
    use crate::certificate::{Certificate, Work};
    #[pymodule_export]
    use crate::certification::Certification;
    #[pymodule_export]
    use crate::contact::Contact;
    #[pymodule_export]
    use crate::error::{AsperityError, AsperityWarning, NotConverged};
    #[pymodule_export]
    use crate::history::History;
    #[pymodule_export]
    use crate::ledger::{Batch, Ledger};
    #[pymodule_export]
    use crate::load::load;
    #[pymodule_export]
    #[pymodule_export]
    use crate::problem::Problem;
    #[pymodule_export]
    use crate::recorder::Recorder;
    #[pymodule_export]
    use crate::setup::Setup;
    #[pymodule_export]
    use crate::slip::PartialSlip;
    #[pymodule_export]
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
}
