//! How fast the solvers are.
//!
//! ```text
//! Group --> Contests { name, Setup } --(methods)--> Timings --> table, CSV
//! ```
//!
//! ```
//! use asperity::Stop;
//! use asperity::lab::bench::Group;
//! use asperity::setup::Method;
//! use std::num::NonZeroUsize;
//! let contests = Group::Smooth.contests(true, 1);
//! let methods = [Method::Multilevel {}, Method::PolonskyKeer {}];
//! let mut unwatched = |_: &str| -> Box<dyn asperity::contact::Observer> { Box::new(()) };
//! let timings = contests[0].timings(&methods, Stop::default(), NonZeroUsize::MIN, &mut unwatched);
//! let timings = timings.collect::<Result<Vec<_>, _>>()?;
//! assert!((timings[0].relative_area / timings[1].relative_area - 1.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contest;
mod contests;
mod group;
mod peak;
mod timing;

pub use contest::Contest;
pub use group::Group;
pub use timing::{HEAD, Timing};
