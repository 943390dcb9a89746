//! What pressures are allowed.

/// The law of the contact: what pressures are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Law {
    /// A hard wall: `p >= 0`.
    #[default]
    HardWall,
    /// A hard wall and a hardness `H_c` of the softer body, a pressure above which it yields: `0 <= p <= H_c` (Almqvist et al., J. Tribol.
    /// 129, 2007).
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
}
