//! What is prescribed of a contact.

/// What presses the surface on the solid: either of two numbers, of which the solution tells the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// The mean pressure `<p>`.
    MeanPressure(f64),
    /// The mean gap `D`, a length: how far apart the mean planes of both surfaces are kept.
    MeanGap(f64),
}

impl Load {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::MeanPressure(_) => "mean pressure",
            Self::MeanGap(_) => "mean gap",
        }
    }

    /// The mean gap, where it is prescribed.
    pub(super) fn mean_gap(&self) -> Option<f64> {
        match *self {
            Self::MeanPressure(_) => None,
            Self::MeanGap(gap) => Some(gap),
        }
    }
}
