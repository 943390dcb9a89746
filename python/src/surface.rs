//! Rigid surfaces.

use crate::arrays::{ArrayLike, check_finite, field, in_parentheses, vector, view};
use crate::conversion::{
    Sections, section_mut, sections_from_dict, sections_from_keywords, table_from_sections, to_python, value_from_py,
};
use crate::error::{argument, bail, error_of_keywords, py_error, wrong_type};
use crate::fork;
use asperity::Grid;
use asperity::error::SetupError;
use asperity::setup::Cost;
use asperity::surface::{Plateaus, PowerSpectrum, Roughness, SurfaceParameter, SurfaceParameters};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::{Value, json};
use std::sync::Arc;

/// The name of the height file in the setup of a surface that was given as an array.
const ARRAY: &str = "array.npy";

/// Fields in memory while a surface is made.
const FIELDS: f64 = 4.0;

/// Keys of the section `grid`; all others belong to the section `surface`.
const GRID_KEYS: [&str; 5] = ["points", "size", "boundary", "datum", "refine"];

/// A rigid surface: heights on a grid, with peaks towards the solid positive.
///
/// Surface(height, size, *, boundary="periodic", datum=None, refine=1) takes the heights of a line, shape (n), or of a surface, shape
/// (ny, nx), as lengths. `size` is the length of the cell, or the lengths along y and x; texts such as "160 um" become metres. The boundary
/// is "periodic" or "free", or one of these for each axis. `refine` is the number of points for each height along an axis; heights between
/// are interpolated. Surface.read, Surface.rough, Surface.indenter and Surface.from_sections make other surfaces.
#[pyclass(frozen, module = "asperity")]
pub struct Surface {
    pub surface: Arc<asperity::Surface>,
    /// The sections `surface` and `grid` of a setup.
    pub sections: Sections,
    /// The number of axes of its arrays in Python.
    pub rank: usize,
}

/// The values that make a surface again: heights about their mean, mean, lengths and periodicity along y and x, seed, plateaus, the sections
/// as JSON, and the rank.
type SurfaceParts<'py> = (
    Bound<'py, PyArrayDyn<f64>>,
    f64,
    [f64; 2],
    [bool; 2],
    Option<u64>,
    Option<([usize; 2], usize, Vec<bool>)>,
    String,
    usize,
);

impl Surface {
    /// The surface that some sections describe.
    fn made(py: Python<'_>, sections: Sections, exception: impl FnOnce(SetupError) -> PyErr) -> PyResult<Self> {
        let (recipe, cell) = table_from_sections(&sections)?.surface().map_err(exception)?;
        let rank = recipe.rank(&cell).map_err(py_error)?;
        let grid = recipe.grid(&cell).map_err(py_error)?;
        Cost::from_fields(&grid, FIELDS).check("a surface").map_err(py_error)?;
        fork::check_not_forked()?;
        let surface = py.detach(|| recipe.surface(grid)).map_err(py_error)?;
        Ok(Self { surface: surface.into(), sections, rank })
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

    /// The sections of a surface that is an array on a grid.
    fn sections_of_array(grid: Sections) -> Sections {
        let mut sections = Sections::new();
        section_mut(&mut sections, "surface").insert("height".into(), ARRAY.into());
        sections.insert("grid".into(), Value::Object(grid));
        sections
    }

    /// Whether the heights were given as an array, so that no file or recipe makes them.
    pub fn is_array(sections: &Sections) -> bool {
        sections.get("surface").and_then(|it| it.get("height")).is_some_and(|height| height == ARRAY)
    }
}

#[pymethods]
impl Surface {
    #[new]
    #[pyo3(signature = (height, size, **grid), text_signature = "(height, size, *, boundary='periodic', datum=None, refine=1)")]
    fn new(height: Bound<'_, PyAny>, size: Bound<'_, PyAny>, grid: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let height = ArrayLike::new(&height, "height")?;
        let (rank, field) = (height.as_array().ndim(), field(&height)?);
        check_finite(&field, "height")?;
        let mut grid = sections_from_keywords(grid)?;
        grid.insert("size".into(), value_from_py(&size, "size")?);
        let mut sized = Self::sections_of_array(grid.clone());
        section_mut(&mut sized, "grid").insert("points".into(), json!(&field.shape()[2 - rank.clamp(1, 2)..]));
        let described = table_from_sections(&sized)?.surface();
        let (_, mut cell) = described.map_err(|error| error_of_keywords(height.py(), "Surface", &["grid"], error))?;
        let fine = cell.grid().map_err(py_error)?;
        Cost::from_fields(&fine, FIELDS).check("a surface").map_err(py_error)?;
        let factor = cell.refine.take().unwrap_or(1);
        let coarse = cell.grid().map_err(py_error)?;
        fork::check_not_forked()?;
        let made = || asperity::Surface::new(coarse, field)?.refined(factor);
        let surface = height.py().detach(made).map_err(py_error)?;
        Ok(Self { surface: surface.into(), sections: Self::sections_of_array(grid), rank })
    }

