//! Contacts, load curves and histories as tables of comma-separated values.

use super::history::HistoryOutcome;
use crate::contact::{Contact, Observables, Status};
use crate::error::FileError;
use crate::files::{write_beside, write_csv};
use crate::study::FlowRow;
use serde::Serialize;
use std::io::Write;
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

/// A row of a table of loads, before its observables.
#[derive(Serialize)]
struct LoadRow {
    /// Number of the load, from 1.
    load_number: usize,
    status: Status,
}

/// Writes the observables of contacts under several loads, one load a row, with what flows where that is found.
///
/// # Errors
/// The errors of [`write_csv`].
pub fn write_loads(path: &Path, loads: &[(Status, Observables)], flow: Option<&[FlowRow]>) -> Result<(), FileError> {
    let row = |(i, &(status, observables)): (usize, &(Status, Observables))| {
        (LoadRow { load_number: i + 1, status }, observables)
    };
    let rows = loads.iter().enumerate().map(row);
    match flow {
        None => write_csv(path, rows),
        Some(flow) => write_csv(path, rows.zip(flow)),
    }
}

impl HistoryOutcome {
    /// Writes the numbers of all states, one state a row, with adhesion with the claim of each.
    ///
    /// # Errors
    /// The errors of [`write_beside`].
    pub fn write_table(&self, path: &Path) -> Result<(), FileError> {
        let (states, quantities) = (&self.states, self.quantities());
        write_beside(path, |file| {
            let claimed = self.adhesion.is_some().then_some("claim");
            let first = ["state", "status"].into_iter().chain(claimed);
            let names: Vec<&str> = first.chain(quantities.iter().map(|it| it.name)).collect();
            writeln!(file, "{}", names.join(","))?;
            states.iter().enumerate().try_for_each(|(i, state)| {
                let values =
                    quantities.iter().map(|it| (it.value)(state).map_or(String::new(), |value| value.to_string()));
                let claim = claimed.map(|_| <&str>::from(state.claim).to_owned());
                let first = [(i + 1).to_string(), state.contact.status.name().to_owned()].into_iter().chain(claim);
                let cells: Vec<String> = first.chain(values).collect();
                writeln!(file, "{}", cells.join(","))
            })
        })
    }
}
