//! Rigid surfaces.

use crate::field::{Given, list, rows, shared};
use crate::process;
use crate::refusal::refused;
use crate::value::{Sections, python, section, sections, table};
use asperity::setup::Cost;
use asperity::surface::{PowerSpectrum, Roughness};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use std::sync::Arc;

/// The name that stands for an array in the setup of a surface that was given as one.
pub const ARRAY: &str = "array.npy";

/// Fields that are held while a surface is made.
const FIELDS: f64 = 4.0;

/// Keys that say where a surface lies; all others say what it is.
const OF_GRID: [&str; 5] = ["points", "size", "boundary", "datum", "refine"];

/// A rigid surface: heights on a grid, peaks towards the solid positive.
///
/// Surface(height, size, *, boundary="periodic", datum=None) takes the heights of a line, shape (n), or of a surface, shape (ny, nx), a
/// length each. `size` is the length of the cell, or the lengths along y and x; texts such as "160 um" become metres. The boundary is
/// "periodic" or "free", or one of these for each axis. Surface.read, Surface.rough, Surface.indenter and Surface.of make others.
#[pyclass(frozen, module = "asperity")]
pub struct Surface {
    pub surface: Arc<asperity::Surface>,
    /// The sections `surface` and `grid` of a setup.
    pub sections: Sections,
    /// Axes of the arrays outside.
    pub rank: usize,
}

impl Surface {
    /// The surface that some sections describe.
    fn made(py: Python<'_>, sections: Sections) -> PyResult<Self> {
        let (recipe, cell) = table(&sections)?.surface().map_err(refused)?;
        let rank = recipe.rank(&cell).map_err(refused)?;
        let grid = recipe.grid(&cell).map_err(refused)?;
        Cost::of_fields(&grid, FIELDS).check("a surface").map_err(refused)?;
        process::check()?;
        let surface = py.detach(|| recipe.surface(grid)).map_err(refused)?;
        Ok(Self { surface: surface.into(), sections, rank })
    }

    /// The surface of some keys, of which those that are none of the grid belong below `place`.
    fn keyed(py: Python<'_>, of: Option<&Bound<'_, PyDict>>, place: &[&str], fixed: Sections) -> PyResult<Self> {
        let mut given = fixed;
        given.extend(of.map(sections).transpose()?.unwrap_or_default());
        let mut made = Sections::new();
        section(&mut made, "grid");
        for (key, value) in given {
            let is_of_grid = OF_GRID.contains(&key.as_str());
            let (path, key) = match key.as_str() {
                "seed" => (&["surface"][..], key),
                _ if is_of_grid => (&["grid"][..], key),
                _ => (place, key),
            };
            path.iter().fold(&mut made, |at, name| section(at, name)).insert(key, value);
        }
        Self::made(py, made)
    }

    /// The sections of a surface that is an array on some grid.
    fn of_array(grid: Sections) -> Sections {
        let mut sections = Sections::new();
        section(&mut sections, "surface").insert("height".into(), ARRAY.into());
        sections.insert("grid".into(), Value::Object(grid));
        sections
    }

    /// Whether the heights are at hand only, and in no file or recipe.
    pub fn is_array(sections: &Sections) -> bool {
        sections.get("surface").and_then(|it| it.get("height")).is_some_and(|height| height == ARRAY)
    }
}

#[pymethods]
impl Surface {
    #[new]
    #[pyo3(signature = (height, size, **where_), text_signature = "(height, size, *, boundary='periodic', datum=None)")]
    fn new(height: Given<'_>, size: Bound<'_, PyAny>, where_: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (rank, field) = (height.as_array().ndim(), rows(&height)?);
        let shape = &field.shape()[2 - rank.clamp(1, 2)..];
        let mut grid = where_.map(sections).transpose()?.unwrap_or_default();
        grid.insert("size".into(), crate::value::value(&size, "size")?);
        let mut sized = Self::of_array(grid.clone());
        section(&mut sized, "grid").insert("points".into(), json!(shape));
        let (_, cell) = table(&sized)?.surface().map_err(refused)?;
        let grid_of = cell.grid().map_err(refused)?;
        process::check()?;
        let surface = height.py().detach(|| asperity::Surface::new(grid_of, field)).map_err(refused)?;
        Ok(Self { surface: surface.into(), sections: Self::of_array(grid), rank })
    }

    /// Heights from a file of an instrument, .npy, .npz or text.
    ///
    /// Keywords are those of the sections `surface` and `grid` of a scene: size, boundary, datum, refine, channel, file_unit, prepare,
    /// against. With prepare="auto" the steps are chosen that the heights need.
    #[staticmethod]
    #[pyo3(signature = (path, **keys), text_signature = "(path, *, size=None, channel=None, file_unit=None, prepare=None, **grid)")]
    fn read(path: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut fixed = Sections::new();
        fixed.insert("height".into(), crate::value::value(&path, "path")?);
        if let Some(way) = keys.map(|keys| keys.get_item("prepare")).transpose()?.flatten()
            && let Ok(way) = way.extract::<String>()
        {
            fixed.insert("prepare".into(), json!({ "steps": way }));
            let rest = keys.map(|keys| keys.copy()).transpose()?;
            rest.iter().try_for_each(|rest| rest.del_item("prepare"))?;
            return Self::keyed(path.py(), rest.as_ref(), &["surface"], fixed);
        }
        Self::keyed(path.py(), keys, &["surface"], fixed)
    }

