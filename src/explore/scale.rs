//! What the numbers of the knobs are multiplied by: results depend only on ratios to it.

/// Length of the cell, in metres.
pub(crate) const CELL: f64 = 160e-6;
/// Contact modulus, in pascals.
pub(crate) const MODULUS: f64 = 1e9;
/// Retardation time of a solid that creeps: the unit of time.
pub(crate) const RETARDATION_TIME: f64 = 1.0;
