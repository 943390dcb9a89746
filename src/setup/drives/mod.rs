//! The drives that a setup can describe, each declared in its own file.

mod adhesion;
mod creep;
mod loads;
mod plastic;
mod plastic_doubts;
mod rolling;
mod sliding;
mod slip;

pub use loads::LOADS;

use super::Drive;

/// All drives that a setup asks for by its sections and keys. Where several are asked for, the first one reports what it cannot have beside it: so sliding
/// stands before creep, which it needs, and slip, which a path alone asks for, is the last one.
pub const DRIVES: &[&Drive] =
    &[&plastic::PLASTIC, &adhesion::ADHESION, &sliding::SLIDING, &rolling::ROLLING, &creep::CREEP, &slip::SLIP];
