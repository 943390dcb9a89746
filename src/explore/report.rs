//! The state of a session as the page is told.

use super::knobs::Knobs;
use crate::contact::{Contact, Measures, Step, Work};
use crate::setup::{Setup, command};
use crate::theory::Exact;
use serde::Serialize;

/// The state of a session.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Report {
    /// Grows with every change.
    pub revision: u64,
    /// Whether something is being solved.
    pub busy: bool,
    /// The latest solve.
    pub run: Option<RunReport>,
    /// The latest sweep over the load.
    pub sweep: Option<SweepReport>,
    /// Name of the recording whose curves stand beside those of new ones.
    pub pinned: Option<String>,
    /// Why the last order was not carried out, in one sentence.
    pub fault: Option<String>,
}

/// A solve, running or ended.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// Name of its recording.
    pub id: String,
    /// Name for people.
    pub title: String,
    /// The command that repeats it.
    pub command: String,
    /// The setup that repeats it, in TOML.
    pub setup: String,
    /// The state of the knobs.
    pub knobs: Knobs,
    /// Whether it and its recording are complete.
    pub ended: bool,
    /// Where it stands.
    pub numbers: Option<Numbers>,
    /// Exact values.
    pub exact: Option<ExactNumbers>,
}

/// Exact values of a contact.
#[derive(Debug, Clone, Serialize)]
pub struct ExactNumbers {
    /// Name of the theory.
    pub name: &'static str,
    /// Share of the area in contact.
    pub relative_area: f64,
    /// `kappa_r`.
    pub kappa_r: Option<f64>,
}

/// The numbers of a state; infinite ones are null in JSON.
#[derive(Debug, Clone, Serialize)]
pub struct Numbers {
    /// How the solve ended, or that it runs.
    pub status: String,
    /// `p*`.
    pub reduced_pressure: f64,
    /// Share of the nodes in contact.
    pub relative_area: f64,
    /// Share of the area in contact: less the excess of counting nodes.
    pub relative_area_corrected: f64,
    /// `kappa = a_rel / p*`.
    pub kappa: f64,
    /// `kappa_r`.
    pub kappa_r: f64,
    /// `kappa_r` with the corrected area.
    pub kappa_r_corrected: f64,
    /// Mean gap over the rms height.
    pub mean_gap: f64,
    /// Contact patches.
    pub patches: usize,
    /// The certificate, as far as it is known.
    pub certificate: Option<f64>,
    /// Bound of the relative error of the pressure, of an ended solve.
    pub pressure_error_bound: Option<f64>,
    /// Grid level of a running solve.
    pub level: usize,
    /// Steps.
    pub iterations: usize,
    /// Transforms.
    pub transforms: u64,
    /// Seconds of the solver, recording left out.
    pub seconds: f64,
}

/// A sweep over the load.
#[derive(Debug, Clone, Serialize)]
pub struct SweepReport {
    /// Name of its recording.
    pub id: String,
    /// Name for people.
    pub title: String,
    /// The state of the knobs; the load does not count.
    pub knobs: Knobs,
    /// Whether it and its recording are complete.
    pub ended: bool,
    /// Its contacts, from the smallest load on.
    pub points: Vec<SweepPoint>,
}

/// A contact of a sweep, and what theories say.
#[derive(Debug, Clone, Serialize)]
pub struct SweepPoint {
    /// `p*`.
    pub load: f64,
    /// Share of the area in contact, corrected.
    pub area: f64,
    /// `kappa`, of the corrected area.
    pub kappa: f64,
    /// `kappa_r`, of the corrected area.
    pub kappa_r: f64,
    /// Persson's relative area.
    pub persson: f64,
    /// Exact values.
    pub exact: Option<ExactNumbers>,
}

impl RunReport {
    /// A solve that begins.
    pub fn new(id: String, knobs: Knobs, setup: &Setup, exact: Option<&Exact>) -> Self {
        Self {
            id,
            title: format!("{}, p* = {:.3e}", setup.title(), knobs.load),
            command: command(setup),
            setup: setup.to_toml(),
            knobs,
            ended: false,
            numbers: None,
            exact: exact.map(ExactNumbers::from),
        }
    }
}

impl From<&Exact> for ExactNumbers {
    fn from(exact: &Exact) -> Self {
        Self { name: exact.name, relative_area: exact.relative_area, kappa_r: exact.kappa_r }
    }
}

impl Numbers {
    /// The numbers of a step.
    pub fn of_step(step: &Step<'_>) -> Self {
        let (problem, phase) = (step.problem(), step.phase());
        Self {
            level: phase.level,
            certificate: step.certificate(),
            mean_gap: step.mean_gap() / problem.rms_height(),
            patches: step.patches().count(),
            ..Self::measured(step.measures(), step.work(), "running".into())
        }
    }

    /// The numbers of a result.
    pub fn of_contact(contact: &Contact) -> Self {
        Self {
            certificate: Some(contact.certificate.eta),
            pressure_error_bound: Some(contact.certificate.pressure_error_bound),
            mean_gap: contact.mean_gap() / contact.problem.rms_height(),
            patches: contact.patches().count(),
            ..Self::measured(&contact.measures(), contact.work, contact.status.to_string())
        }
    }

    fn measured(measures: &Measures, work: Work, status: String) -> Self {
        Self {
            status,
            reduced_pressure: measures.reduced_pressure,
            relative_area: measures.relative_area,
            relative_area_corrected: measures.relative_area_corrected,
            kappa: measures.kappa,
            kappa_r: measures.kappa_r,
            kappa_r_corrected: measures.kappa_r_corrected,
            mean_gap: f64::NAN,
            patches: 0,
            certificate: None,
            pressure_error_bound: None,
            level: 0,
            iterations: work.iterations,
            transforms: work.transforms,
            seconds: work.seconds,
        }
    }
}
