//! How fast the solvers are.
//!
//! ```text
//! Group --> Contests { name, Setup } --(methods)--> Timings --> table, CSV
//! ```
#![doc = include_str!("../../../assets/doc/bench.md")]

mod contest;
mod creep_timing;
mod group;
mod peer;
mod peer_timing;
mod timing;

pub use contest::Contest;
pub use creep_timing::{CREEP_HEAD, CreepTiming, HeldCreep};
pub use group::Group;
pub use peer::Python;
pub use peer_timing::{PEER_HEAD, PeerTiming};
pub use timing::{HEAD, Timing};
