//! For which states a quantity has a meaning.

use crate::contact::Feels;

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
    /// Whether the quantity has a meaning for a state of a solid that feels this.
    ///
    /// ```
    /// use asperity::contact::{Feels, Quantity};
    /// let holds = |quantity: Quantity, feels| quantity.row().validity.holds(feels);
    /// assert!(holds(Quantity::MeanPressure, Feels::ATTRACTION) && !holds(Quantity::KappaR, Feels::ATTRACTION));
    /// assert!(holds(Quantity::KappaR, Feels::MEMORY) && !holds(Quantity::ElasticEnergy, Feels::MEMORY));
    /// ```
    pub fn holds(self, feels: Feels) -> bool {
        match self {
            Self::Always => true,
            Self::NoAdhesion | Self::Yielding => !feels.attraction,
            Self::Elastic | Self::Sliding => feels.is_pressure_alone(),
        }
    }
}
