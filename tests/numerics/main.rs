//! The numerics: each part on its own, solvers and their certificates, and what is read off a contact.

mod certificate;
mod command;
#[path = "../common/mod.rs"]
mod common;
mod convergence;
mod counted;
mod diagnosis;
mod distributions;
mod edges;
mod files;
mod forecast;
mod foreign;
mod fourier;
mod gfmd;
mod grid;
mod mean_gap;
mod multilevel;
mod observing;
mod open_door;
mod patches;
#[path = "../common/peer.rs"]
mod peer;
mod polonsky_keer;
#[cfg(feature = "units")]
mod quantity;
mod reference;
mod response;
mod results;
mod solvers_agree;
