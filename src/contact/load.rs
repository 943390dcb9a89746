//! The load that presses the surface on the solid.

use crate::quantity;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The load that presses the surface on the solid: one of these numbers is given, and the solution determines the
/// others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// The mean pressure `<p>`.
    MeanPressure(#[serde(deserialize_with = "quantity::pressure")] f64),
    /// The reduced pressure `p* = <p> / (gbar E*)`, with the rms gradient `gbar` of the surface; dimensionless.
    ReducedPressure(f64),
    /// The mean gap `D`, a length: the distance between the mean planes of both surfaces. With a hardness, the planes are those of
    /// surfaces that have not yielded, and the mean gap that is found is larger than `D` by the plastic overlap.
    MeanGap(#[serde(deserialize_with = "quantity::length")] f64),
    /// The force on the cell, on a line per length across it.
    Force(#[serde(deserialize_with = "quantity::force")] f64),
    /// The approach, a length: how far the surface moves after its highest peak has touched the undeformed solid. It is
    /// not defined on a periodic half-space.
    Approach(#[serde(deserialize_with = "quantity::length")] f64),
}

impl Load {
    /// The number.
    pub fn value(&self) -> f64 {
        match *self {
            Self::MeanPressure(value)
            | Self::ReducedPressure(value)
            | Self::MeanGap(value)
            | Self::Force(value)
            | Self::Approach(value) => value,
        }
    }

    /// The reduced pressure, if it is one.
    pub fn reduced_pressure(&self) -> Option<f64> {
        if let Self::ReducedPressure(value) = *self { Some(value) } else { None }
    }

    /// The load of the same kind with another number.
    pub fn with_value(self, value: f64) -> Self {
        match self {
            Self::MeanPressure(_) => Self::MeanPressure(value),
            Self::ReducedPressure(_) => Self::ReducedPressure(value),
            Self::MeanGap(_) => Self::MeanGap(value),
            Self::Force(_) => Self::Force(value),
            Self::Approach(_) => Self::Approach(value),
        }
    }

    /// The name of the quantity that is prescribed.
    pub fn name(&self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "mean pressure",
            Self::ReducedPressure(_) => "reduced pressure",
            Self::MeanGap(_) => "mean gap",
            Self::Force(_) => "force",
            Self::Approach(_) => "approach",
        }
    }

    /// Its symbol, such as `p*`.
    pub fn symbol(&self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "p",
            Self::ReducedPressure(_) => "p*",
            Self::MeanGap(_) => "mean gap",
            Self::Force(_) => "force",
            Self::Approach(_) => "approach",
        }
    }

    /// Whether it depends on the displacement by a uniform pressure.
    pub(super) fn keeps_uniform(&self) -> bool {
        matches!(self, Self::Approach(_))
    }

    /// Whether the pressure is prescribed, so that the datum of the gap is unknown.
    pub fn is_pressure(&self) -> bool {
        matches!(self, Self::MeanPressure(_) | Self::ReducedPressure(_) | Self::Force(_))
    }
}

/// Symbol and number, of at most four digits.
///
/// ```
/// use asperity::contact::Load;
/// assert_eq!(Load::ReducedPressure(1.778279).to_string(), "p* = 1.778");
/// assert_eq!(Load::MeanPressure(2.5e7).to_string(), "p = 2.5e7");
/// assert_eq!(Load::MeanGap(0.001).to_string(), "mean gap = 0.001");
/// ```
impl fmt::Display for Load {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let symbol = self.symbol();
        let rounded: f64 = format!("{:.3e}", self.value()).parse().unwrap_or(f64::NAN);
        match rounded.abs() {
            1e-4..1e4 => write!(f, "{symbol} = {rounded}"),
            _ => write!(f, "{symbol} = {rounded:e}"),
        }
    }
}
