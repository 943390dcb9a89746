//! Contacts one after the other, where each state carries on what the next one needs.
//!
//! A process makes the next state from the last one: [`Creep`] carries the memory of a viscoelastic solid from one time to the next.

mod creep;
mod creep_path;
mod creep_state;
mod creep_steps;
mod kelvin;

pub use creep::Creep;
pub use creep_path::CreepPath;
pub use creep_state::{CreepEnergy, CreepState};
pub use creep_steps::CreepSteps;
pub use kelvin::CreepRule;
