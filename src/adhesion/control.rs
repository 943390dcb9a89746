//! What is prescribed of a contact with adhesion.

/// What is prescribed of a contact with adhesion. A mean pressure may be negative: then the surfaces are pulled apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AdhesiveControl {
    /// The mean pressure `P`, the force over the area of the cell, of any sign.
    MeanPressure(f64),
    /// The mean gap, a length, on a periodic grid.
    MeanGap(f64),
    /// The approach, a length of any sign: how far the surface has moved since its highest peak touched the undeformed solid.
    Approach(f64),
}

impl AdhesiveControl {
    /// The number.
    pub fn value(self) -> f64 {
        match self {
            Self::MeanPressure(value) | Self::MeanGap(value) | Self::Approach(value) => value,
        }
    }

    /// The control of the same kind with another number.
    pub fn with_value(self, value: f64) -> Self {
        match self {
            Self::MeanPressure(_) => Self::MeanPressure(value),
            Self::MeanGap(_) => Self::MeanGap(value),
            Self::Approach(_) => Self::Approach(value),
        }
    }

    /// The name of the quantity.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "mean pressure",
            Self::MeanGap(_) => "mean gap",
            Self::Approach(_) => "approach",
        }
    }
}
