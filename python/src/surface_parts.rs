//! Copies, comparisons and pickles of surfaces.

use crate::arrays::{ArrayLike, field, view};
use crate::error::py_error;
use crate::surface::Surface;
use asperity::Grid;
use asperity::surface::Plateaus;
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use serde_json::Value;

/// The shape, the factor and the nodes of plateaus.
type PlateausParts = ([usize; 2], usize, Vec<bool>);

/// The values that make a surface again: heights about their mean, mean, lengths and periodicity along y and x, seed, plateaus and preparation, the
/// sections as JSON, and the rank.
type SurfaceParts<'py> = (
    Bound<'py, PyArrayDyn<f64>>,
    f64,
    ([f64; 2], [bool; 2]),
    (Option<u64>, Option<PlateausParts>, Vec<String>),
    String,
    usize,
);

#[pymethods]
impl Surface {
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
        let Self { surface, sections, rank, preparation } = slf.get();
        let grid = surface.grid();
        let plateaus = surface.plateaus().map(|it| (it.shape, it.factor, it.nodes.to_vec()));
        let sections = Value::Object(sections.clone()).to_string();
        let height = view(surface.height(), *rank, slf.clone().into_any());
        let cell = (grid.size(), grid.periodic());
        let made = (surface.seed(), plateaus, preparation.to_vec());
        let parts = (height, surface.mean_height(), cell, made, sections, *rank);
        Ok((slf.get_type().getattr("_from_parts")?, parts))
    }

    /// The surface that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(
        height: ArrayLike<'_>,
        mean_height: f64,
        cell: ([f64; 2], [bool; 2]),
        made: (Option<u64>, Option<PlateausParts>, Vec<String>),
        sections: &str,
        rank: usize,
    ) -> PyResult<Self> {
        let ((size, periodic), (seed, plateaus, preparation)) = (cell, made);
        let field = field(&height)?;
        let [ny, nx] = field.dim().into();
        let grid = if ny == 1 { Grid::line(nx, size[1]) } else { Grid::surface([ny, nx], size) };
        let grid = grid.map_err(py_error)?.with_periodic(periodic);
        let plateaus = plateaus.map(|(shape, factor, nodes)| Plateaus { shape, factor, nodes: nodes.into() });
        let surface = asperity::Surface::from_parts(grid, field, mean_height, seed, plateaus).map_err(py_error)?;
        let sections = serde_json::from_str(sections).map_err(py_error)?;
        let preparation = preparation.into();
        Ok(Self { preparation, ..Self::from_surface(surface.into(), sections, rank) })
    }
}
