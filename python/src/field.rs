//! Fields out of and into numpy.

use crate::refusal::refused;
use asperity::error::ClaimError;
use asperity::surface::Field;
use numpy::ndarray::{ArrayD, ArrayView2, Axis, Ix2};
use numpy::{AllowTypeChange, PyArray1, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::Borrowed;
use pyo3::prelude::*;
use std::ops::Deref;

/// An array of numpy, or what numpy makes one of. Values that are masked are void, and refused.
pub struct Given<'py>(PyArrayLikeDyn<'py, f64, AllowTypeChange>);

impl<'py> Deref for Given<'py> {
    type Target = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Given<'py> {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let masks = given.py().import("numpy.ma")?;
        if given.is_instance(&masks.getattr("MaskedArray")?)? {
            let masked: usize = masks.call_method1("count_masked", (given,))?.extract()?;
            if masked > 0 {
                let all: usize = given.getattr("size")?.extract()?;
                return Err(refused(format!("{masked} of {all} values are masked: fill them or crop them away")));
            }
        }
        Ok(Self(given.extract()?))
    }
}

/// Rows and columns of an array, copied once; one of a single axis is a row.
pub fn rows(given: &Given<'_>) -> PyResult<Field> {
    let array = given.as_array().to_owned();
    let array = if array.ndim() == 1 { array.insert_axis(Axis(0)) } else { array };
    let shape = array.shape().to_vec();
    array.into_dimensionality::<Ix2>().map_err(|_| {
        refused(format!("an array of shape {shape:?} is neither a line nor a surface: give one or two axes"))
    })
}

/// Rows and columns of an array of finite numbers that fit a grid of some shape.
pub fn rows_on(given: &Given<'_>, expected: [usize; 2], quantity: &'static str) -> PyResult<Field> {
    let field = rows(given)?;
    let found: [usize; 2] = field.dim().into();
    if found != expected {
        let is_transposed = found == [expected[1], expected[0]];
        return Err(refused(ClaimError::Shape { quantity, found: given.shape().to_vec(), expected, is_transposed }));
    }
    match field.indexed_iter().find(|(_, value)| !value.is_finite()) {
        Some(((row, column), &value)) => Err(refused(ClaimError::NonFinite { quantity, index: [row, column], value })),
        None => Ok(field),
    }
}

/// A field of an object that never changes, as an array of numpy that shares its memory, keeps the object alive and cannot be written.
pub fn shared<'py>(field: &Field, rank: usize, owner: Bound<'py, PyAny>) -> Bound<'py, PyArrayDyn<f64>> {
    let rows: ArrayView2<'_, f64> = field.view();
    let view = if rank == 1 { rows.index_axis(Axis(0), 0).into_dyn() } else { rows.into_dyn() };
    // SAFETY: the owner, a frozen class, holds the field and is kept alive by the array, and nobody can write through it
    #[allow(unsafe_code)]
    let array = unsafe { PyArrayDyn::borrow_from_array(&view, owner) };
    array.readwrite().make_nonwriteable();
    array
}

/// A new field, row by row, as an array of numpy that takes its memory over.
pub fn taken<'py>(py: Python<'py>, values: Vec<f64>, shape: [usize; 2], rank: usize) -> Bound<'py, PyArrayDyn<f64>> {
    let shape = if rank == 1 { vec![shape[0] * shape[1]] } else { shape.to_vec() };
    let array = ArrayD::from_shape_vec(shape, values).expect("one value per node");
    PyArrayDyn::from_owned_array(py, array)
}

/// A list of numbers as an array of numpy that takes its memory over.
pub fn list(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    PyArray1::from_vec(py, values)
}

/// A function of a number, or of each number of an array.
pub fn over<'py>(py: Python<'py>, of: &Given<'py>, function: impl Fn(f64) -> f64) -> PyResult<Bound<'py, PyAny>> {
    let values = of.as_array().mapv(function);
    match values.ndim() {
        0 => Ok(values.sum().into_pyobject(py)?.into_any()),
        _ => Ok(PyArrayDyn::from_owned_array(py, values).into_any()),
    }
}
