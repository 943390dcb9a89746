//! Closed forms and quadratures to compare with: what the solvers must reproduce, and what theories predict.
//!
//! Conventions: compression is positive, `E*` is the contact modulus, lengths and moduli are in any one set of units. A
//! line contact has a load per unit length (pressure times length), a surface contact a load (pressure times area).

mod bush_gibson_thomas;
mod counting;
mod elliptic_hertz;
mod exact;
mod greenwood_williamson;
pub mod hertz;
pub mod periodic;
pub mod persson;
mod power_law;
mod pull_off;
mod quadrature;
pub(crate) use quadrature::integral;
mod westergaard;

pub use bush_gibson_thomas::BushGibsonThomas;
pub use counting::counting_excess;
pub use elliptic_hertz::EllipticHertz;
pub use exact::Exact;
pub use greenwood_williamson::{GreenwoodWilliamson, SummitHeights};
pub use periodic::Periodic;
pub use power_law::{Geometry, PowerLaw};
pub use pull_off::PullOff;
pub use westergaard::{Westergaard, crossed_full_pressure};
