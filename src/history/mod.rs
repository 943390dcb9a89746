//! Contacts one after the other, where each step begins with what the last one left behind.
//!
//! | process         | a step is                                                       | it carries                     |
//! |-----------------|-----------------------------------------------------------------|--------------------------------|
//! | [`Creep`]       | a contact with other heights, under a load that is larger than the given one by a factor | what a viscoelastic solid remembers |
//! | [`SlipHistory`] | a normal contact, then a traction below `mu p`                  | the traction                   |

mod creep;
mod creep_path;
mod creep_state;
mod creep_steps;
mod kelvin;
mod slip;
mod slip_state;

pub use creep::Creep;
pub use creep_path::CreepPath;
pub use creep_state::{CreepEnergy, CreepState};
pub use creep_steps::CreepSteps;
pub use kelvin::CreepRule;
pub use slip::SlipHistory;
pub use slip_state::{SlipCertificate, SlipState, Zone};
