//! Contacts one after the other, where each step begins with what the last one left behind.
//!
//! | process         | a step is                                                       | it carries                     |
//! |-----------------|-----------------------------------------------------------------|--------------------------------|
//! | [`Loading`]     | a contact under the next load                                   | the pressure, and what has yielded |
//! | [`Creep`]       | a contact with other heights, under a load that is larger by a factor | what a viscoelastic solid remembers |
//! | [`SlipHistory`] | a normal contact, then a traction below `mu p`                  | the traction                   |
//! | [`Sliding`]     | a contact that slides steadily over a viscoelastic solid        | nothing: one state for each speed |
//! | [`AdhesiveProcess`] | a contact with an attraction, from the last state      | the state                      |
//! | [`PlasticLoading`] | contact and plastic flow below the surface under the next load  | the plastic strain in depth    |
//! | [`Rolling`]     | a line that rolls steadily, with friction                       | nothing: one state for each creepage or load |
//!
//! A [`Process`] makes the states of any of them along its path, as [`State`](crate::contact::State)s: tables, recordings and pictures know these.
//!
//! One picture holds for all processes that move. The rough surface lies above the solid and moves towards `+x` over it. The fields move with the
//! surface. So new material of the solid enters the contact at its `+x` side. Tractions act on the solid below.

mod adhesive;
mod adhesive_place;
mod adhesive_search;
mod adhesive_totals;
mod adhesive_walk;
mod apart;
mod creep;
mod creep_grid;
mod creep_path;
mod creep_process;
mod creep_state;
mod creep_steps;
mod cycle;
mod discs;
mod flattened;
mod loading;
mod maxwell;
mod motion_process;
mod plastic;
mod process;
mod profile;
mod rolling;
mod sliding;
mod slip;
mod slip_coupling;
mod slip_memory;
mod slip_process;
mod slip_pull;
mod slip_round;
mod slip_shear;
mod slip_state;
mod slip_steps;
mod slip_totals;
mod slip_traction;
mod slip_vector;
mod time_difference;
mod time_errors;
mod time_step;
mod transients;
mod warm_start;

pub use adhesive::AdhesiveProcess;
pub use adhesive_totals::{AdhesionJump, AdhesionTotals};
pub use creep::Creep;
pub use creep_grid::CreepGridErrors;
pub use creep_path::CreepPath;
pub use creep_process::CreepProcess;
pub use creep_state::{CreepEnergy, CreepState};
pub use creep_steps::CreepSteps;
pub use cycle::{CycleLoss, cycle_losses, open_cycles};
pub use loading::Loading;
pub use motion_process::{RollingProcess, SlidingProcess};
pub use plastic::{
    Plastic, PlasticCertificate, PlasticEnergy, PlasticErrorSources, PlasticErrors, PlasticLoading, PlasticSolid,
    PlasticState,
};
pub use process::{EachState, PathPoint, Process};
pub use rolling::{Rolling, RollingConditions, RollingDrive};
pub use sliding::Sliding;
pub use slip::SlipHistory;
pub use slip_process::SlipProcess;
pub use slip_state::{SlipCertificate, SlipState, Zone};
pub use slip_steps::SlipPace;
pub(crate) use slip_steps::{LEAST_LOSS, LEAST_SHIFT};
pub use slip_totals::{SlipPathErrors, SlipTotals};
pub use time_errors::TimeErrors;
