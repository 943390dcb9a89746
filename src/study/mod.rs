//! Studies: setups solved under increasing loads, in tables from which an interrupted run continues, and their
//! evaluation.
//!
//! ```text
//! Refinement { setup, tolerance } --> Settled { setup, contact }
//! Realisation { name, setup, loads } --> Sweep --> Table (CSV) of Points --> SeedMean, Spread, Estimate, Limit
//! Plan, a setup with lists --> Realisations, in one Sweep or in Shards on many machines --> Table, columns, Parquet, figure
//!                              in Batches by workers elsewhere --> Ledger --> the same
//! ```
//!
//! A setup with a history is followed along its path instead: its row has the numbers of the last state, and what all states
//! add up to. One that asks for leakage or conductance has what flows in each row.

mod campaign;
mod check;
mod column;
#[cfg(feature = "figures")]
mod drawing;
mod estimate;
mod expense;
mod followed_history;
#[cfg(feature = "figures")]
mod history_figure;
mod identity;
mod known;
mod ledger;
mod limit;
mod means;
#[cfg(feature = "parquet")]
mod parquet;
mod plan;
mod point;
mod queue;
mod realisation;
mod refinement;
mod shard;
mod spread;
mod sweep;
mod table;
#[cfg(all(feature = "figures", feature = "parquet"))]
mod views;
mod warnings;

pub use crate::digest::NUMERICS;
pub use campaign::Campaign;
pub use check::first_changed_row;
pub use column::{Column, ColumnValues};
pub use estimate::Estimate;
pub use expense::Expense;
pub use ledger::{Batch, Ledger};
pub use limit::{GridValues, Limit};
pub use means::{AdhesionMeans, LoadMeans, SeedMean, YieldMeans};
pub use plan::{Plan, StudyRow};
pub use point::Point;
pub use realisation::Realisation;
pub use refinement::{Refinement, Settled};
pub use shard::Shard;
pub use spread::Spread;
pub use sweep::Sweep;
pub use table::Table;
pub use warnings::warnings_of_extrapolated_rows;
