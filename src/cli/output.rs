//! What commands print: an object as JSON for scripts, and rows of names and values for people.

use anyhow::Result;
use serde::Serialize;
use std::io::{self, Write};

/// Writes an object as one line of JSON.
pub(crate) fn write_json(object: &impl Serialize, out: &mut dyn Write) -> Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string(object)?)?)
}

/// A line of a summary: a name, and a value in words.
pub(crate) type TextRow = (String, String);

/// A line of a summary.
pub(crate) fn row(name: &str, value: impl Into<String>) -> TextRow {
    (name.to_owned(), value.into())
}

/// Writes names and values, one pair a line.
pub(crate) fn write_rows(rows: impl IntoIterator<Item = TextRow>, out: &mut dyn Write) -> io::Result<()> {
    rows.into_iter().try_for_each(|(name, value)| writeln!(out, "  {name:<25} {value}"))
}
