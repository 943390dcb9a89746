//! The nodes of a line as a table.

use anyhow::Result;
use asperity::contact::Contact;
use asperity::files::write_csv;
use serde::Serialize;
use std::path::Path;

/// A node of a line.
#[derive(Serialize)]
struct Node {
    x: f64,
    height: f64,
    pressure: f64,
    gap: f64,
    displacement: f64,
    /// 1 in contact, else 0.
    contact: u8,
}

/// Writes the nodes of a contact on a line as CSV, one a row.
pub fn write_nodes(path: &Path, contact: &Contact) -> Result<()> {
    let surface = contact.problem.surface();
    let height = surface.heights_as_given();
    let node = |(i, x): (usize, f64)| Node {
        x,
        height: height[[0, i]],
        pressure: contact.pressure[[0, i]],
        gap: contact.gap[[0, i]],
        displacement: contact.displacement[[0, i]],
        contact: (contact.pressure[[0, i]] > 0.0).into(),
    };
    Ok(write_csv(path, surface.grid().x().enumerate().map(node))?)
}
