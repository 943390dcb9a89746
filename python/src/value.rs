//! Sections and keys of setups, out of and into Python.

use crate::refusal::{refuse, refused};
use asperity::setup::{Setup, Table};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use serde_json::{Map, Value};

/// Sections and keys on their way to a setup.
pub type Sections = Map<String, Value>;

/// The entries of a dictionary, with `-` for `_` in their names; those that are `None` are left out.
pub fn sections(of: &Bound<'_, PyDict>) -> PyResult<Sections> {
    let given = of.iter().filter(|(_, value)| !value.is_none());
    given.map(|(key, it)| Ok((name(&key)?, value(&it, &name(&key)?)?))).collect()
}

/// The name of a key.
fn name(key: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(key.extract::<String>()?.replace('_', "-"))
}

/// What stands at the key `at`: text, truth, a number (of numpy as well), a path, a list or a dictionary.
pub fn value(it: &Bound<'_, PyAny>, at: &str) -> PyResult<Value> {
    if let Ok(entries) = it.cast::<PyDict>() {
        return Ok(Value::Object(sections(entries)?));
    }
    if it.is_instance_of::<PyString>() {
        return Ok(Value::String(it.extract()?));
    }
    if it.is_instance_of::<PyBool>() {
        return Ok(Value::Bool(it.extract()?));
    }
    if it.is_instance_of::<PyInt>() || it.hasattr("__index__")? && !it.hasattr("__len__")? {
        return Ok(Value::from(it.extract::<i64>()?));
    }
    if it.is_instance_of::<PyFloat>() || it.hasattr("__float__")? && !it.hasattr("__len__")? {
        let number: f64 = it.extract()?;
        return match serde_json::Number::from_f64(number) {
            Some(number) => Ok(Value::Number(number)),
            None => refuse(format!("{at} is {number}: give a finite number")),
        };
    }
    if it.hasattr("__fspath__")? {
        return Ok(Value::String(it.call_method0("__fspath__")?.extract()?));
    }
    match it.try_iter() {
        Ok(items) => Ok(Value::Array(items.map(|item| value(&item?, at)).collect::<PyResult<_>>()?)),
        Err(_) => refuse(format!("{at} is {}: give a number, a text, a list or a dictionary", it.repr()?)),
    }
}

/// The setup that some sections make.
pub fn setup(sections: &Sections) -> PyResult<Setup> {
    table(sections)?.setup().map_err(refused)
}

/// The table of some sections.
pub fn table(sections: &Sections) -> PyResult<Table> {
    Table::from_json(&Value::Object(sections.clone()).to_string()).map_err(refused)
}

/// The sections of a setup.
pub fn sections_of(setup: &Setup) -> Sections {
    match serde_json::to_value(setup) {
        Ok(Value::Object(sections)) => sections,
        _ => Sections::new(),
    }
}

/// The section `name`, to be filled.
pub fn section<'a>(sections: &'a mut Sections, name: &str) -> &'a mut Sections {
    let section = sections.entry(name).or_insert_with(|| Value::Object(Map::new()));
    if !section.is_object() {
        *section = Value::Object(Map::new());
    }
    section.as_object_mut().expect("an object was just put there")
}

/// Anything that can be written as JSON, as dictionaries and lists of Python.
pub fn python<'py>(py: Python<'py>, of: &impl serde::Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(of).map_err(refused)?;
    py.import("json")?.call_method1("loads", (text,))
}
