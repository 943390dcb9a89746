//! The allowed pressures.

use crate::contact::Ceiling;
use crate::quantity;
use serde::{Deserialize, Deserializer, Serialize};

/// The law of the contact: which pressures are allowed.
///
/// In a scene it is the section `law`: with a `hardness`, a pressure, or left out.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(from = "LawKeys", into = "LawKeys")]
pub enum Law {
    /// A hard wall: `p >= 0`.
    #[default]
    HardWall,
    /// A hard wall and a hardness `H_c`, the pressure at which the softer body yields: `0 <= p <= H_c` (Almqvist et
    /// al., J. Tribol. 129, 2007).
    Hardness(f64),
}

impl Law {
    /// The highest pressure that is allowed.
    pub fn ceiling(self) -> f64 {
        match self {
            Self::HardWall => f64::INFINITY,
            Self::Hardness(hardness) => hardness,
        }
    }

    /// Whether there is no hardness.
    pub fn is_hard_wall(&self) -> bool {
        *self == Self::HardWall
    }

    /// The hardness, where there is one.
    pub fn hardness(self) -> Option<f64> {
        match self {
            Self::HardWall => None,
            Self::Hardness(hardness) => Some(hardness),
        }
    }

    /// Whether a node under this pressure yields: it lies at the hardness, except for rounding.
    pub fn yields(self, pressure: f64) -> bool {
        Ceiling::Uniform(self.ceiling()).yields(0, pressure)
    }
}

/// The keys of the section `law`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a section for the Law")]
struct LawKeys {
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "some_pressure")]
    hardness: Option<f64>,
}

fn some_pressure<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    quantity::pressure(from).map(Some)
}

impl From<LawKeys> for Law {
    fn from(LawKeys { hardness }: LawKeys) -> Self {
        hardness.map_or(Self::HardWall, Self::Hardness)
    }
}

impl From<Law> for LawKeys {
    fn from(law: Law) -> Self {
        Self { hardness: law.hardness() }
    }
}