    /// The surface in a file of heights: a file of an instrument, .npy, .npz or text.
    ///
    /// The keywords are keys of the sections `surface` and `grid` of a scene: size, boundary, datum, refine, channel, file_unit, prepare,
    /// against. With prepare="auto" the program chooses the steps that the heights need.
    #[staticmethod]
    #[pyo3(signature = (path, **keys), text_signature = "(path, *, size=None, channel=None, file_unit=None, prepare=None, **grid)")]
    fn read(path: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut fixed = Sections::new();
        match value_from_py(&path, "path")? {
            name @ Value::String(_) => fixed.insert("height".into(), name),
            _ => return Err(wrong_type("path", "the name of a file", &path)),
        };
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
    /// `shape` is "cylinder" or "sphere" (radius), "sine" or "crossed-sine" (amplitude), "wedge" or "cone" (slope), "punch" (half_width, depth)
    /// or "power-law" (coefficient, exponent).
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

    /// Statistics of the heights: rms_height, peak, valley (lengths), rms_gradient, rms_curvature (1/length), skewness, kurtosis.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let roughness = py.detach(|| Roughness::new(&self.surface));
        to_python(py, &roughness)
    }

    /// Parameters of texture by their symbols, as of ISO 25178-2 for maps (Sa, Sq, Sal, Str, ...) and ISO 21920-2 for lines (Pa, Pq, ...), with
    /// correlation_length_x, correlation_length_y and peklenik. A value is None where it is not defined. Axes along which the heights jump are
    /// taken as free.
    fn texture<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = py.detach(|| SurfaceParameters::new(&self.surface));
        by_key(py, &parameters.texture, |it| it.value)
    }

