//! Contacts with adhesion: an attraction between the surfaces above a hard wall.
//!
//! ```text
//! AdhesiveProblem (Problem + Attraction) --solve(control, from the last state)---> AdhesiveState | Separated
//!                                        --motion(control, from the last state)--> frames, AdhesiveState | Separated
//! ```
//!
//! The solid feels `p = p_c - sigma(g)`, with the contact pressure `p_c >= 0` where the gap is zero and the traction `sigma(g)` of an
//! [`Attraction`]. The energy of such a contact has many minima in general. So which state is found depends on the states before, and a state
//! is claimed as what it is: stationary, and stable. It is claimed as *the* solution only where its energy is convex.

mod attraction;
mod claim;
mod control;
mod convex;
mod curvature;
mod frames;
mod gap_energy;
mod method;
mod motion;
mod newton;
mod problem;
mod scales;
mod search;
mod search_limits;
mod start;
mod state;

pub use attraction::{Attraction, AttractionForm};
pub use control::AdhesiveControl;
pub use method::AdhesiveMethod;
pub use problem::AdhesiveProblem;
pub use scales::AdhesionScales;
pub use state::{AdhesiveMotion, AdhesiveOutcome, AdhesiveState};
