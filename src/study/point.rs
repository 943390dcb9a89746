//! A solved point of a study.

use crate::contact::{Observables, Status};
use serde::{Deserialize, Serialize};

/// A solved point: a realisation under one of its loads, how the solver ended, and what was found.
///
/// The fields are columns of a table, and so are those of its observables. What tells the points of one realisation from
/// those of others is its name, the fingerprint of its setup, and the version of the program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Name of the realisation.
    pub name: String,
    /// Points along y; 1 for lines.
    pub ny: usize,
    /// Points along x.
    pub nx: usize,
    /// Length of the cell along x.
    pub length: f64,
    /// Hurst exponent.
    pub hurst: Option<f64>,
    /// Roll-off wavelength, a length.
    pub rolloff_wavelength: Option<f64>,
    /// Short cut-off wavelength, a length.
    pub short_cutoff: Option<f64>,
    /// Seed of the random surface.
    pub seed: Option<u64>,
    /// Number of the load in its realisation, from 1.
    pub load: usize,
    /// Certificate `eta` that was asked for.
    pub tolerance: f64,
    /// How the solver stopped.
    pub status: Status,
    /// Fingerprint of the setup.
    pub setup: String,
    /// Version of the program.
    pub version: String,
    /// The numbers that were found.
    #[serde(skip)]
    pub observables: Observables,
    /// Seconds of the solver, which are never the same twice.
    #[serde(skip)]
    pub seconds: f64,
}

impl Point {
    /// Whether the certificate met the tolerance; what did not is kept in tables and left out of averages.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }
}