    /// Spectral moments m0 (length^2), m2 and m4 (1/length^2), also along each axis, and Nayak's parameter (nayak), by the spectrum. Axes
    /// along which the heights jump are taken as free.
    fn moments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = py.detach(|| SurfaceParameters::new(&self.surface));
        by_key(py, &parameters.moments, |it| it.value)
    }

    /// Standard errors of what texture() and moments() return, under the same keys. The surface is taken as a sample of a larger one that is
    /// everywhere alike: the errors mean nothing for an indenter. A value is None where the error is not known.
    fn sampling_errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let SurfaceParameters { texture, moments, .. } = py.detach(|| SurfaceParameters::new(&self.surface));
        by_key(py, texture.iter().chain(&moments), |it| it.error)
    }

    /// How random heights got a distribution that is not Gaussian: rounds, spectrum_error and height_error. None for other surfaces.
    #[getter]
    fn rank_map<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.surface.rank_map().map(|map| to_python(py, map)).transpose()
    }

    /// Power spectrum of the heights: wavenumbers 2 pi / wavelength (1/length), and densities, length^3 of a line, length^4 of a surface.
    fn spectrum<'py>(&self, py: Python<'py>) -> [Bound<'py, PyArray1<f64>>; 2] {
        let PowerSpectrum { wavenumber, density, .. } = py.detach(|| PowerSpectrum::new(&self.surface));
        [vector(py, wavenumber), vector(py, density)]
    }

    /// The sum of two surfaces on the same grid, such as roughness on a sphere.
    fn __add__(&self, other: &Self) -> PyResult<Self> {
        if self.surface.grid() != other.surface.grid() {
            return bail("the surfaces have different grids: give the same points, size and boundary");
        }
        let mut grid = self.sections.get("grid").and_then(Value::as_object).cloned().unwrap_or_default();
        grid.remove("points");
        grid.insert("size".into(), json!(self.surface.grid().size()[2 - self.rank..]));
        let sections = Self::sections_of_array(grid);
        Ok(Self { surface: self.surface.plus(&other.surface).into(), sections, rank: self.rank })
    }

    /// The heights as a DataArray of xarray over the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("surface_to_xarray", (slf,))
    }

    /// A figure of the heights by matplotlib: a curve for a line, a map for a surface.
    fn plot<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("plot_surface", (slf,))
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("surface_as_html", (slf,))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.rank == other.rank && self.surface == other.surface
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, SurfaceParts<'py>)> {
        let Self { surface, sections, rank } = slf.get();
        let grid = surface.grid();
        let plateaus = surface.plateaus().map(|it| (it.shape, it.factor, it.nodes.to_vec()));
        let sections = Value::Object(sections.clone()).to_string();
        let height = view(surface.height(), *rank, slf.clone().into_any());
        let parts =
            (height, surface.mean_height(), grid.size(), grid.periodic(), surface.seed(), plateaus, sections, *rank);
        Ok((slf.get_type().getattr("_from_parts")?, parts))
    }

    /// The surface that the values of a pickle describe.
    #[staticmethod]
    #[pyo3(signature = (height, mean_height, size, periodic, seed, plateaus, sections, rank))]
    #[allow(clippy::too_many_arguments, reason = "these are the parts of a pickle")]
    fn _from_parts(
        height: ArrayLike<'_>,
        mean_height: f64,
        size: [f64; 2],
        periodic: [bool; 2],
        seed: Option<u64>,
        plateaus: Option<([usize; 2], usize, Vec<bool>)>,
        sections: &str,
        rank: usize,
    ) -> PyResult<Self> {
        let field = field(&height)?;
        let [ny, nx] = field.dim().into();
        let grid = if ny == 1 { Grid::line(nx, size[1]) } else { Grid::surface([ny, nx], size) };
        let grid = grid.map_err(py_error)?.with_periodic(periodic);
        let plateaus = plateaus.map(|(shape, factor, nodes)| Plateaus { shape, factor, nodes: nodes.into() });
        let surface = asperity::Surface::from_parts(grid, field, mean_height, seed, plateaus).map_err(py_error)?;
        let sections = serde_json::from_str(sections).map_err(py_error)?;
        Ok(Self { surface: surface.into(), sections, rank })
    }

    fn __repr__(&self) -> String {
        let grid = self.surface.grid();
        let (shape, size) = (&grid.shape()[2 - self.rank..], &grid.size()[2 - self.rank..]);
        format!("Surface(shape={}, size={size:?}, {})", in_parentheses(shape), grid.boundary())
    }
}

/// Numbers of parameters by their keys.
fn by_key<'py, 'a>(
    py: Python<'py>,
    parameters: impl IntoIterator<Item = &'a SurfaceParameter>,
    number: fn(&SurfaceParameter) -> Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    parameters.into_iter().try_for_each(|it| found.set_item(&it.key, number(it)))?;
    Ok(found)
}

/// The keys of a cell.
fn cell(points: &Bound<'_, PyAny>, size: &Bound<'_, PyAny>) -> PyResult<Sections> {
    let mut cell = Sections::new();
    cell.insert("points".into(), value_from_py(points, "points")?);
    cell.insert("size".into(), value_from_py(size, "size")?);
    Ok(cell)
}
