//! The cut below a solid that yields.

use crate::arrays::vector;
use crate::error::py_error;
use crate::history::History;
use numpy::PyArray3;
use numpy::ndarray::{Axis, stack};
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl History {
    /// The cut below the highest peak of a solid that yields below its surface: a dictionary with the row of the surface, the depths of the interfaces of the layers
    /// (one more than layers), and in the layers the accumulated plastic strain and the von Mises stress (a pressure), both of shape (states, layers,
    /// nx). None for other solids.
    #[getter]
    fn cut<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let states = &self.outcome.states;
        let Some(first) = states.first() else { return Ok(None) };
        let Some(layers) = &first.layers else { return Ok(None) };
        let found = PyDict::new(py);
        found.set_item("row", layers.row)?;
        found.set_item("interfaces", vector(py, layers.interfaces.clone()))?;
        for field in first.fields.iter().filter(|field| !field.is_on_surface()) {
            let of_states = states.iter().filter_map(|state| state.field(field.kind));
            let views: Vec<_> = of_states.map(|values| values.view()).collect();
            let all = stack(Axis(0), &views).map_err(|error| py_error(error.to_string()))?;
            found.set_item(field.name(), PyArray3::from_owned_array(py, all))?;
        }
        Ok(Some(found))
    }
}
