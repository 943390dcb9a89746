//! Settings that remove the cause of an error.

use super::{ConflictRule, SetupError};
use crate::warning::Remedy;

impl SetupError {
    /// Settings that give what is missing. One of the alternatives is enough; the settings of one alternative go together. There are none
    /// where the sentence says it all.
    pub fn remedies(&self) -> Vec<Vec<Remedy>> {
        let set = |key| Remedy { key, value: None };
        let set_to = |key, value: &str| Remedy { key, value: Some(value.into()) };
        match self {
            Self::Conflict(conflict) => match conflict.rule {
                ConflictRule::NoSurface
                | ConflictRule::NoLoad
                | ConflictRule::NoPoints
                | ConflictRule::NoSize
                | ConflictRule::NoTangential => conflict.rule.keys().map(|key| vec![set(key)]).collect(),
                ConflictRule::AdhesionByGfmd => vec![vec![set_to("adhesion.method", "gfmd")]],
                _ => Vec::new(),
            },
            Self::NoModulus { .. } | Self::UnitWithoutModulus { .. } => {
                vec![vec![set("solid.contact-modulus")], vec![set("solid.young"), set("solid.poisson")]]
            }
            Self::Uneven { .. } => vec![vec![set_to("surface.prepare.resample", "linear")]],
            Self::Voids { .. } => vec![
                vec![set_to("surface.prepare.fill", "harmonic")],
                vec![set("surface.prepare.crop")],
                vec![set_to("surface.prepare.steps", "auto")],
            ],
            _ => Vec::new(),
        }
    }
}
