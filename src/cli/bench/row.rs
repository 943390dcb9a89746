//! What is reported of one case and one solver, and the file of all that was.

use super::case::{Case, Group};
use asperity::contact::{Contact, Problem, Status};
use serde::Serialize;

/// One case solved by one solver.
#[derive(Serialize)]
pub struct Row {
    pub group: Group,
    pub case: String,
    /// Points along y (1 for a line) and x.
    pub ny: usize,
    pub nx: usize,
    pub solver: &'static str,
    pub status: Status,
    pub iterations: usize,
    /// Fourier transforms; those of coarse grids count by their share of points.
    pub transforms: u64,
    /// Median over the repeats.
    pub solve_seconds: f64,
    /// Of making the surface and posing the problem.
    pub make_seconds: f64,
    pub certificate: f64,
    pub relative_area: f64,
    pub kappa_r_corrected: f64,
    /// While the surface was made and solved.
    pub peak_mib: Option<f64>,
    /// Seconds over those of the first solver of the case, if there are several.
    pub ratio: Option<f64>,
}

/// A case made and solved.
pub struct Solved {
    pub problem: Problem,
    pub make_seconds: f64,
    /// Of the last repeat.
    pub contact: Contact,
    /// Of every repeat, one at the least.
    pub solve_seconds: Vec<f64>,
}

impl Row {
    /// What is to be told of `solved`.
    pub fn of(group: Group, case: &Case, solved: &Solved, peak_mib: Option<f64>) -> Self {
        let Solved { problem, contact, .. } = solved;
        let measures = contact.measures(problem);
        let [ny, nx] = problem.surface().grid().shape();
        Self {
            group,
            case: case.name.clone(),
            ny,
            nx,
            solver: contact.solver,
            status: contact.status,
            iterations: contact.work.iterations,
            transforms: contact.work.transforms,
            solve_seconds: median(&solved.solve_seconds),
            make_seconds: solved.make_seconds,
            certificate: contact.certificate.eta,
            relative_area: measures.relative_area,
            kappa_r_corrected: measures.kappa_r_corrected,
            peak_mib,
            ratio: None,
        }
    }

    /// The same, held against the seconds of another solver.
    pub fn against(self, seconds: f64) -> Self {
        Self { ratio: Some(self.solve_seconds / seconds), ..self }
    }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}
