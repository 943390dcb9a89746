//! What is reported of one case and one solver, and the file of all that was.

use super::case::Solved;
use super::check::Check;
use super::verdict::Verdict;
use asperity::contact::Status;
use serde::Serialize;

/// One case by one solver. There are no figures where nothing was returned.
#[derive(Serialize)]
pub struct Row {
    pub case: String,
    pub solver: &'static str,
    pub verdict: Verdict,
    /// Whether the run ended as the case demands.
    pub as_demanded: bool,
    /// What is wrong, or why it was refused or not converged.
    pub note: String,
    /// Points along y (1 for a line) and x.
    pub ny: Option<usize>,
    pub nx: Option<usize>,
    pub status: Option<Status>,
    pub iterations: Option<usize>,
    /// Fourier transforms; those of coarse grids count by their share of points.
    pub transforms: Option<u64>,
    pub seconds: Option<f64>,
    pub relative_area: Option<f64>,
    /// As the solver says.
    pub certificate: Option<f64>,
    /// As checked, like all that follow.
    pub eta: Option<f64>,
    pub penetration: Option<f64>,
    pub min_pressure: Option<f64>,
    pub load_error: Option<f64>,
    pub energy: Option<f64>,
    pub rounding: Option<f64>,
}

impl Row {
    /// A run that returned nothing.
    pub fn empty(case: String, solver: &'static str, verdict: Verdict, note: String) -> Self {
        Self {
            case,
            solver,
            verdict,
            as_demanded: false,
            note,
            ny: None,
            nx: None,
            status: None,
            iterations: None,
            transforms: None,
            seconds: None,
            relative_area: None,
            certificate: None,
            eta: None,
            penetration: None,
            min_pressure: None,
            load_error: None,
            energy: None,
            rounding: None,
        }
    }

    /// The same with what was returned and checked.
    pub fn with(self, Solved { problem, contact }: &Solved, check: &Check) -> Self {
        let [ny, nx] = problem.surface().grid().shape();
        Self {
            ny: Some(ny),
            nx: Some(nx),
            status: Some(contact.status),
            iterations: Some(contact.work.iterations),
            transforms: Some(contact.work.transforms),
            seconds: Some(contact.work.seconds),
            relative_area: Some(contact.measures(problem).relative_area),
            certificate: Some(contact.certificate.eta),
            eta: Some(check.eta),
            penetration: Some(check.penetration),
            min_pressure: Some(check.min_pressure),
            load_error: Some(check.load_error),
            energy: Some(check.energy),
            rounding: Some(check.rounding),
            ..self
        }
    }

    /// The same, measured by what the case demands.
    pub fn demanded(self, as_demanded: bool) -> Self {
        Self { as_demanded, ..self }
    }
}
