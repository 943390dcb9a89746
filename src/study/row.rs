//! A solved point of a study.

use super::realisation::Realisation;
use crate::contact::{Contact, Problem, Status, Stop};
use serde::{Deserialize, Serialize};

/// Version of the program.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A solved point: the surface, the load, what was measured, and how good it is. Its fields are the columns of a table.
///
/// Areas are relative, pressures are over `E*`, gaps over the rms height; `corrected` is what is left after subtracting
/// the excess of counted nodes, see [`crate::contact::Measures`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
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
    /// `p*`, as prescribed.
    pub reduced_pressure: f64,
    /// `p_r*`.
    pub reduced_pressure_contact: f64,
    /// `a_rel`, nodes counted.
    pub relative_area: f64,
    /// `a_rel`, corrected.
    pub relative_area_corrected: f64,
    /// `gbar`.
    pub rms_gradient: f64,
    /// `gbar_r`.
    pub rms_gradient_contact: f64,
    /// `a_rel/p*`.
    pub kappa: f64,
    /// `a_rel/p*`, corrected.
    pub kappa_corrected: f64,
    /// `a_rel/p_r*`.
    pub kappa_r: f64,
    /// `a_rel/p_r*`, corrected.
    pub kappa_r_corrected: f64,
    /// Mean gap over the rms height.
    pub mean_gap: f64,
    /// Largest pressure over `E*`.
    pub max_pressure: f64,
    /// Contact patches.
    pub patches: usize,
    /// Certificate `eta` that was asked for.
    pub tolerance: f64,
    /// Certificate `eta` that was reached.
    pub certificate: f64,
    /// Bound on the relative error of the pressure.
    pub pressure_error_bound: f64,
    /// Steps of the solver.
    pub iterations: usize,
    /// Fourier transforms.
    pub transforms: u64,
    /// How the solver stopped.
    pub status: Status,
    /// Version of the program.
    pub version: String,
}

/// A point and the seconds that the solver took for it, which are never the same twice.
#[derive(Debug, Clone, PartialEq)]
pub struct Timed {
    /// The point.
    pub row: Row,
    /// Seconds of the solver.
    pub seconds: f64,
}

/// What tells the rows of one realisation from those of others.
#[derive(PartialEq)]
pub(super) struct Identity<'a> {
    name: &'a str,
    shape: [usize; 2],
    length: f64,
    hurst: Option<f64>,
    wavelengths: [Option<f64>; 2],
    seed: Option<u64>,
    tolerance: f64,
    version: &'a str,
}

impl<'a> Identity<'a> {
    pub fn of(realisation: &'a Realisation, tolerance: f64) -> Self {
        let roughness = realisation.roughness();
        let spectrum = roughness.map(|(spectrum, _)| spectrum);
        Self {
            name: &realisation.name,
            shape: realisation.grid.shape(),
            length: realisation.grid.size()[1],
            hurst: spectrum.map(|spectrum| spectrum.hurst),
            wavelengths: [
                spectrum.map(|spectrum| spectrum.rolloff_wavelength),
                spectrum.map(|spectrum| spectrum.short_cutoff),
            ],
            seed: roughness.map(|(_, seed)| seed),
            tolerance,
            version: VERSION,
        }
    }
}

impl Row {
    /// What `contact` shows under load number `load` (from 0) of `realisation`.
    pub(super) fn of(
        realisation: &Realisation,
        load: usize,
        stop: &Stop,
        problem: &Problem,
        contact: &Contact,
    ) -> Self {
        let Identity { name, shape: [ny, nx], length, hurst, wavelengths, seed, tolerance, version } =
            Identity::of(realisation, stop.tolerance());
        let measures = contact.measures();
        let reduced_pressure = realisation.loads[load];
        Self {
            name: name.into(),
            ny,
            nx,
            length,
            hurst,
            rolloff_wavelength: wavelengths[0],
            short_cutoff: wavelengths[1],
            seed,
            load: load + 1,
            reduced_pressure,
            reduced_pressure_contact: measures.reduced_pressure_contact,
            relative_area: measures.relative_area,
            relative_area_corrected: measures.relative_area_corrected,
            rms_gradient: measures.rms_gradient,
            rms_gradient_contact: measures.rms_gradient_contact,
            kappa: measures.kappa,
            kappa_corrected: measures.relative_area_corrected / measures.reduced_pressure,
            kappa_r: measures.kappa_r,
            kappa_r_corrected: measures.kappa_r_corrected,
            mean_gap: contact.mean_gap() / problem.rms_height(),
            max_pressure: contact.max_pressure() / problem.contact_modulus(),
            patches: contact.patches().count(),
            tolerance,
            certificate: contact.certificate.eta,
            pressure_error_bound: contact.certificate.pressure_error_bound,
            iterations: contact.work.iterations,
            transforms: contact.work.transforms,
            status: contact.status,
            version: version.into(),
        }
    }

    /// What tells its realisation from others.
    pub(super) fn identity(&self) -> Identity<'_> {
        Identity {
            name: &self.name,
            shape: [self.ny, self.nx],
            length: self.length,
            hurst: self.hurst,
            wavelengths: [self.rolloff_wavelength, self.short_cutoff],
            seed: self.seed,
            tolerance: self.tolerance,
            version: &self.version,
        }
    }

    /// Whether the certificate met the tolerance; what did not is kept in tables and left out of averages.
    pub fn is_converged(&self) -> bool {
        self.status == Status::Converged
    }
}
