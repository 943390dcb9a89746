//! Rigid surfaces.

use crate::arrays::{ArrayLike, in_parentheses, vector, view};
use crate::conversion::{
    Sections, section_mut, sections_from_dict, sections_from_keywords, table_from_sections, value_from_py,
};
use crate::detached::Detached;
use crate::error::{argument, bail, error_of_keywords, py_error, wrong_type};
use crate::fork;
use crate::prepared_array::{ARRAY, FIELDS, PreparedArray, sections_of_array};
use crate::warn::warn_sentence;
use asperity::error::{FileError, SetupError};
use asperity::formats::HeightFile;
use asperity::setup::Cost;
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Keys of the section `grid`; all others belong to the section `surface`.
const GRID_KEYS: [&str; 5] = ["points", "size", "boundary", "datum", "refine"];

/// A rigid surface: heights on a grid, with peaks towards the solid positive.
///
/// Surface(height, size, *, boundary="periodic", datum=None, refine=1, prepare=None) takes the heights of a line, shape (n), or of a surface, shape
/// (ny, nx), as lengths. `size` is the length of the cell, or the lengths along y and x; texts such as "160 um" become metres. The boundary
/// is "periodic" or "free", or one of these for each axis. `refine` is the number of points for each height along an axis; heights between
/// are interpolated. `prepare` is "auto", or a dictionary of steps, as of Surface.read; heights that are nan are void and can be filled.
/// Surface.read, Surface.rough, Surface.indenter and Surface.from_sections make other surfaces.
#[pyclass(frozen, module = "asperity")]
pub struct Surface {
    pub surface: Arc<asperity::Surface>,
    /// The sections `surface` and `grid` of a setup.
    pub sections: Sections,
    /// The number of axes of its arrays in Python.
    pub rank: usize,
    /// The steps of the preparation, each a sentence: why it was chosen, and what it did.
    pub preparation: Arc<[String]>,
}

impl Surface {
    /// A surface that some sections describe, with arrays of some rank.
    pub fn from_surface(surface: Arc<asperity::Surface>, sections: Sections, rank: usize) -> Self {
        Self { surface, sections, rank, preparation: Arc::default() }
    }

    /// The surface that some sections describe.
    fn made(py: Python<'_>, sections: Sections, exception: impl FnOnce(SetupError) -> PyErr) -> PyResult<Self> {
        let mut table = table_from_sections(&sections)?;
        table.check_numbers().map_err(py_error)?;
        let mut preparation = table.choose_preparation().map_err(py_error)?;
        let (recipe, cell) = table.surface().map_err(exception)?;
        let rank = recipe.rank(&cell).map_err(py_error)?;
        let grid = recipe.grid(&cell).map_err(py_error)?;
        Cost::from_fields(&grid, FIELDS).check("a surface").map_err(py_error)?;
        fork::check_not_forked()?;
        let surface = py.try_detached(|| recipe.surface(grid))?;
        for file in recipe.files().filter(|_| !recipe.prepare.is_none()) {
            preparation.extend(recipe.prepared(file, &grid).map_err(py_error)?.effects);
        }
        let preparation = preparation.iter().map(ToString::to_string).collect();
        Ok(Self { preparation, ..Self::from_surface(surface.into(), sections, rank) })
    }

    /// The surface of the keywords of a function, of which those that are not of the grid belong below `place`.
    fn from_keywords(
        py: Python<'_>,
        function: &str,
        keywords: Option<&Bound<'_, PyDict>>,
        place: &[&str],
        fixed: Sections,
    ) -> PyResult<Self> {
        let mut given = fixed;
        given.extend(sections_from_keywords(keywords)?);
        let mut made = Sections::new();
        section_mut(&mut made, "grid");
        for (key, value) in given {
            let path = match key.as_str() {
                "seed" => &["surface"][..],
                key if GRID_KEYS.contains(&key) => &["grid"],
                _ => place,
            };
            path.iter().fold(&mut made, |at, name| section_mut(at, name)).insert(key, value);
        }
        Self::made(py, made, |error| error_of_keywords(py, function, &["grid", &place.join(".")], error))
    }

