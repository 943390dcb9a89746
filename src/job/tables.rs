//! Contacts and the states of runs as tables of comma-separated values.

use super::history::HistoryOutcome;
use crate::contact::{Contact, Quantity, StateRow};
use crate::error::FileError;
use crate::files::{write_csv, write_words};
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

/// Writes the nodes of a contact on a line, one a row.
///
/// # Errors
/// The errors of [`write_csv`].
pub fn write_nodes(path: &Path, contact: &Contact) -> Result<(), FileError> {
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
    write_csv(path, surface.grid().x().enumerate().map(node))
}

/// The names of the columns of a table of states with these quantities.
pub(super) fn names(quantities: &[Quantity]) -> Vec<String> {
    let known = quantities.iter().map(|quantity| quantity.name());
    ["state", "status", "claim"].into_iter().chain(known).map(str::to_owned).collect()
}

/// The words of the row of a state in such a table. States are counted from 1.
pub(super) fn words(number: usize, row: &StateRow, quantities: &[Quantity]) -> Vec<String> {
    let claim = <&str>::from(row.claim).to_owned();
    let mut words = vec![(number + 1).to_string(), row.status.name().to_owned(), claim];
    words.extend(quantities.iter().map(|quantity| row.word(*quantity)));
    words
}

impl HistoryOutcome {
    /// Writes the numbers of all states, one state a row, each with its claim.
    ///
    /// # Errors
    /// The errors of [`write_csv`].
    pub fn write_table(&self, path: &Path) -> Result<(), FileError> {
        let quantities = self.quantities();
        let rows = self.rows.iter().enumerate().map(|(number, row)| words(number, row, &quantities));
        write_words(path, std::iter::once(names(&quantities)).chain(rows))
    }
}