    /// Self-affine roughness: one realisation of the power spectrum of van Dokkum et al. (2018), Eq. 10.
    ///
    /// points and size are those of the cell, numbers for a line and pairs along y and x for a surface; hurst is above 0 and at most 1;
    /// rolloff_wavelength and short_cutoff are lengths; each realisation is scaled to rms_gradient. One seed gives the same heights on
    /// every machine.
    #[staticmethod]
    #[pyo3(signature = (points, size, **keys), text_signature = "(points, size, *, hurst, rolloff_wavelength, short_cutoff, rms_gradient, seed=1, **grid)")]
    fn rough(points: Bound<'_, PyAny>, size: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let fixed = cell(&points, &size)?;
        Self::keyed(points.py(), keys, &["surface", "spectrum"], fixed)
    }

    /// A smooth indenter, centred in the cell.
    ///
    /// shape is "cylinder" or "sphere" (radius), "sine" or "crossed-sine" (amplitude), "wedge" or "cone" (slope), "punch" (half_width,
    /// depth) or "power-law" (coefficient, exponent).
    #[staticmethod]
    #[pyo3(signature = (shape, points, size, **keys), text_signature = "(shape, points, size, **parameters)")]
    fn indenter(
        shape: String,
        points: Bound<'_, PyAny>,
        size: Bound<'_, PyAny>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut fixed = cell(&points, &size)?;
        fixed.insert("shape".into(), shape.into());
        Self::keyed(points.py(), keys, &["surface", "indenter"], fixed)
    }

    /// The surface of the sections `surface` and `grid` of a scene, as dictionaries.
    #[staticmethod]
    fn of(surface: &Bound<'_, PyDict>, grid: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut made = Sections::new();
        made.insert("surface".into(), Value::Object(sections(surface)?));
        made.insert("grid".into(), Value::Object(sections(grid)?));
        Self::made(surface.py(), made)
    }

    /// Heights about their mean, a length: shape (n) or (ny, nx), shared and read-only.
    #[getter]
    fn height<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        let Self { surface, rank, .. } = slf.get();
        shared(surface.height(), *rank, slf.clone().into_any())
    }

    /// The mean of the heights as they were given, a length.
    #[getter]
    fn mean_height(&self) -> f64 {
        self.surface.mean_height()
    }

    /// Points along the axes.
    #[getter]
    fn shape<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pyo3::types::PyTuple::new(py, &self.surface.grid().shape()[2 - self.rank..])?.into_any())
    }

    /// Lengths of the cell along the axes.
    #[getter]
    fn size<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pyo3::types::PyTuple::new(py, &self.surface.grid().size()[2 - self.rank..])?.into_any())
    }

    /// Positions of the nodes along x, a length, from 0.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        list(py, self.surface.grid().x().collect())
    }

    /// Positions of the nodes along y, a length, from 0; of a line the one number 0.
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        list(py, self.surface.grid().y().collect())
    }

    /// Statistics of the heights: rms_height, peak, valley (lengths), rms_gradient, rms_curvature (1/length), skewness, kurtosis.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let roughness = py.detach(|| Roughness::of(&self.surface));
        python(py, &roughness)
    }

    /// Power spectrum of the heights: wavenumbers 2 pi / wavelength (1/length), and densities, length^3 of a line, length^4 of a surface.
    fn spectrum<'py>(&self, py: Python<'py>) -> [Bound<'py, PyArray1<f64>>; 2] {
        let PowerSpectrum { wavenumber, density, .. } = py.detach(|| PowerSpectrum::of(&self.surface));
        [list(py, wavenumber), list(py, density)]
    }

    /// The sum of two surfaces on the same grid, such as roughness on a sphere.
    fn __add__(&self, other: &Self) -> PyResult<Self> {
        if self.surface.grid() != other.surface.grid() {
            return crate::refusal::refuse(
                "the surfaces have different grids: give the same points, size and boundary",
            );
        }
        let mut grid = self.sections.get("grid").and_then(Value::as_object).cloned().unwrap_or_default();
        grid.remove("points");
        grid.insert("size".into(), json!(self.surface.grid().size()[2 - self.rank..]));
        let sections = Self::of_array(grid);
        Ok(Self { surface: self.surface.plus(&other.surface).into(), sections, rank: self.rank })
    }

    fn __repr__(&self) -> String {
        let grid = self.surface.grid();
        let (shape, size) = (&grid.shape()[2 - self.rank..], &grid.size()[2 - self.rank..]);
        format!("Surface(shape={shape:?}, size={size:?}, {})", grid.boundary())
    }
}

/// Points and size of a cell.
fn cell(points: &Bound<'_, PyAny>, size: &Bound<'_, PyAny>) -> PyResult<Sections> {
    let mut cell = Sections::new();
    cell.insert("points".into(), crate::value::value(points, "points")?);
    cell.insert("size".into(), crate::value::value(size, "size")?);
    Ok(cell)
}
