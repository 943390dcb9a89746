//! For which states an observable has a meaning, and what a state knows better than its contact.

/// What a contact is a state of, as far as its observables depend on it.
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

/// The states for which an observable has a meaning. Where it has none, it is absent from files and tables, and NaN or zero in
/// [`Observables`](crate::contact::Observables).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Validity {
    /// All states.
    Always,
    /// All states without adhesion.
    NoAdhesion,
    /// States of an elastic solid whose load is that of the pressure between the surfaces. The observable is computed with the modulus of that
    /// solid, or from edges at which the pressure is that of an elastic solid.
    Elastic,
    /// Those of an elastic solid with a hardness.
    Yielding,
    /// Those of a contact that slides over a viscoelastic solid.
    Sliding,
}

impl Validity {
    /// Whether the observable has a meaning for a state of a kind.
    ///
    /// ```
    /// use asperity::contact::{OBSERVABLES, StateKind};
    /// let holds = |name: &str, kind| OBSERVABLES.iter().find(|it| it.name == name).is_some_and(|it| it.validity.holds(kind));
    /// assert!(holds("mean_pressure", StateKind::Adhesion) && !holds("kappa_r", StateKind::Adhesion));
    /// assert!(holds("kappa_r", StateKind::Creep) && !holds("elastic_energy", StateKind::Creep));
    /// ```
    pub fn holds(self, kind: StateKind) -> bool {
        match self {
            Self::Always => true,
            Self::NoAdhesion => kind != StateKind::Adhesion,
            Self::Elastic | Self::Yielding | Self::Sliding => kind == StateKind::Elastic,
        }
    }
}

/// What a state knows better than the pressure of its contact. A number is none where that of the contact holds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StateValues {
    /// What the contact is a state of.
    pub kind: StateKind,
    /// The mean pressure: with adhesion that of the contact less the attraction.
    pub mean_pressure: Option<f64>,
    /// The relative area: of a solid that creeps, by its effective pressure; with adhesion, the share of nodes that touch.
    pub relative_area: Option<f64>,
    /// `kappa_r`: of a solid that creeps, with its effective modulus.
    pub kappa_r: Option<f64>,
}
