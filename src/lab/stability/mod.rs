//! How the solvers bear stiff and extreme contacts.
//!
//! ```text
//! trials --> Trial { problem, Demand } --(Rival)--> judge: Check of the pressure --> Report { Verdict } --> Tally
//! ```
//!
//! A trial is judged by a [`Check`] of the pressure that shares nothing with the solvers and their certificate. [`TimeSteps`]
//! are the largest stable time steps of molecular dynamics, measured beside theory.
#![doc = include_str!("../../../assets/doc/stability.md")]

mod check;
mod judge;
mod report;
mod shapes;
mod tally;
mod time_step;
mod trial;
mod trials;
mod verdict;

pub use check::Check;
pub use judge::judge;
pub use report::HEAD;
pub use tally::Tally;
pub use time_step::TimeSteps;
pub use trial::Trial;
pub use trials::trials;
