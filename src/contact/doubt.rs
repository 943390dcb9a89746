//! The doubts about results that are read from files.

/// A doubt about a result that was read from a file: a fault that a check has found.
#[derive(Debug, Clone, PartialEq)]
pub enum SavedDoubt {
    /// Pressures that pull.
    Tension {
        /// Nodes with a negative pressure.
        nodes: usize,
        /// The lowest pressure over the largest one.
        lowest: f64,
    },
    /// Pressures above the hardness, by this part of it.
    AboveHardness {
        /// The excess over the hardness.
        excess: f64,
    },
    /// Another load than the prescribed one.
    Load {
        /// The load over the prescribed one.
        carried: f64,
    },
    /// Another mean gap or approach than the prescribed one.
    Datum {
        /// The name of the quantity.
        name: &'static str,
        /// The value in the file.
        found: f64,
        /// What is prescribed.
        prescribed: f64,
    },
    /// A displacement that is not that of the pressure.
    Displacement,
    /// A gap that is not that of the pressure.
    Gap,
    /// A certificate above the goals of the setup.
    Certificate {
        /// `eta`.
        eta: f64,
    },
    /// Another contact on the next coarser grid.
    Coarser,
    /// Other heights than those of the setup.
    Heights {
        /// The largest difference over the largest height.
        difference: f64,
    },
    /// Heights that cannot be compared with those of the setup, and why.
    UnknownHeights {
        /// The reason.
        reason: String,
    },
    /// An attraction that is not that of the gap.
    Attraction,
    /// A violation of equilibrium over the strength of the attraction.
    Equilibrium {
        /// The largest one of a node.
        residual: f64,
    },
    /// Tractions beyond the limit of friction.
    Friction {
        /// The largest excess over the largest limit.
        excess: f64,
    },
    /// Another tangential load than the prescribed one.
    Tangential {
        /// The mean traction.
        found: f64,
        /// What is prescribed.
        prescribed: f64,
    },
    /// A traction that does not follow from the state before.
    Slip {
        /// The certificate of the traction.
        eta: f64,
    },
    /// A speed, creepage or time that the setup does not have.
    Place {
        /// The name of the quantity.
        name: &'static str,
        /// The value in the file.
        found: f64,
    },
    /// A field without which the state cannot be checked.
    Missing {
        /// The name of the field.
        name: &'static str,
    },
}

impl SavedDoubt {
    /// The doubt in a sentence without its full stop, about a `place` such as "run.npz" or "state 3 of run.npz".
    pub fn in_words(&self, place: &str) -> String {
        let not = format!("so the result in {place} does not hold");
        match self {
            Self::Tension { nodes: 1, lowest } => {
                format!("The pressure of a node is negative, {lowest:.1e} of the largest pressure, {not}")
            }
            Self::Tension { nodes, lowest } => {
                format!(
                    "The pressures of {nodes} nodes are negative, down to {lowest:.1e} of the largest pressure, {not}"
                )
            }
            Self::AboveHardness { excess } => {
                format!("The pressures exceed the hardness by {:.2} %, {not}", 100.0 * excess)
            }
            Self::Load { carried } => format!("The pressures carry {} of the prescribed load, {not}", digits(*carried)),
            Self::Datum { name, found, prescribed } => {
                format!("The {name} is {found:.4e}, but {prescribed:.4e} is prescribed, {not}")
            }
            Self::Displacement => {
                format!("The pressure in {place} does not cause the displacement in it: one of them was changed")
            }
            Self::Gap => format!("The gap in {place} is not that of the pressure in it: one of them was changed"),
            Self::Certificate { eta } => format!(
                "The pressure in {place} does not meet the tolerance of its setup: its certificate is {eta:.1e}"
            ),
            Self::Coarser => {
                format!(
                    "The contact on the next coarser grid in {place} is not that of its setup: the array `coarser` was changed"
                )
            }
            Self::Heights { difference } => {
                format!(
                    "The heights in {place} are not those of its setup: they differ by up to {difference:.1e} of the largest height"
                )
            }
            Self::UnknownHeights { reason } => {
                format!("The heights in {place} cannot be compared with those of its setup: {reason}")
            }
            Self::Attraction => {
                format!("The attraction in {place} is not that of the gap in it: one of them was changed")
            }
            Self::Equilibrium { residual } => {
                format!("The nodes are not in equilibrium, by up to {residual:.1e} of the largest attraction, {not}")
            }
            Self::Friction { excess } => {
                format!("The tractions exceed the limit of friction, by up to {:.2} % of it, {not}", 100.0 * excess)
            }
            Self::Tangential { found, prescribed } => {
                format!("The mean traction is {found:.4e}, but {prescribed:.4e} is prescribed, {not}")
            }
            Self::Slip { eta } => {
                format!("The traction in {place} does not follow from the state before: its certificate is {eta:.1e}")
            }
            Self::Place { name, found } => format!("The setup has no {name} {found:?}, {not}"),
            Self::Missing { name } => {
                format!("There is no array `{name}`, without which the result in {place} cannot be checked")
            }
        }
    }

    /// Whether another doubt is of the same kind.
    pub fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// A ratio with as many digits as show that it is not 1.
fn digits(ratio: f64) -> String {
    if (ratio - 1.0).abs() >= 0.005 { format!("{ratio:.3}") } else { format!("{ratio:.9}") }
}
