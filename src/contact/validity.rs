//! For which states a quantity has a meaning.

/// What a contact is a state of, as far as its quantities depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StateKind {
    /// A contact of an elastic solid, also one that yields, slips, slides or rolls.
    #[default]
    Elastic,
    /// A state of a solid that creeps, which earlier pressures displace as well.
    Creep,
    /// A state of a solid that yields below its surface, which plastic strain displaces as well.
    Plastic,
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