    /// The surface in a file of a format that only the package SurfaceTopography reads, where that is installed. Keys that scale a file are not for
    /// such a file.
    fn read_elsewhere(py: Python<'_>, name: &str, mut cell: Sections) -> PyResult<Option<Self>> {
        let channel = cell.remove("channel").as_ref().and_then(Value::as_str).map(str::to_owned);
        let is_unread =
            matches!(HeightFile::from(PathBuf::from(name)).layout(channel.as_deref()), Err(FileError::Format { .. }));
        let is_known = |key: &String| key == "prepare" || GRID_KEYS.contains(&key.as_str());
        // a device may have no end
        if !is_unread || !Path::new(name).is_file() || !cell.keys().all(is_known) {
            return Ok(None);
        }
        let found = py.import("asperity.topography")?.call_method1("read", (name, channel))?;
        let Some((heights, lengths, sentence)) =
            found.extract::<Option<(Bound<'_, PyAny>, Option<Vec<f64>>, String)>>()?
        else {
            return Ok(None);
        };
        warn_sentence(py, &sentence)?;
        if let Some(lengths) = lengths {
            cell.entry("size").or_insert(json!(lengths));
        }
        Self::of_array(&ArrayLike::new(&heights, "height")?, cell).map(Some)
    }

    /// The surface of an array of heights on a cell.
    fn of_array(height: &ArrayLike<'_>, cell: Sections) -> PyResult<Self> {
        let PreparedArray { surface, sections, rank, preparation } = PreparedArray::new(height, cell)?;
        let preparation = preparation.iter().map(ToString::to_string).collect();
        Ok(Self { preparation, ..Self::from_surface(surface.into(), sections, rank) })
    }

    /// Whether the heights were given as an array, so that no file or recipe makes them.
    pub fn is_array(sections: &Sections) -> bool {
        sections.get("surface").and_then(|it| it.get("height")).is_some_and(|height| height == ARRAY)
    }
}

#[pymethods]
impl Surface {
    #[new]
    #[pyo3(signature = (height, size, **grid), text_signature = "(height, size, *, boundary='periodic', datum=None, refine=1, prepare=None)")]
    fn new(height: Bound<'_, PyAny>, size: Bound<'_, PyAny>, grid: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let height = ArrayLike::new(&height, "height")?;
        let mut grid = sections_from_keywords(grid)?;
        grid.insert("size".into(), value_from_py(&size, "size")?);
        Self::of_array(&height, grid)
    }

    /// The surface in a file of heights: a file of an instrument, .npy, .npz or text.
    ///
    /// A file that this package does not read is tried with the package SurfaceTopography where that is installed, and a warning says so.
    ///
    /// The keywords are keys of the sections `surface` and `grid` of a scene: size, boundary, datum, refine, channel, file_unit, height_unit, prepare,
    /// against. With prepare="auto" the program chooses the steps that the heights need; `preparation` states them. Steps of one's own are a
    /// dictionary: crop, level_rows, level_columns, outliers, scars, fill, detrend, remove_form, high_pass, low_pass, taper, mirror.
    #[staticmethod]
    #[pyo3(signature = (path, **keys), text_signature = "(path, *, size=None, channel=None, file_unit=None, height_unit=None, prepare=None, **grid)")]
    fn read(path: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let Value::String(name) = value_from_py(&path, "path")? else {
            return Err(wrong_type("path", "the name of a file", &path));
        };
        if let Some(it) = Self::read_elsewhere(path.py(), &name, sections_from_keywords(keys)?)? {
            return Ok(it);
        }
        let fixed = Sections::from_iter([("height".into(), name.into())]);
        Self::from_keywords(path.py(), "read", keys, &["surface"], fixed)
    }

    /// Random roughness: one realisation of a power spectrum, as that of van Dokkum et al. (2018), Eq. 10.
    ///
    /// `points` and `size` are those of the cell: numbers for a line, pairs along y and x for a surface. The spectrum is self-affine (`hurst`, above 0
    /// and at most 1, the lengths `rolloff_wavelength` and `short_cutoff`, and `rolloff_form`: "plateau", "drop" or "none"), or that of a file
    /// (`table`, `convention`). Each realisation is scaled to `rms_gradient` or `rms_height`; a table need not be scaled. A surface has a lay of
    /// the `peklenik` number at the `lay_angle` in degrees. Heights that are not Gaussian have a `skewness` and a `kurtosis`, or the
    /// distribution `weibull`, `beta` or `heights_like` a file; `exact` is "heights" or "spectrum". The same seed gives the same heights on every
    /// machine.
    #[staticmethod]
    #[pyo3(signature = (points, size, **keys), text_signature = "(points, size, *, seed=1, **spectrum_and_grid)")]
    fn rough(points: Bound<'_, PyAny>, size: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let fixed = cell(&points, &size)?;
        Self::from_keywords(points.py(), "rough", keys, &["surface", "spectrum"], fixed)
    }

