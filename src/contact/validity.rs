//! For which states a quantity has a meaning, and the numbers that a process gives for a state.

use crate::contact::Quantity;

/// What a contact is a state of, as far as its quantities depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StateKind {
    /// A contact of an elastic solid, also one that yields, slips, slides or rolls.
    #[default]
    Elastic,
    /// A state of a solid that creeps, which earlier pressures displace as well.
    Creep,
    /// A state with an attraction between the surfaces, which displaces the solid as well.
    Adhesion,
}

/// The states for which a quantity has a meaning. Where it has none, it is absent from files and tables, and NaN or zero in
/// [`Observables`](crate::contact::Observables).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Validity {
    /// All states.
    Always,
    /// All states without adhesion.
    NoAdhesion,
    /// States of an elastic solid whose load is that of the pressure between the surfaces. The quantity is computed with the modulus of that
    /// solid, or from edges at which the pressure is that of an elastic solid.
    Elastic,
    /// States without adhesion of a solid with a hardness.
    Yielding,
    /// Those of a contact that slides over a viscoelastic solid.
    Sliding,
}

impl Validity {
    /// Whether the quantity has a meaning for a state of a kind.
    ///
    /// ```
    /// use asperity::contact::{Quantity, StateKind};
    /// let holds = |quantity: Quantity, kind| quantity.row().validity.holds(kind);
    /// assert!(holds(Quantity::MeanPressure, StateKind::Adhesion) && !holds(Quantity::KappaR, StateKind::Adhesion));
    /// assert!(holds(Quantity::KappaR, StateKind::Creep) && !holds(Quantity::ElasticEnergy, StateKind::Creep));
    /// ```
    pub fn holds(self, kind: StateKind) -> bool {
        match self {
            Self::Always => true,
            Self::NoAdhesion | Self::Yielding => kind != StateKind::Adhesion,
            Self::Elastic | Self::Sliding => kind == StateKind::Elastic,
        }
    }
}

/// The numbers that a process gives for a state of its own. Where it gives one, it stands in place of the number that is computed of the contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateValues {
    /// What the contact is a state of.
    pub kind: StateKind,
    numbers: Vec<(Quantity, f64)>,
}

impl StateValues {
    /// No numbers of a state.
    pub fn new(kind: StateKind) -> Self {
        Self { kind, numbers: Vec::new() }
    }

    /// The values with one more number, if there is one. It replaces an earlier one.
    pub fn with(mut self, quantity: Quantity, value: impl Into<Option<f64>>) -> Self {
        if let Some(value) = value.into() {
            self.numbers.retain(|(other, _)| *other != quantity);
            self.numbers.push((quantity, value));
        }
        self
    }

    /// A number, if the process gives it.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.numbers.iter().find(|(other, _)| *other == quantity).map(|(_, value)| *value)
    }

    /// All numbers that the process gives.
    pub fn numbers(&self) -> &[(Quantity, f64)] {
        &self.numbers
    }
}
