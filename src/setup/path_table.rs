//! Paths of histories in setups as text, and in files.

use super::command::value;
use super::loads::read_number;
use super::path::COLUMNS;
use super::range::{Range, unit};
use super::text::SetupTable;
use crate::error::{ConflictRule, SetupError};
use crate::files::{TextColumn, TextWord, read_columns};
use crate::quantity::time_of;
use std::path::Path;

impl SetupTable {
    /// Reads the loads of a path, whose units are those of the load, and its file if it has one. A text such as `"1e-3..1e-1:5"` among the
    /// loads means 5 loads with equal ratios.
    ///
    /// # Errors
    /// [`SetupError::Conflict`], [`SetupError::Table`], [`SetupError::Text`] for a load of another kind, and those of reading the file.
    pub(super) fn read_path(&mut self) -> Result<(), SetupError> {
        let kind = self.load_kind();
        if let Some(file) = self.find("path.file").and_then(toml::Value::as_str).map(str::to_owned) {
            for (name, values) in columns(Path::new(&file), kind.as_deref())? {
                let path = format!("path.{name}");
                if self.find(&path).is_some() {
                    return Err(ConflictRule::PathTwice
                        .with([("quantity", name.into()), ("file", file.into())])
                        .into());
                }
                self.lay(&path, values.into());
            }
        }
        let Some(kind) = kind else { return Ok(()) };
        for path in ["path.load", "path.tangential", "rolling.tangential"] {
            let Some(list) = self.find(path) else { continue };
            let list = list.as_array().cloned().unwrap_or_else(|| vec![list.clone()]);
            let values = list.iter().map(|value| expanded(path, &kind, value)).collect::<Result<Vec<_>, _>>();
            // if one is wrong, a number replaces it, so that the rest can be read
            self.lay(path, values.as_ref().map_or_else(|_| vec![1.0], |values| values.concat()).into());
            values.map(drop)?;
        }
        Ok(())
    }
}

/// The loads of one value of a list: those of a range, or one.
fn expanded(path: &str, kind: &str, given: &toml::Value) -> Result<Vec<f64>, SetupError> {
    let wrong = |reason: String| SetupError::text(path, reason);
    match given.as_str().and_then(Range::parse) {
        Some(range) => range.map_err(wrong)?.values(|end| read_number(path, kind, &value(end)), wrong),
        None => read_number(path, kind, given).map(|number| vec![number]),
    }
}

/// The columns of a file with a path: their names, and what is in them, under a load of some kind.
fn columns(path: &Path, kind: Option<&str>) -> Result<Vec<(&'static str, Vec<f64>)>, SetupError> {
    let wrong = |reason: String| SetupError::Table { path: path.into(), reason };
    let mut columns: Vec<(&'static str, Vec<f64>)> = Vec::new();
    for column in read_columns(path)? {
        let Some(name) = COLUMNS.into_iter().find(|name| name.eq_ignore_ascii_case(&column.name)) else {
            let header = &column.name;
            return Err(wrong(format!("the column `{header}` is not known: name columns time, load and tangential")));
        };
        if columns.iter().any(|(other, _)| *other == name) {
            return Err(wrong(format!("the column {name} occurs twice: give it once")));
        }
        if column.words.is_empty() {
            return Err(wrong("the table is empty: give one row for each point of the path".into()));
        }
        check_column_units(&column).map_err(wrong)?;
        let values = column.numbers(|word| number(name, kind, word)).map_err(wrong)?;
        if name == "time" {
            check_order(&column, &values).map_err(wrong)?;
        }
        columns.push((name, values));
    }
    Ok(columns)
}

/// The number of a word with a unit in a column.
fn number(name: &str, kind: Option<&str>, word: &str) -> Result<f64, String> {
    let read = match (name, kind) {
        ("time", _) => time_of(word),
        (_, Some(kind)) => read_number("", kind, &word.into()).ok(),
        (_, None) => None,
    };
    let kind = if name == "time" { "time".to_owned() } else { kind.map_or("number".into(), |it| it.replace('-', " ")) };
    read.ok_or_else(|| format!("`{word}` in the column {name} is not a {kind}"))
}

/// Refuses a column in which some quantities have a unit and others have none; zero needs none.
fn check_column_units(column: &TextColumn) -> Result<(), String> {
    let is_zero = |word: &&TextWord| word.text.trim().parse::<f64>() == Ok(0.0);
    let (with, without): (Vec<_>, Vec<_>) =
        column.words.iter().filter(|word| !is_zero(word)).partition(|word| unit(&word.text).is_some());
    match (with.first(), without.first()) {
        (Some(with), Some(TextWord { row, text })) => Err(format!(
            "row {row}: `{text}` in the column {} has no unit, but {} has one: give a unit in every row, or in none",
            column.name, with.text
        )),
        _ => Ok(()),
    }
}

/// Refuses times that fall.
fn check_order(column: &TextColumn, times: &[f64]) -> Result<(), String> {
    let mut pairs = times.windows(2).zip(column.words.windows(2));
    match pairs.find(|(times, _)| times[1] < times[0]) {
        Some((_, [TextWord { text: before, .. }, TextWord { row, text }])) => {
            Err(format!("row {row}: the time {text} comes after {before}: give ascending times"))
        }
        _ => Ok(()),
    }
}
