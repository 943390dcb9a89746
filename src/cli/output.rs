//! What commands print: an object as JSON for scripts, and rows of names and values for people.

use anyhow::Result;
use serde::Serialize;
use std::io::{self, Write};

/// Writes an object as one line of JSON.
pub(crate) fn write_json(object: &impl Serialize, out: &mut dyn Write) -> Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string(object)?)?)
}

/// Writes names and values, one pair a line.
pub(crate) fn write_rows(rows: impl IntoIterator<Item = (String, String)>, out: &mut dyn Write) -> io::Result<()> {
    rows.into_iter().try_for_each(|(name, value)| writeln!(out, "  {name:<25} {value}"))
}
