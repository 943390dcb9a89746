//! Rows of studies as columns, for numpy, pandas and all that speaks Arrow.

use crate::field::list;
use crate::refusal::refused;
use arrow::array::{ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray, UInt64Array};
use arrow::ffi_stream::FFI_ArrowArrayStream;
use asperity::study::{Column, Plan, Point, Values};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyIterator, PyList};
use std::sync::Arc;

/// The rows of a study as columns: what varies, the load, all that was found, and as `scene` the setup of each row.
///
/// table["kappa_r"] is a column as an array of numpy, dict(table) are all of them, and table.to_pandas() is a data frame. Whatever takes Arrow
/// takes the table as it is, such as pyarrow.table(table), polars.DataFrame(table) and pandas.DataFrame.from_arrow(table).
#[pyclass(frozen, mapping, module = "asperity")]
pub struct Table {
    columns: Vec<Column>,
    rows: usize,
}

impl Table {
    /// The table of all points of a study.
    pub fn of(plan: &Plan, points: &[Point]) -> PyResult<Self> {
        let all: Vec<usize> = (0..plan.realisations()).collect();
        let rows: Vec<_> = plan.rows_of(&all).collect();
        Ok(Self { columns: plan.columns(&rows, points).map_err(refused)?, rows: rows.len() })
    }
}

#[pymethods]
impl Table {
    /// Names of the columns.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        self.columns.iter().map(|column| column.name.as_str()).collect()
    }

    /// Names of the columns, as a dictionary has them.
    fn keys(&self) -> Vec<&str> {
        self.columns()
    }

    /// The table as a data frame of pandas.
    fn to_pandas<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let (py, columns) = (slf.py(), PyDict::new(slf.py()));
        for column in &slf.get().columns {
            columns.set_item(&column.name, array(py, &column.values)?)?;
        }
        py.import("pandas")?.call_method1("DataFrame", (columns,))
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.columns.iter().find(|column| column.name == name) {
            Some(column) => array(py, &column.values),
            None => {
                let names = self.columns().join(", ");
                Err(PyKeyError::new_err(format!("there is no column {name:?}: the columns are {names}")))
            }
        }
    }

    fn __contains__(&self, name: &str) -> bool {
        self.columns.iter().any(|column| column.name == name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.columns())?.try_iter()
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    /// The table as a stream of Arrow, by the interface of that name for capsules of Python.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        drop(requested_schema); // which says what is wished for, and need not be met
        let columns = self.columns.iter().map(|column| (&column.name, arrow(&column.values)));
        let rows = RecordBatch::try_from_iter(columns).map_err(refused)?;
        let schema = rows.schema();
        let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(rows)], schema)));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    fn __repr__(&self) -> String {
        format!("<asperity.Table of {} rows: {}>", self.rows, self.columns().join(", "))
    }
}

/// Values as an array of numpy. Whole numbers that are not all there become numbers.
fn array<'py>(py: Python<'py>, values: &Values) -> PyResult<Bound<'py, PyAny>> {
    Ok(match values {
        Values::Number(values) => numbers(py, values.iter().copied()),
        Values::Text(values) => py.import("numpy")?.call_method1("array", (values, "object"))?,
        Values::Whole(values) => match values.iter().copied().collect::<Option<Vec<u64>>>() {
            None => numbers(py, values.iter().map(|value| value.map(|value| value as f64))),
            Some(whole) => match whole.iter().map(|&value| i64::try_from(value)).collect::<Result<Vec<_>, _>>() {
                Ok(whole) => PyArray1::from_vec(py, whole).into_any(),
                Err(_) => PyArray1::from_vec(py, whole).into_any(),
            },
        },
    })
}

fn numbers<'py>(py: Python<'py>, values: impl Iterator<Item = Option<f64>>) -> Bound<'py, PyAny> {
    list(py, values.map(|value| value.unwrap_or(f64::NAN)).collect()).into_any()
}

/// Values as an array of Arrow.
fn arrow(values: &Values) -> ArrayRef {
    match values {
        Values::Whole(values) => Arc::new(UInt64Array::from(values.clone())),
        Values::Number(values) => Arc::new(Float64Array::from(values.clone())),
        Values::Text(values) => Arc::new(StringArray::from_iter_values(values)),
    }
}
