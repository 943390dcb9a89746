//! The solvers on stiff and extreme contacts.
//!
//! ```text
//! trials --> Trial { problem, Demand, Twin } --(Rival)--> judge: Check of the pressure --> Report { Verdict } --> Tally
//! ```
//!
//! A trial is judged by a [`Check`] of the pressure. Of the solvers and their certificate it shares the problem and the definition
//! of the half-space, and [`Kernel`] holds what it displaces against a sum over images. A contact at a mean gap has a twin under
//! the mean pressure that was found, which must open to the same gap; one in unusual units has a twin in usual ones. [`TimeSteps`]
//! are the largest stable time steps of molecular dynamics, measured beside theory.
#![doc = include_str!("../../../assets/doc/stability.md")]

mod check;
mod judge;
mod kernel;
mod report;
mod shapes;
mod solids;
mod tally;
mod time_step;
mod trial;
mod trials;
mod verdict;

pub use check::Check;
pub use judge::judge;
pub use kernel::Kernel;
pub use report::HEAD;
pub use tally::Tally;
pub use time_step::TimeSteps;
pub use trial::Trial;
pub use trials::trials;
