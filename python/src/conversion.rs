//! Sections and keys of setups, converted from and to objects of Python.
//!
//! `pythonize` is not used: it knows neither the scalars of numpy and xarray nor paths, and it has no release for this version of pyo3.

use crate::error::{bail, py_error, wrong_type};
use asperity::setup::SetupTable;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// Sections and keys of a setup.
pub type Sections = Map<String, Value>;

/// Dictionaries and lists in each other at most: setups have 4.
const DEEPEST: usize = 16;
/// Values of an argument at most, as many as a path of a million states has.
const MOST: usize = 4_000_000;

/// The entries of a dictionary, with `-` for `_` in their names. Entries that are `None` are left out.
pub fn sections_from_dict(dict: &Bound<'_, PyDict>) -> PyResult<Sections> {
    ValueReader::default().sections(dict, 0)
}

/// The entries of keywords, which may be missing altogether.
pub fn sections_from_keywords(keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Sections> {
    keywords.map_or(Ok(Sections::new()), sections_from_dict)
}

fn key_from_py(key: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(key.extract::<String>().map_err(|_| wrong_type("a key", "a str", key))?.replace('_', "-"))
}

/// The value of the key `at`: a text, a truth value, a number, a path, a list or a dictionary. Scalars of numpy and xarray are numbers.
pub fn value_from_py(it: &Bound<'_, PyAny>, at: &str) -> PyResult<Value> {
    ValueReader::default().value(it, at, 0)
}

/// What reads an argument. Lists may have no end, and hold themselves.
#[derive(Default)]
struct ValueReader {
    /// The values so far.
    count: usize,
}

impl ValueReader {
    /// The entries of a dictionary that is in as many others as `depth`.
    fn sections(&mut self, dict: &Bound<'_, PyDict>, depth: usize) -> PyResult<Sections> {
        let mut sections = Sections::new();
        for (key, it) in dict.iter().filter(|(_, value)| !value.is_none()) {
            let key = key_from_py(&key)?;
            let value = self.value(&it, &key, depth + 1)?;
            sections.insert(key, value);
        }
        Ok(sections)
    }

    fn value(&mut self, it: &Bound<'_, PyAny>, at: &str, depth: usize) -> PyResult<Value> {
        self.count += 1;
        if depth > DEEPEST {
            let name = name_of(at);
            return bail(format!(
                "{name} has more than {DEEPEST} lists or dictionaries in each other: give a plain value"
            ));
        }
        if self.count > MOST {
            return bail(format!("{} has more than {MOST} values: give fewer", name_of(at)));
        }
        if let Ok(entries) = it.cast::<PyDict>() {
            return Ok(Value::Object(self.sections(entries, depth)?));
        }
        match scalar(it, at)? {
            Some(value) => Ok(value),
            None if is_scalar(it)? => self.value(&it.call_method0("item")?, at, depth + 1),
            None => self.list(it, at, depth),
        }
    }

    fn list(&mut self, it: &Bound<'_, PyAny>, at: &str, depth: usize) -> PyResult<Value> {
        if it.hasattr("__fspath__")? {
            return Ok(Value::String(it.call_method0("__fspath__")?.extract()?));
        }
        match it.try_iter() {
            Ok(items) => {
                Ok(Value::Array(items.map(|item| self.value(&item?, at, depth + 1)).collect::<PyResult<_>>()?))
            }
            Err(_) if it.hasattr("__float__")? => number(it.extract()?, at),
            Err(_) => bail(format!("{} is {}: give a number, a text, a list or a dictionary", name_of(at), it.repr()?)),
        }
    }
}

/// A text, a truth value or a number of Python, if it is one.
fn scalar(it: &Bound<'_, PyAny>, at: &str) -> PyResult<Option<Value>> {
    if it.is_instance_of::<PyString>() {
        let text: String = it.extract()?;
        // names of methods may be written like names of Python
        let is_name = matches!(at, "solver" | "method");
        return Ok(Some(Value::String(if is_name { text.replace('_', "-") } else { text })));
    }
    if it.is_instance_of::<PyBool>() {
        return Ok(Some(Value::Bool(it.extract()?)));
    }
    if it.is_instance_of::<PyInt>() {
        return match it.extract::<i64>() {
            Ok(whole) => Ok(Some(Value::from(whole))),
            Err(_) => bail(format!("{} is {it}: give a whole number of less than 64 bits", name_of(at))),
        };
    }
    if it.is_instance_of::<PyFloat>() { number(it.extract()?, at).map(Some) } else { Ok(None) }
}

/// Whether an object is an array without axes, such as a scalar of numpy or a DataArray of xarray that holds one number.
fn is_scalar(it: &Bound<'_, PyAny>) -> PyResult<bool> {
    Ok(it.hasattr("item")? && it.hasattr("ndim")? && it.getattr("ndim")?.extract::<usize>().is_ok_and(|axes| axes == 0))
}

fn number(number: f64, at: &str) -> PyResult<Value> {
    match serde_json::Number::from_f64(number) {
        Some(number) => Ok(Value::Number(number)),
        None => bail(format!("{} is {}: give a finite number", name_of(at), number.to_string().to_lowercase())),
    }
}

/// The name of a key in Python.
fn name_of(key: &str) -> String {
    key.replace('-', "_")
}

/// The table that some sections make, of which the solver may be a name alone, the solid a contact modulus, and the path the name of a table.
pub fn table_from_sections(sections: &Sections) -> PyResult<SetupTable> {
    let mut sections = sections.clone();
    for (section, key, may_be_number) in
        [("solver", "method", false), ("solid", "contact-modulus", true), ("path", "file", false)]
    {
        let is_alone = |it: &&mut Value| it.is_string() || may_be_number && it.is_number();
        if let Some(value) = sections.get_mut(section).filter(is_alone) {
            *value = json!({ key: value.take() });
        }
    }
    SetupTable::from_json(&Value::Object(sections).to_string()).map_err(py_error)
}

/// The sections of a setup or a table.
pub fn sections_of(described: &impl Serialize) -> Sections {
    match serde_json::to_value(described) {
        Ok(Value::Object(sections)) => sections,
        _ => Sections::new(),
    }
}

/// The section `name`, which is made if it is missing.
pub fn section_mut<'a>(sections: &'a mut Sections, name: &str) -> &'a mut Sections {
    let section = sections.entry(name).or_insert_with(|| Value::Object(Map::new()));
    if !section.is_object() {
        *section = Value::Object(Map::new());
    }
    section.as_object_mut().expect("an object was just put there")
}

/// Whatever can be written as JSON, as dictionaries and lists of Python.
pub fn to_python<'py>(py: Python<'py>, it: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(it).map_err(py_error)?;
    py.import("json")?.call_method1("loads", (text,))
}
