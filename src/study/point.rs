//! A solved point of a study.

use super::realisation::Realisation;
use crate::contact::{Contact, Observables, Status};
use crate::error::StudyError;
use serde::{Deserialize, Serialize};

/// Version of the program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

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
    /// What was found.
    #[serde(skip)]
    pub observables: Observables,
    /// Seconds of the solver, which are never the same twice.
    #[serde(skip)]
    pub seconds: f64,
}

/// What tells the points of one realisation from those of others.
#[derive(PartialEq)]
pub(super) struct Identity<'a> {
    name: &'a str,
    setup: String,
    loads: &'a [f64],
}

impl<'a> Identity<'a> {
    /// The identity of a realisation.
    ///
    /// # Errors
    /// For a height file that cannot be read.
    pub fn of(realisation: &'a Realisation) -> Result<Self, StudyError> {
        let Realisation { name, setup, loads } = realisation;
        Ok(Self { name, setup: setup.fingerprint()?, loads })
    }

    /// Whether a point is one of the realisation.
    pub fn includes(&self, point: &Point) -> bool {
        let is_it = (self.name, self.setup.as_str(), VERSION) == (&point.name, &point.setup, &point.version);
        is_it && self.loads.contains(&point.observables.reduced_pressure)
    }

    /// The points of the realisation among those of a table, if they are all there, one after the other.
    pub fn find(&self, points: &[Point]) -> Option<Vec<Point>> {
        let is_it = |points: &&[Point]| {
            let loads = points.iter().map(|point| point.observables.reduced_pressure);
            loads.eq(self.loads.iter().copied()) && points.iter().all(|point| self.includes(point))
        };
        points.windows(self.loads.len().max(1)).find(is_it).map(<[Point]>::to_vec)
    }

    /// The point of a contact of `realisation` under its load of number `load`, from 1.
    pub fn point(&self, realisation: &Realisation, load: usize, contact: &Contact) -> Point {
        let grid = contact.problem.surface().grid();
        let ([ny, nx], [_, length]) = (grid.shape(), grid.size());
        let recipe = &realisation.setup.surface;
        let spectrum = recipe.spectrum;
        Point {
            name: self.name.into(),
            ny,
            nx,
            length,
            hurst: spectrum.map(|spectrum| spectrum.hurst),
            rolloff_wavelength: spectrum.map(|spectrum| spectrum.rolloff_wavelength),
            short_cutoff: spectrum.map(|spectrum| spectrum.short_cutoff),
            seed: spectrum.map(|_| recipe.seed()),
            load,
            tolerance: realisation.setup.stop.tolerance(),
            status: contact.status,
            setup: self.setup.clone(),
            version: VERSION.into(),
            observables: Observables::of(contact),
            seconds: contact.work.seconds,
        }
    }
}

impl Point {
    /// Whether the certificate met the tolerance; what did not is kept in tables and left out of averages.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }
}
