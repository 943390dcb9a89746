//! Studies: setups solved under rising loads, kept in tables that a killed run resumes, and what is made of them.
//!
//! ```text
//! LoadCurve { setup, loads } --> Contacts
//! Refinement { setup, tolerance } --> Settled { setup, contact }
//! Realisation { name, setup, loads } --> Sweep --> Table (CSV) of Points --> Spread, Estimate, Limit
//! ```

mod estimate;
mod flattened;
mod identity;
mod limit;
mod load_curve;
mod point;
mod realisation;
mod refinement;
mod spread;
mod sweep;
mod table;

pub use estimate::Estimate;
pub use limit::{GridValues, Limit};
pub use load_curve::LoadCurve;
pub use point::Point;
pub use realisation::Realisation;
pub use refinement::{Refinement, Settled};
pub use spread::Spread;
pub use sweep::Sweep;
pub use table::Table;
