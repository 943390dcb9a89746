//! The numbers of a state, which are kept where its fields are given up.

use super::warnings::warnings_of_contact;
use crate::contact::{Observables, Quantity, QuantityKind, ResultClaim, State, Status};
use crate::warning::Warning;

/// What tables, summaries and warnings say of one state of a run. It has no fields, so a run of many states can keep it of all of them.
#[derive(Debug, Clone)]
pub struct StateRow {
    /// How the solver stopped.
    pub status: Status,
    /// What the certificate of the state proves.
    pub claim: ResultClaim,
    /// Why the solve did not reach its goals, in one sentence, if it did not.
    pub fault: Option<String>,
    /// All numbers of the state, in the order of [`Quantity`].
    pub numbers: Vec<(Quantity, f64)>,
    /// The numbers that the grid does not resolve: their relative error by the grid is 1 or more, or not known.
    unresolved: Vec<Quantity>,
    /// Reasons to doubt the contact that do not follow from its numbers.
    pub doubts: Vec<Warning>,
}

impl StateRow {
    /// What is said of a state. Its numbers are read, so the state is not to be changed afterwards.
    pub fn new(state: &State) -> Self {
        Self {
            status: state.contact.status,
            claim: state.claim,
            fault: state.contact.fault().map(|fault| fault.to_string()),
            numbers: state.numbers().to_vec(),
            unresolved: Quantity::all().filter(|it| is_unresolved(*it, state)).collect(),
            doubts: warnings_of_contact(&state.contact),
        }
    }

    /// A number of the state, if it has it.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }

    /// The same; NaN where the state does not have it.
    pub fn value(&self, quantity: Quantity) -> f64 {
        self.get(quantity).unwrap_or(f64::NAN)
    }

    /// A number, where the state has it and the grid resolves it.
    pub fn resolved(&self, quantity: Quantity) -> Option<f64> {
        self.get(quantity).filter(|_| !self.unresolved.contains(&quantity))
    }

    /// The numbers that can be computed of any contact; NaN where this one does not have them.
    pub fn observables(&self) -> Observables {
        Observables::of_numbers(&self.numbers)
    }

    /// A number as a word of a table; empty where the state does not have it.
    pub fn word(&self, quantity: Quantity) -> String {
        match (self.get(quantity), quantity.row().kind) {
            (None, _) => String::new(),
            (Some(value), QuantityKind::Flag) => (value == 1.0).to_string(),
            (Some(value), _) => value.to_string(),
        }
    }
}

/// Whether the grid does not resolve a number of a state. Where nothing touches, the area is 0 without any error.
fn is_unresolved(quantity: Quantity, state: &State) -> bool {
    let Some(error) = quantity.relative_error().filter(|error| error.tells_of(&state.contact)) else { return false };
    let is_small = state.get(error).is_some_and(|error| error < 1.0);
    !is_small && state.get(Quantity::RelativeAreaCounted) != Some(0.0)
}
