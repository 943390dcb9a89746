//! Descriptions of contacts to solve.

use crate::contact::Contact;
use crate::problem::Problem;
use crate::refusal::{refuse, refused};
use crate::surface::Surface;
use crate::value::{python, sections, sections_of, setup};
use asperity::setup::{self, Table};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::Value;
use std::path::PathBuf;

/// The description of a contact to solve: what is pressed, how hard, by which solver, and what is recorded of it.
///
/// Setup(surface=..., grid=..., solid=..., load=..., solver=..., stop=..., record=...) takes the sections of a scene as dictionaries,
/// with `_` for `-` in their keys. Lengths and pressures are numbers in one set of units, or texts such as "160 um" and "1 GPa".
#[pyclass(frozen, module = "asperity")]
pub struct Setup(pub setup::Setup);

#[pymethods]
impl Setup {
    #[new]
    #[pyo3(signature = (**keys), text_signature = "(*, surface, grid, load, solid=None, law=None, friction=None, solver=None, stop=None, record=None)")]
    fn new(keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Ok(Self(setup(&keys.map(sections).transpose()?.unwrap_or_default())?))
    }

    /// The setup that a TOML text describes.
    #[staticmethod]
    fn from_toml(text: &str) -> PyResult<Self> {
        setup::Setup::from_toml(text).map(Self).map_err(refused)
    }

    /// The setup that a JSON text describes, or that a result in JSON carries.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        Table::from_json(text).and_then(Table::setup).map(Self).map_err(refused)
    }

    /// The setup in a scene (.toml, .json), or of a result that carries one (.npz, .json, .rrd).
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        if !asperity::record::is_recording(&path).map_err(refused)? {
            return Table::read(&path).and_then(Table::setup).map(Self).map_err(refused);
        }
        match asperity::record::setups(&path).map_err(refused)?.as_deref() {
            Some([text]) => Self::from_toml(text),
            _ => refuse(format!("{} does not hold one setup: give a recording of one contact", path.display())),
        }
    }

    /// The setup as TOML, all numbers to the last bit.
    fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    /// The setup as JSON, all numbers to the last bit.
    fn to_json(&self) -> String {
        Value::Object(sections_of(&self.0)).to_string()
    }

    /// The sections and keys as dictionaries.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python(py, &sections_of(&self.0))
    }

    /// Writes the setup as a scene.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        self.0.write(&path).map_err(refused)
    }

    /// The command line that repeats it, without a recording.
    fn command(&self) -> String {
        setup::command(&self.0)
    }

    /// The surface, made or read.
    fn surface(&self, py: Python<'_>) -> PyResult<Surface> {
        let mut sections = sections_of(&self.0);
        sections.retain(|key, _| key == "surface" || key == "grid");
        if Surface::is_array(&sections) {
            return refuse(
                "the heights of this setup were given as an array and are not in it: give them to Surface again",
            );
        }
        let surface = py.detach(|| self.0.surface()).map_err(refused)?;
        let rank = self.0.surface.rank(&self.0.grid).map_err(refused)?;
        Ok(Surface { surface: surface.into(), sections, rank })
    }

    /// The problem.
    fn problem(&self, py: Python<'_>) -> PyResult<Problem> {
        let Surface { surface, rank, .. } = self.surface(py)?;
        Problem::made(py, &surface, self.0.clone(), rank)
    }

    /// Solves it, by its own solver unless another is named; keywords are those of Problem.solve.
    #[pyo3(signature = (**wishes), text_signature = "($self, *, solver=None, tolerance=None, pressure_tolerance=None, max_iterations=None, start=None, callback=None, record=None, recording=None, live=False, stream=None, diagnose=False)")]
    fn solve(&self, py: Python<'_>, wishes: Option<&Bound<'_, PyDict>>) -> PyResult<Contact> {
        self.problem(py)?.solve(py, wishes)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let text = PyTuple::new(slf.py(), [slf.get().to_toml()])?;
        Ok((slf.get_type().getattr("from_toml")?, text))
    }

    fn __repr__(&self) -> String {
        format!("Setup.from_toml('''\n{}''')", self.to_toml())
    }
}
