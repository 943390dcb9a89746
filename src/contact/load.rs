//! The load that presses the surface on the solid.

use crate::quantity;
use serde::{Deserialize, Serialize};

/// The load that presses the surface on the solid: one of three numbers, of which the solution tells the others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// The mean pressure `<p>`.
    MeanPressure(#[serde(deserialize_with = "quantity::pressure")] f64),
    /// The reduced pressure `p* = <p> / (gbar E*)`, with the rms gradient `gbar` of the surface; dimensionless.
    ReducedPressure(f64),
    /// The mean gap `D`, a length: how far apart the mean planes of both surfaces are kept.
    MeanGap(#[serde(deserialize_with = "quantity::length")] f64),
}

impl Load {
    /// The number.
    pub fn value(&self) -> f64 {
        match *self {
            Self::MeanPressure(value) | Self::ReducedPressure(value) | Self::MeanGap(value) => value,
        }
    }

    /// The load of the same kind with another number.
    pub fn with_value(self, value: f64) -> Self {
        match self {
            Self::MeanPressure(_) => Self::MeanPressure(value),
            Self::ReducedPressure(_) => Self::ReducedPressure(value),
            Self::MeanGap(_) => Self::MeanGap(value),
        }
    }

    /// The name of the quantity that is prescribed.
    pub fn name(&self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "mean pressure",
            Self::ReducedPressure(_) => "reduced pressure",
            Self::MeanGap(_) => "mean gap",
        }
    }
}
