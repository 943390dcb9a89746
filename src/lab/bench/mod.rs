//! How fast the solvers are.
//!
//! ```text
//! Group --> Contests { name, Setup } --(methods)--> Timings --> table, CSV
//! ```
#![doc = include_str!("../../../assets/doc/bench.md")]

mod contest;
mod group;
mod history_contest;
mod history_timing;
mod peer;
mod peer_timing;
mod timing;

pub use contest::Contest;
pub use group::Group;
pub use history_contest::HistoryContest;
pub use history_timing::{HISTORY_HEAD, HistoryTiming};
pub use peer::Python;
pub use peer_timing::{PEER_HEAD, PeerTiming};
pub use timing::{HEAD, Timing};