    /// A smooth indenter in the centre of the cell.
    ///
    /// `shape` is "cylinder" or "sphere" (radius), "elliptic-paraboloid" (radius_x, radius_y), "sine" or "crossed-sine" (amplitude), "wedge", "cone" or
    /// "pyramid" (slope), "punch" (half_width, depth) or "power-law" (coefficient, exponent).
    #[staticmethod]
    #[pyo3(signature = (shape, points, size, **keys), text_signature = "(shape, points, size, **parameters)")]
    fn indenter(
        shape: Bound<'_, PyAny>,
        points: Bound<'_, PyAny>,
        size: Bound<'_, PyAny>,
        keys: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut fixed = cell(&points, &size)?;
        fixed.insert("shape".into(), argument::<String>(&shape, "shape", "the name of an indenter")?.into());
        Self::from_keywords(points.py(), "indenter", keys, &["surface", "indenter"], fixed)
    }

    /// The surface that the sections `surface` and `grid` of a scene describe, given as dictionaries.
    #[staticmethod]
    fn from_sections(surface: &Bound<'_, PyDict>, grid: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut made = Sections::new();
        made.insert("surface".into(), Value::Object(sections_from_dict(surface)?));
        made.insert("grid".into(), Value::Object(sections_from_dict(grid)?));
        Self::made(surface.py(), made, py_error)
    }

    /// Heights about their mean, a length: shape (n) or (ny, nx), shared and read-only.
    #[getter]
    fn height<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        let Self { surface, rank, .. } = slf.get();
        view(surface.height(), *rank, slf.clone().into_any())
    }

    /// The steps of the preparation, each a sentence: first the reasons of steps that prepare="auto" has chosen, then what each step did. It is
    /// empty without a preparation.
    #[getter]
    fn preparation(&self) -> Vec<String> {
        self.preparation.to_vec()
    }

    /// Mean of the heights as they were given, a length.
    #[getter]
    fn mean_height(&self) -> f64 {
        self.surface.mean_height()
    }

    /// Number of points along each axis.
    #[getter]
    fn shape<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyTuple::new(py, &self.surface.grid().shape()[2 - self.rank..])?.into_any())
    }

    /// Lengths of the cell along each axis.
    #[getter]
    fn size<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyTuple::new(py, &self.surface.grid().size()[2 - self.rank..])?.into_any())
    }

    /// Positions of the nodes along x, a length, from 0.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.surface.grid().x().collect())
    }

    /// Positions of the nodes along y, a length, from 0. A line has the single position 0.
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.surface.grid().y().collect())
    }

    /// The sum of two surfaces on the same grid, such as roughness on a sphere.
    fn __add__(&self, other: &Self) -> PyResult<Self> {
        if self.surface.grid() != other.surface.grid() {
            return bail("the surfaces have different grids: give the same points, size and boundary");
        }
        let mut grid = self.sections.get("grid").and_then(Value::as_object).cloned().unwrap_or_default();
        grid.remove("points");
        grid.insert("size".into(), json!(self.surface.grid().size()[2 - self.rank..]));
        let sections = sections_of_array(grid);
        Ok(Self::from_surface(self.surface.plus(&other.surface).into(), sections, self.rank))
    }

    fn __repr__(&self) -> String {
        let grid = self.surface.grid();
        let (shape, size) = (&grid.shape()[2 - self.rank..], &grid.size()[2 - self.rank..]);
        format!("Surface(shape={}, size={size:?}, {})", in_parentheses(shape), grid.boundary())
    }
}

/// The keys of a cell.
fn cell(points: &Bound<'_, PyAny>, size: &Bound<'_, PyAny>) -> PyResult<Sections> {
    let mut cell = Sections::new();
    cell.insert("points".into(), value_from_py(points, "points")?);
    cell.insert("size".into(), value_from_py(size, "size")?);
    Ok(cell)
}
