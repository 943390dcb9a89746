//! The cut below a solid that yields.

use crate::arrays::vector;
use crate::error::py_error;
use crate::history::History;
use asperity::contact::DepthCut;
use asperity::surface::Field;
use numpy::ndarray::{Axis, stack};
use numpy::{PyArray2, PyArray3, PyReadonlyArray2, ToPyArray};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The row, the interfaces, the plastic strain and the von Mises stress of a cut, as a pickle gives them.
pub type CutParts<'py> = (usize, Vec<f64>, PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>);

/// The same, as a pickle takes them.
pub type PickledCut<'py> = (usize, Vec<f64>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

/// The cut that the values of a pickle describe.
pub fn from_parts((row, interfaces, plastic_strain, von_mises): CutParts<'_>) -> DepthCut {
    let [plastic_strain, von_mises] = [plastic_strain, von_mises].map(|it| it.as_array().to_owned());
    DepthCut { row, interfaces, plastic_strain, von_mises }
}

/// The values of a cut for a pickle.
pub fn into_parts<'py>(cut: &DepthCut, py: Python<'py>) -> PickledCut<'py> {
    (cut.row, cut.interfaces.clone(), cut.plastic_strain.to_pyarray(py), cut.von_mises.to_pyarray(py))
}

#[pymethods]
impl History {
    /// The cut below the highest peak of a solid that yields below its surface: a dictionary with the row of the surface, the depths of the interfaces of the layers
    /// (one more than layers), and in the layers the accumulated plastic strain and the von Mises stress (a pressure), both of shape (states, layers,
    /// nx). None for other solids.
    #[getter]
    fn cut<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let cuts: Vec<&DepthCut> = self.outcome.states.iter().filter_map(|state| state.cut.as_ref()).collect();
        let Some(first) = cuts.first() else { return Ok(None) };
        let stacked = |of: fn(&DepthCut) -> &Field| -> PyResult<Bound<'py, PyArray3<f64>>> {
            let views: Vec<_> = cuts.iter().map(|cut| of(cut).view()).collect();
            let all = stack(Axis(0), &views).map_err(|error| py_error(error.to_string()))?;
            Ok(PyArray3::from_owned_array(py, all))
        };
        let found = PyDict::new(py);
        found.set_item("row", first.row)?;
        found.set_item("interfaces", vector(py, first.interfaces.clone()))?;
        found.set_item("plastic_strain", stacked(|cut| &cut.plastic_strain)?)?;
        found.set_item("von_mises", stacked(|cut| &cut.von_mises)?)?;
        Ok(Some(found))
    }
}
