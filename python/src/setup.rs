//! Descriptions of contacts to solve.

use crate::conversion::{Sections, sections_from_keywords, sections_of, table_from_sections, to_python};
use crate::detached::Detached;
use crate::error::{bail, error_in_text, error_of_keywords, py_error};
use crate::output::check_output;
use crate::surface::Surface;
use asperity::error::SetupError;
use asperity::setup::{self, Auto, SetupTable};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::path::PathBuf;

/// The description of a contact to solve: the surface, the load, the solver, and what is recorded.
///
/// Setup(surface=..., grid=..., solid=..., load=..., flow=..., solver=..., stop=..., record=...) takes the sections of a scene as
/// dictionaries, with `_` for `-` in their keys. The solver may be a name alone, the solid a contact modulus, and the path the name of a table. Lengths and pressures are numbers in one set of units, or texts such
/// as "160 um" and "1 GPa": a unit for all of a kind, or for none. A load may be a list of loads. With grid={"refine": "auto", ...} the grid is refined until
/// area and kappa_r are accurate enough.
#[pyclass(frozen, eq, from_py_object, module = "asperity")]
#[derive(Clone, PartialEq)]
pub struct Setup {
    /// The setup, on the first grid.
    pub setup: setup::Setup,
    /// The tolerance of an automatic grid, if there is one.
    pub refinement: Option<Auto>,
}

impl Setup {
    /// The setup on one grid.
    pub fn new(setup: setup::Setup) -> Self {
        Self { setup, refinement: None }
    }

    /// The setup that a table describes.
    pub fn from_table(mut table: SetupTable) -> Result<Self, SetupError> {
        table.check_idle()?;
        table.check_force_numbers()?;
        table.check_force_units()?;
        let refinement = table.take_auto()?;
        Ok(Self { setup: table.setup()?, refinement })
    }

    /// Whether it has a list of loads.
    pub fn has_loads(&self) -> bool {
        !self.setup.loads.is_empty()
    }

    /// The setup of a table that a person wrote, in which all quantities of a kind have units or none has.
    fn from_written(table: SetupTable) -> Result<Self, SetupError> {
        table.check_units()?;
        Self::from_table(table)
    }

    /// The setup that some sections describe.
    pub fn from_sections(sections: &Sections) -> PyResult<Self> {
        Self::from_table(table_from_sections(sections)?).map_err(py_error)
    }

    /// The table as it is saved: with the digests of its files.
    pub fn to_saved_table(&self) -> SetupTable {
        self.with_grids(self.setup.to_saved_table())
    }

    /// The table with its request for a grid.
    fn table(&self) -> SetupTable {
        self.with_grids(self.setup.to_table())
    }

    /// A table of this setup with the request for a grid, which the setup alone does not have.
    fn with_grids(&self, mut table: SetupTable) -> SetupTable {
        if let Some(Auto { tolerance, axes }) = self.refinement {
            table.lay("grid.area-tolerance", tolerance.into());
            match axes {
                Some(axes) => table.lay("grid.points", vec!["auto"; axes].into()),
                None => table.lay("grid.refine", "auto".into()),
            }
        }
        table
    }

    /// The sections of the setup.
    pub fn sections(&self) -> Sections {
        sections_of(&self.table())
    }
}

#[pymethods]
impl Setup {
    #[new]
    #[pyo3(signature = (**keys), text_signature = "(*, surface, grid, load, solid=None, law=None, friction=None, adhesion=None, viscoelastic=None, path=None, sliding=None, rolling=None, flow=None, solver=None, stop=None, record=None)")]
    fn py_new(py: Python<'_>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let table = table_from_sections(&sections_from_keywords(keys)?)?;
        Self::from_written(table).map_err(|error| error_of_keywords(py, "Setup", &[""], error))
    }

    /// The setup that a TOML text describes.
    #[staticmethod]
    pub fn from_toml(text: &str) -> PyResult<Self> {
        SetupTable::from_toml(text).and_then(Self::from_written).map_err(error_in_text)
    }

    /// The setup that a JSON text describes: a scene, or a result that contains a setup.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        SetupTable::from_json(text).and_then(Self::from_written).map_err(error_in_text)
    }

    /// The setup in a scene (.toml, .json), or of a result that contains one (.npz, .json, .rrd).
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        if !asperity::record::is_recording(&path).map_err(py_error)? {
            return SetupTable::read(&path).and_then(Self::from_written).map_err(error_in_text);
        }
        match asperity::record::setups(&path).map_err(py_error)?.as_deref() {
            Some([text]) => Self::from_toml(text),
            _ => {
                bail(format!("{} does not contain exactly one setup: give a recording of one contact", path.display()))
            }
        }
    }

    /// The setup as TOML, with all digits of its numbers.
    pub fn to_toml(&self) -> String {
        self.table().to_toml()
    }

    /// The setup as JSON, with all digits of its numbers.
    fn to_json(&self) -> String {
        Value::Object(self.sections()).to_string()
    }

    /// The sections and keys as dictionaries.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.sections())
    }

    /// Writes the setup as a scene with the digests of its files, to a file whose name ends in .toml.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        check_output(&path, &["toml"], &self.setup)?;
        self.to_saved_table().write_scene(&path).map_err(py_error)
    }

    /// The command that repeats the solve under the first load, without a recording.
    fn command(&self) -> String {
        setup::command(&self.setup.under(self.setup.load))
    }

    /// The surface, generated or read.
    pub fn surface(&self, py: Python<'_>) -> PyResult<Surface> {
        let mut sections = sections_of(&self.setup);
        sections.retain(|key, _| key == "surface" || key == "grid");
        if Surface::is_array(&sections) {
            return bail(
                "the heights of this setup were given as an array and are not in it: give them to Surface again",
            );
        }
        let surface = py.try_detached(|| self.setup.surface())?;
        let rank = self.setup.surface.rank(&self.setup.grid).map_err(py_error)?;
        Ok(Surface::from_surface(surface.into(), sections, rank))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((slf.get_type().getattr("from_toml")?, (slf.get().to_toml(),)))
    }

    fn __repr__(&self) -> String {
        format!("Setup.from_toml('''\n{}''')", self.to_toml())
    }
}
