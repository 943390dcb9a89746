//! The groups of contests.

use crate::setup::Method;
use serde::Serialize;

/// Contests that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Indenters on lines of 2^12 to 2^18 and surfaces of 256^2 to 2048^2 points
    Smooth,
    /// Rough surfaces of 2048^2 points, short cut-off 1/64 of the roll-off
    Surfaces,
    /// Rough lines of 2^18 points, short cut-off 1/512 of the roll-off
    Lines,
    /// Rough lines and surfaces of a fixed spectrum on successively finer grids
    Growth,
    /// A rough surface of 2048^2 and a line of 2^18 points, by conjugate gradients as well
    Peers,
    /// Rough surfaces of 4096^2 points, Hurst exponent 0.8, from light to heavy contact, periodic and free
    Contact,
    /// A rough surface of 16384^2 points, which takes minutes and many GiB of memory
    Large,
    /// Rough surfaces of 512^2 to 2048^2 points by this code and by others, see --python
    Rivals,
    /// Rough surfaces of 256^2 points that creep, stick and slip, by this code and by others, see --python
    Histories,
}

impl Group {
    /// The groups that run if none is named.
    pub const USUAL: [Self; 5] = [Self::Smooth, Self::Surfaces, Self::Lines, Self::Growth, Self::Peers];

    /// The methods to use if none is named.
    pub fn methods(self) -> &'static [Method] {
        match self {
            Self::Peers => &[Method::Multilevel {}, Method::PolonskyKeer {}],
            _ => &[Method::Multilevel {}],
        }
    }

    /// The certificate to reach if none is named.
    pub fn tolerance(self) -> f64 {
        if self == Self::Large { 1e-6 } else { 1e-8 }
    }
}
