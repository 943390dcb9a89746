//! Results read again from their archives.

use crate::contact::Contact;
use crate::conversion::{Sections, section_mut};
use crate::detached::Detached;
use crate::error::py_error;
use crate::history::History;
use crate::prepared_array::sections_of_array;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::surface::Surface;
use crate::warn::warn_sentence;
use asperity::job::{SavedFound, SavedResult};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;

/// Reads a saved result (.npz) again: a Contact or a History, of this package or of the command line.
///
/// A file that is as it was written, by the same revision of the numerics, is believed: everything comes back as it was saved, with certificates and
/// claims. A digest in the file tells it; it guards against damage and mix-ups, not against forgery. A file without a digest, with another one, or of
/// another revision raises an AsperityWarning: the status of its contacts is "not confirmed by its file", so that they are not converged, and
/// its states claim nothing. `certify` says whether the pressure of such a file is right.
///
/// The seconds of the work are 0, since files do not hold them.
#[pyfunction]
pub fn load(py: Python<'_>, path: PathBuf) -> PyResult<Py<PyAny>> {
    let result = py.try_detached(|| SavedResult::read(&path))?;
    result.doubts.iter().try_for_each(|doubt| warn_sentence(py, doubt))?;
    let setup = Setup::from_toml(&result.text)?;
    let surface = Surface::from_surface(result.surface.clone(), sections(&result, &setup), result.rank);
    let (surface, rank) = (surface.surface, result.rank);
    match result.found {
        SavedFound::Contact(state, slip) => {
            let slip = slip.map(|slip| *slip);
            let contact = Contact { slip, ..Contact::new(*state, surface, setup.setup, rank) };
            Ok(Py::new(py, contact)?.into_any())
        }
        SavedFound::States(outcome) => {
            let problem = setup.setup.problem_of(surface.clone()).map_err(py_error)?;
            let problem = Problem { problem, surface, setup: setup.clone(), rank, preparation: Arc::default() };
            Ok(History::new(py, *outcome, &problem, setup)?.into_any())
        }
    }
}

/// The sections of a surface that files or an array gave, whose heights are those of the result.
fn sections(result: &SavedResult, setup: &Setup) -> Sections {
    if !setup.setup.surface.is_measured() {
        return Sections::new();
    }
    let (grid, axes) = (result.surface.grid(), 2 - result.rank..);
    let mut sections = sections_of_array(Sections::new());
    let cell = section_mut(&mut sections, "grid");
    cell.insert("points".into(), json!(grid.shape()[axes.clone()]));
    cell.insert("size".into(), json!(grid.size()[axes]));
    let described = setup.sections().remove("grid").unwrap_or(Value::Null);
    for key in ["boundary", "datum"] {
        if let Some(value) = described.get(key) {
            cell.insert(key.into(), value.clone());
        }
    }
    sections
}
