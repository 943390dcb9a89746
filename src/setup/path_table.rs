//! Paths of histories in setups as text, and in files.

use super::command::value;
use super::loads::read_number;
use super::path::COLUMNS;
use super::text::SetupTable;
use crate::error::SetupError;
use crate::files::read_columns;
use std::path::Path;

impl SetupTable {
    /// Reads the loads of a path, whose units are those of the load, and its file if it has one.
    ///
    /// # Errors
    /// [`SetupError::Path`], [`SetupError::Text`] for a load of another kind, and those of reading the file.
    pub(super) fn read_path(&mut self) -> Result<(), SetupError> {
        if let Some(file) = self.find("path.file").and_then(toml::Value::as_str).map(str::to_owned) {
            for (name, values) in columns(Path::new(&file))? {
                let path = format!("path.{name}");
                if self.find(&path).is_some() {
                    let reason = format!("{name} is given by {file} and beside it: leave one of them out");
                    return Err(SetupError::Path { reason });
                }
                self.lay(&path, values.into());
            }
        }
        let Some(kind) = self.load_kind() else { return Ok(()) };
        for path in ["path.load", "path.tangential", "rolling.tangential"] {
            let Some(list) = self.find(path) else { continue };
            let list = list.as_array().cloned().unwrap_or_else(|| vec![list.clone()]);
            let read = |value: &toml::Value| read_number(path, &kind, value).map(toml::Value::Float);
            let values = list.iter().map(read).collect::<Result<Vec<_>, _>>();
            // if one is wrong, a number replaces it, so that the rest can be read
            let number = || vec![toml::Value::Float(1.0)];
            self.lay(path, values.as_ref().map_or_else(|_| number(), Clone::clone).into());
            values.map(drop)?;
        }
        Ok(())
    }
}

/// The columns of a file with a path: their names, and what is in them.
fn columns(path: &Path) -> Result<Vec<(&'static str, Vec<toml::Value>)>, SetupError> {
    let wrong = |reason: String| SetupError::Path { reason: format!("{}: {reason}", path.display()) };
    let mut columns: Vec<(&'static str, Vec<toml::Value>)> = Vec::new();
    for (header, words) in read_columns(path)? {
        let Some(name) = COLUMNS.into_iter().find(|name| name.eq_ignore_ascii_case(&header)) else {
            return Err(wrong(format!("the column `{header}` is not known: name columns time, load and tangential")));
        };
        if columns.iter().any(|(other, _)| *other == name) {
            return Err(wrong(format!("the column {name} occurs twice: give it once")));
        }
        if words.is_empty() {
            return Err(wrong("the table is empty: give one row for each point of the path".into()));
        }
        columns.push((name, words.iter().map(|word| value(word)).collect()));
    }
    Ok(columns)
}
