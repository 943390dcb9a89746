//! The numbers that a process gives for a state.

use crate::contact::{Feels, Quantity};

/// The numbers that a process gives for a state of its own. Where it gives one, it stands in place of the number that is computed of the contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateValues {
    /// What the solid feels besides the pressure between the surfaces.
    pub feels: Feels,
    numbers: Vec<(Quantity, f64)>,
}

/// Those of a step of a solver, which has no process.
pub(super) static NO_VALUES: StateValues = StateValues { feels: Feels::PRESSURE, numbers: Vec::new() };

impl StateValues {
    /// No numbers of a state of a solid that feels this.
    pub fn new(feels: Feels) -> Self {
        Self { feels, numbers: Vec::new() }
    }

    /// The values with one more number, if there is one. It replaces an earlier one.
    pub fn with(mut self, quantity: Quantity, value: impl Into<Option<f64>>) -> Self {
        if let Some(value) = value.into() {
            self.numbers.retain(|(other, _)| *other != quantity);
            self.numbers.push((quantity, value));
        }
        self
    }

    /// A number, if the process gives it; NaN where it says that there is none.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }

    /// The values of surfaces that have parted under their load: there is no distance between them that means anything, however they are drawn.
    pub fn parted(self) -> Self {
        let distances = [Quantity::MeanGap, Quantity::MeanGapOverRmsHeight, Quantity::Approach];
        distances.into_iter().fold(self, |values, it| values.with(it, f64::NAN))
    }

    /// All numbers that the process gives.
    pub fn numbers(&self) -> &[(Quantity, f64)] {
        &self.numbers
    }
}
