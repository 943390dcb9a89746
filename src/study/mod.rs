//! Studies: surfaces pressed with rising loads, kept in tables that a killed run resumes, and what is made of them.
//!
//! ```text
//! Realisation { grid, shape, loads } --> Sweep --> Table (CSV) --> Spread, Fit
//! ```

#[cfg(feature = "figures")]
mod fit;
mod realisation;
mod row;
mod spread;
mod sweep;
mod table;

#[cfg(feature = "figures")]
pub use fit::Fit;
pub use realisation::{Pressed, Realisation, Shape};
pub use row::{Row, Timed};
pub use spread::{Line, Spread};
pub use sweep::Sweep;
pub use table::Table;
