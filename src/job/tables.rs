//! Contacts, load curves and histories as tables of comma-separated values.

use super::history::HistoryOutcome;
use crate::contact::{Contact, Observables, Quantity, QuantityKind, State, Status};
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

/// Writes the numbers of contacts under several loads, one load a row, with those of a motion and of what flows where these are found.
///
/// # Errors
/// The errors of [`write_csv`].
pub fn write_loads(path: &Path, loads: &[LoadNumbers<'_>]) -> Result<(), FileError> {
    // a number may be absent under one load and not under another one
    let mut further: Vec<Quantity> = Vec::new();
    for (quantity, _) in loads.iter().flat_map(|load| load.further) {
        if !further.contains(quantity) {
            further.push(*quantity);
        }
    }
    let named = Quantity::found().chain(further.iter().copied()).map(Quantity::name);
    let names = ["load_number", "status"].into_iter().chain(named).map(str::to_owned).collect();
    let rows = loads.iter().enumerate().map(|(i, load)| {
        let found = Quantity::found().zip(load.observables.numbers()).map(|(it, value)| word(it, value));
        let known = further.iter().map(|it| word(*it, load.get(*it)));
        let first = [(i + 1).to_string(), load.status.name().to_owned()];
        first.into_iter().chain(found).chain(known).collect()
    });
    write_words(path, std::iter::once(names).chain(rows))
}

/// The numbers of a contact under one of several loads.
#[derive(Debug, Clone, Copy)]
pub struct LoadNumbers<'a> {
    /// How the solver stopped.
    pub status: Status,
    /// The numbers of the contact.
    pub observables: &'a Observables,
    /// What its motion gives, and what flows through it, as far as it was asked for.
    pub further: &'a [(Quantity, f64)],
}

impl LoadNumbers<'_> {
    /// A further number; NaN where there is none.
    fn get(&self, quantity: Quantity) -> f64 {
        self.further.iter().find(|(other, _)| *other == quantity).map_or(f64::NAN, |(_, value)| *value)
    }
}

/// A number of a state as a word of a table; empty where the state does not have it.
pub(super) fn cell(quantity: Quantity, state: &State) -> String {
    let Some(value) = state.get(quantity) else { return String::new() };
    if quantity.row().kind == QuantityKind::Flag { (value == 1.0).to_string() } else { value.to_string() }
}

/// A number as a word of a table; empty where it has no meaning.
fn word(quantity: Quantity, value: f64) -> String {
    match quantity.row().kind {
        QuantityKind::Flag => (value == 1.0).to_string(),
        QuantityKind::Whole => (value as u64).to_string(),
        QuantityKind::Number | QuantityKind::Bound if value.is_nan() => String::new(),
        QuantityKind::Number | QuantityKind::Bound => format!("{value:?}"),
    }
}

impl HistoryOutcome {
    /// Writes the numbers of all states, one state a row, with adhesion with the claim of each.
    ///
    /// # Errors
    /// The errors of [`write_csv`].
    pub fn write_table(&self, path: &Path) -> Result<(), FileError> {
        let quantities = self.quantities();
        let claimed = self.drive.has_claims.then_some("claim");
        let first = ["state", "status"].into_iter().chain(claimed);
        let names = first.chain(quantities.iter().map(|it| it.name())).map(str::to_owned).collect();
        let rows = self.states.iter().enumerate().map(|(i, state)| {
            let values = quantities.iter().map(|it| cell(*it, state));
            let claim = claimed.map(|_| <&str>::from(state.claim).to_owned());
            let first = [(i + 1).to_string(), state.contact.status.name().to_owned()].into_iter().chain(claim);
            first.chain(values).collect()
        });
        write_words(path, std::iter::once(names).chain(rows))
    }
}
