//! Arrays of numpy, as fields of the library and made from them.

use crate::error::{bail, wrong_type};
use asperity::setup::check_room;
use asperity::surface::Field;
use numpy::ndarray::{ArrayD, ArrayView2, Axis, Ix2};
use numpy::{AllowTypeChange, Element, PyArray1, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::Borrowed;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::ops::Deref;

/// An array of numpy, or anything that numpy converts to an array. An array with masked values is refused.
pub struct ArrayLike<'py>(PyArrayLikeDyn<'py, f64, AllowTypeChange>);

impl<'py> Deref for ArrayLike<'py> {
    type Target = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

/// Axes of an array at most.
const MOST_AXES: usize = 32;
/// Values for which there is always memory.
const FEW: f64 = 1e6;
/// Bytes that each value needs: as a double, and as a double of a field.
const BYTES: f64 = 16.0;

impl<'py> ArrayLike<'py> {
    /// The argument `name` as an array.
    pub fn new(given: &Bound<'py, PyAny>, name: &str) -> PyResult<Self> {
        check_shape(&stated_shape(given, name)?)?;
        let masks = given.py().import("numpy.ma")?;
        if given.is_instance(&masks.getattr("MaskedArray")?)? {
            let masked: usize = masks.call_method1("count_masked", (given,))?.extract()?;
            if masked > 0 {
                let all: usize = given.getattr("size")?.extract()?;
                return bail(format!("{masked} of {all} values are masked: fill them, or crop the array"));
            }
        }
        let numpy = given.py().import("numpy")?;
        if numpy.call_method1("iscomplexobj", (given,))?.extract()? {
            let sentence = format!("{name} is complex: give real numbers, such as its real part");
            return Err(PyTypeError::new_err(sentence));
        }
        // values between others, as those of a column of records, may lie anywhere
        let aligned = numpy.call_method1("require", (given, "f8", ("C", "A")));
        match aligned.and_then(|array| array.extract()) {
            Ok(array) => Ok(Self(array)),
            Err(_) => Err(wrong_type(name, "an array of numbers", given)),
        }
    }
}

/// The shape that an argument states: that of an array, or the lengths of lists in lists.
fn stated_shape(given: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<usize>> {
    if let Ok(shape) = given.getattr("shape").and_then(|shape| shape.extract::<Vec<usize>>()) {
        return Ok(shape);
    }
    let (mut shape, mut inner) = (Vec::new(), given.clone());
    while let Ok(length) = inner.len() {
        shape.push(length);
        match inner.get_item(0) {
            Ok(_) if shape.len() > MOST_AXES => return Err(wrong_type(name, "an array of numbers", given)),
            Ok(first) => inner = first,
            Err(_) => break,
        }
    }
    Ok(shape)
}

/// Refuses an array with too many axes, or one that does not fit in memory, before anything is copied.
fn check_shape(shape: &[usize]) -> PyResult<()> {
    let axes = shape.len();
    if axes > MOST_AXES {
        return bail(format!("an array has {axes} axes: give one with at most {MOST_AXES}"));
    }
    let values: f64 = shape.iter().map(|length| *length as f64).product();
    if values <= FEW {
        return Ok(());
    }
    check_room(BYTES * values).or_else(|room| {
        let shape = in_parentheses(shape);
        bail(format!("an array of shape {shape} does not fit in memory: it needs {room}: give fewer values"))
    })
}

impl<'a, 'py> FromPyObject<'a, 'py> for ArrayLike<'py> {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        Self::new(&given, "the argument")
    }
}

/// A copy of an array as a field of rows and columns. An array with one axis becomes one row.
pub fn field(given: &ArrayLike<'_>) -> PyResult<Field> {
    let array = given.as_array().to_owned();
    let array = if array.ndim() == 1 { array.insert_axis(Axis(0)) } else { array };
    match *array.shape() {
        [rows, 1] if rows > 1 => {
            bail(format!("an array of shape ({rows}, 1) is a column: give a line as shape ({rows},)"))
        }
        [_, _] => Ok(array.into_dimensionality::<Ix2>().expect("two axes")),
        [] => bail("a single number is neither a line nor a surface: give an array with one or two axes"),
        ref shape => {
            let shape = in_parentheses(shape);
            bail(format!("an array of shape {shape} is neither a line nor a surface: give one or two axes"))
        }
    }
}

/// A copy of an array of finite numbers that fits a grid.
pub fn field_on(given: &ArrayLike<'_>, expected: [usize; 2], quantity: &str) -> PyResult<Field> {
    let field = field(given)?;
    let found: [usize; 2] = field.dim().into();
    if found != expected {
        let remedy = match found == [expected[1], expected[0]] {
            true => "it is transposed, give the transpose",
            false => "give one value for each height",
        };
        let axes = usize::from(expected[0] == 1);
        let [found, expected] = [given.shape(), &expected[axes..]].map(in_parentheses);
        return bail(format!(
            "the {quantity} has the shape {found} and does not fit heights of shape {expected}: {remedy}"
        ));
    }
    check_finite(&field, quantity)?;
    Ok(field)
}

/// Refuses a field with a number that is infinite, or not a number.
pub fn check_finite(field: &Field, quantity: &str) -> PyResult<()> {
    let Some(((row, column), value)) = field.indexed_iter().find(|(_, value)| !value.is_finite()) else {
        return Ok(());
    };
    let index = if field.nrows() == 1 { format!("{column}") } else { format!("({row}, {column})") };
    let value = value.to_string().to_lowercase();
    bail(format!("the {quantity} at index {index} is {value}: all values must be finite"))
}

/// A shape as Python writes it, such as `(3,)`.
pub fn in_parentheses(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        more => format!("({})", more.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// A field of an object that never changes, as an array of numpy that shares its memory, keeps the object alive and is read-only.
pub fn view<'py>(field: &Field, rank: usize, owner: Bound<'py, PyAny>) -> Bound<'py, PyArrayDyn<f64>> {
    let rows: ArrayView2<'_, f64> = field.view();
    let view = if rank == 1 { rows.index_axis(Axis(0), 0).into_dyn() } else { rows.into_dyn() };
    // SAFETY: the owner, a frozen class, holds the field and is kept alive by the array, and nobody can write through it
    #[allow(unsafe_code)]
    let array = unsafe { PyArrayDyn::borrow_from_array(&view, owner) };
    array.readwrite().make_nonwriteable();
    array
}

/// Values of all nodes, row by row, as a new array of numpy.
pub fn owned<T: Element>(py: Python<'_>, values: Vec<T>, shape: [usize; 2], rank: usize) -> Bound<'_, PyArrayDyn<T>> {
    let shape = if rank == 1 { vec![shape[0] * shape[1]] } else { shape.to_vec() };
    let array = ArrayD::from_shape_vec(shape, values).expect("one value per node");
    PyArrayDyn::from_owned_array(py, array)
}

/// Numbers as a new array of numpy.
pub fn vector(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    PyArray1::from_vec(py, values)
}

/// A function of a number, or of each number of an array.
pub fn map<'py>(py: Python<'py>, of: &ArrayLike<'py>, function: impl Fn(f64) -> f64) -> PyResult<Bound<'py, PyAny>> {
    let values = of.as_array().mapv(function);
    match values.ndim() {
        0 => Ok(values.sum().into_pyobject(py)?.into_any()),
        _ => Ok(PyArrayDyn::from_owned_array(py, values).into_any()),
    }
}
