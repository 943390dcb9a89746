//! The methods that find states with adhesion.

use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumMessage, IntoStaticStr};

/// The method that finds states with adhesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, EnumIter, EnumMessage, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum AdhesiveMethod {
    /// Newton steps in the gap on periodic grids, with safe steps where they fail; safe steps on free boundaries.
    #[default]
    Fast,
    /// Each step is a contact without adhesion: the energy falls in every step.
    Safe,
    /// A damped motion of the surface, in which the attraction acts as a force, on periodic grids: jumps can be watched.
    Gfmd,
}

impl AdhesiveMethod {
    /// The name of the method in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "Newton steps",
            Self::Safe => "convex steps",
            Self::Gfmd => "damped motion",
        }
    }

    /// The method in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Fast => "projected Newton steps in the gap, with convex steps where they fail and on free boundaries",
            Self::Safe => "contacts without adhesion one after the other, whose energy falls",
            Self::Gfmd => "damped motion of the surface, in which the attraction acts as a force",
        }
    }
}
