//! How fast the solvers are.
//!
//! ```text
//! Group --> Contests { name, Setup } --(methods)--> Timings --> table, CSV
//! ```
#![doc = include_str!("../../../assets/doc/bench.md")]

mod contest;
mod group;
mod timing;

pub use contest::Contest;
pub use group::Group;
pub use timing::{HEAD, Timing};
