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

/// All drives. Their keys are in this order on a command line. Of several that a setup asks for, the last one is meant: sliding stands behind creep, which
/// it needs.
pub const DRIVES: &[&Drive] =
    &[&LOADS, &plastic::PLASTIC, &adhesion::ADHESION, &creep::CREEP, &sliding::SLIDING, &rolling::ROLLING, &slip::SLIP];
