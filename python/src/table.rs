//! Rows of studies as columns, for numpy, pandas and every library that reads Arrow.

use crate::arrays::vector;
use crate::error::{bail, py_error, unknown_name};
use arrow::array::{ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray, UInt64Array};
use arrow::ffi_stream::FFI_ArrowArrayStream;
use asperity::study::{Column, ColumnValues, Plan, Point};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyIterator, PyList};
use std::sync::Arc;

/// The rows of a study as columns: the values from the lists, the load, all results, and as `scene` the setup of each row.
///
/// table["kappa_r"] is a column as an array of numpy, dict(table) holds all columns, and table.to_pandas() is a data frame. Every library that
/// reads Arrow reads the table, as in pyarrow.table(table), polars.DataFrame(table) and pandas.DataFrame.from_arrow(table).
#[pyclass(frozen, mapping, module = "asperity")]
pub struct Table {
    columns: Vec<Column>,
    rows: usize,
}

/// A column in a pickle: its name, the kind of its values, and the values.
type PickledColumn<'py> = (String, String, Bound<'py, PyAny>);

impl Table {
    /// The table of all points of a study.
    pub fn new(plan: &Plan, points: &[Point]) -> PyResult<Self> {
        let all: Vec<usize> = (0..plan.realisations()).collect();
        let rows: Vec<_> = plan.rows_of(&all).collect();
        Ok(Self { columns: plan.columns(&rows, points).map_err(py_error)?, rows: rows.len() })
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

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("table_as_html", (slf,))
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.columns.iter().find(|column| column.name == name) {
            Some(column) => array(py, &column.values),
            None => Err(unknown_name(py, "column", name, &self.columns())),
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

    /// The table as a stream of Arrow, by the PyCapsule interface of Arrow.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        drop(requested_schema); // a request that need not be met
        let columns = self.columns.iter().map(|column| (&column.name, arrow(&column.values)));
        let rows = RecordBatch::try_from_iter(columns).map_err(py_error)?;
        let schema = rows.schema();
        let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(rows)], schema)));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    fn __eq__(&self, other: &Self) -> bool {
        let is_same = |(one, two): (&Column, &Column)| one.name == two.name && is_identical(&one.values, &two.values);
        self.columns.len() == other.columns.len() && self.columns.iter().zip(&other.columns).all(is_same)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Vec<PickledColumn<'py>>,))> {
        let py = slf.py();
        let columns = slf.get().columns.iter().map(|Column { name, values }| {
            let (kind, values) = match values {
                ColumnValues::Whole(values) => ("whole", PyList::new(py, values)?),
                ColumnValues::Number(values) => ("number", PyList::new(py, values)?),
                ColumnValues::Text(values) => ("text", PyList::new(py, values)?),
            };
            Ok((name.clone(), kind.to_owned(), values.into_any()))
        });
        Ok((slf.get_type().getattr("_from_columns")?, (columns.collect::<PyResult<_>>()?,)))
    }

    /// The table that the values of a pickle describe.
    #[staticmethod]
    fn _from_columns(columns: Vec<PickledColumn<'_>>) -> PyResult<Self> {
        let columns = columns.into_iter().map(|(name, kind, values)| {
            let values = match kind.as_str() {
                "whole" => ColumnValues::Whole(values.extract()?),
                "number" => ColumnValues::Number(values.extract()?),
                "text" => ColumnValues::Text(values.extract()?),
                other => return bail(format!("there is no kind {other:?} of columns: give whole, number or text")),
            };
            Ok(Column { name, values })
        });
        let columns = columns.collect::<PyResult<Vec<_>>>()?;
        let rows = columns.first().map_or(0, |column| column.values.len());
        Ok(Self { columns, rows })
    }

    fn __repr__(&self) -> String {
        format!("<asperity.Table of {} rows: {}>", self.rows, self.columns().join(", "))
    }
}

/// Values as an array of numpy. Whole numbers become floating-point numbers if some of them are missing.
fn array<'py>(py: Python<'py>, values: &ColumnValues) -> PyResult<Bound<'py, PyAny>> {
    Ok(match values {
        ColumnValues::Number(values) => numbers(py, values.iter().copied()),
        ColumnValues::Text(values) => py.import("numpy")?.call_method1("array", (values, "object"))?,
        ColumnValues::Whole(values) => match values.iter().copied().collect::<Option<Vec<u64>>>() {
            None => numbers(py, values.iter().map(|value| value.map(|value| value as f64))),
            Some(whole) => match whole.iter().map(|&value| i64::try_from(value)).collect::<Result<Vec<_>, _>>() {
                Ok(whole) => PyArray1::from_vec(py, whole).into_any(),
                Err(_) => PyArray1::from_vec(py, whole).into_any(),
            },
        },
    })
}

fn numbers<'py>(py: Python<'py>, values: impl Iterator<Item = Option<f64>>) -> Bound<'py, PyAny> {
    vector(py, values.map(|value| value.unwrap_or(f64::NAN)).collect()).into_any()
}

/// Whether values are the same to the last bit, so that a number that is not a number is the same as another one.
fn is_identical(one: &ColumnValues, two: &ColumnValues) -> bool {
    let bits = |values: &[Option<f64>]| -> Vec<_> { values.iter().map(|it| it.map(f64::to_bits)).collect() };
    match (one, two) {
        (ColumnValues::Number(one), ColumnValues::Number(two)) => bits(one) == bits(two),
        (one, two) => one == two,
    }
}

/// Values as an array of Arrow.
fn arrow(values: &ColumnValues) -> ArrayRef {
    match values {
        ColumnValues::Whole(values) => Arc::new(UInt64Array::from(values.clone())),
        ColumnValues::Number(values) => Arc::new(Float64Array::from(values.clone())),
        ColumnValues::Text(values) => Arc::new(StringArray::from_iter_values(values)),
    }
}
