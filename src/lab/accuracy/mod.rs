//! Error against run time.
//!
//! Three errors, all relative, are kept apart: the algebraic one of a step against the solution on the same grid, that of the
//! discretisation of a grid against the truth (the exact solution, or a grid four times finer than the finest), and that of the
//! model, a theory held against the same truth.
//!
//! ```text
//! Experiment { Scene, grids, stops } --> Findings { Ladder of grids, Models, Curves of the solvers } --> table, figure, CSV
//! ```
#![doc = include_str!("../../../assets/doc/accuracy.md")]

mod advice;
mod curve;
mod experiment;
mod figure;
mod findings;
mod ladder;
mod model;
mod quantity;
#[cfg(feature = "record")]
mod recording;
mod row;
mod scene;
mod table;

pub use curve::{Curve, Point};
pub use experiment::Experiment;
pub use figure::figure;
pub use findings::Findings;
pub use ladder::{Ladder, Rung};
pub use model::Model;
pub use quantity::{QUANTITIES, Values};
#[cfg(feature = "record")]
pub use recording::record;
pub use row::write_rows;
pub use scene::Scene;
