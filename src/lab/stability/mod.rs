//! How the solvers bear stiff and extreme contacts.
//!
//! ```text
//! trials --> Trial { problem, Demand } --(Rival)--> judge: Check of the pressure --> Report { Verdict } --> Tally
//! ```
//!
//! A trial is judged by a [`Check`] of the pressure that shares nothing with the solvers and their certificate. [`TimeSteps`]
//! are the largest stable time steps of molecular dynamics, measured beside theory.
//!
//! ```
//! use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
//! use asperity::lab::stability::Check;
//! use asperity::{Grid, Indenter, Problem, Stop};
//! let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
//! let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
//! let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?;
//! let pressure: Vec<f64> = contact.pressure.into_iter().collect();
//! assert_eq!(Check::of(&problem, &pressure).doubt(1e-8), None);
//! let shifted: Vec<f64> = (0..256).map(|i| pressure[(i + 1) % 256]).collect();
//! assert!(Check::of(&problem, &shifted).doubt(1e-8).is_some());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("../../../assets/doc/stability.md")]

mod check;
mod judge;
mod report;
mod tally;
mod time_step;
mod trial;
mod trials;
mod verdict;

pub use check::Check;
pub use judge::judge;
pub use report::{HEAD, Report};
pub use tally::Tally;
pub use time_step::TimeSteps;
pub use trial::Trial;
pub use trials::trials;
pub use verdict::{Demand, Verdict};
