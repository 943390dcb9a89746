//! Error against run time.
//!
//! The table separates three errors, all relative: the algebraic one of a step against the solution on the same grid,
//! that of the discretisation of a grid against the truth (the exact solution, or a grid four times finer than the
//! finest), and that of the model, a theory held against the same truth.
//!
//! ```text
//! Experiment { Scene, grids, stops } --> Findings { Ladder of grids, Models, Curves of the solvers } --> table, figure, CSV
//! ```
#![doc = include_str!("../../../assets/doc/accuracy.md")]

mod curve;
mod experiment;
mod figure;
mod ladder;
mod model;
mod quantity;
mod realised;
#[cfg(feature = "record")]
mod recording;
mod row;
mod scene;
mod table;

pub use experiment::{Experiment, Measurements};
pub use figure::figure;
#[cfg(feature = "record")]
pub use recording::record;
pub use row::write_rows;
pub use scene::AccuracyScene;
