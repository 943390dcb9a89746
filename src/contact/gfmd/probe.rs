//! Certificates of the constraint forces.

use crate::contact::{Certificate, Problem, Run, chunks};
use crate::elastic::Response;

/// The interval between checks is this fraction of the steps so far, so a run has at most two per cent of extra steps.
const RARITY: usize = 50;

/// Scales the constraint forces to the load and certifies them as a pressure, at a thinning share of the steps.
pub(super) struct Probe {
    pub response: Response,
    pressure: Vec<f64>,
    displacement: Vec<f64>,
    next: usize,
}

impl Probe {
    pub(crate) fn new(problem: &Problem) -> Self {
        let n = problem.nodes();
        let response = problem.response();
        Self { response, pressure: vec![0.0; n], displacement: vec![0.0; n], next: 0 }
    }

    /// The half-space of the probe, when all is done.
    pub(crate) fn into_response(self) -> Response {
        self.response
    }

    /// The certificate, if a check is due and anything is in contact.
    pub(crate) fn certify(&mut self, problem: &Problem, forces: &[f64], run: &mut Run<'_>) -> Option<Certificate> {
        let iteration = run.iterations();
        let load = if iteration < self.next { 0.0 } else { chunks::sum(forces.len(), |i| forces[i]) };
        if load <= 0.0 {
            return None;
        }
        self.next = iteration + 1 + iteration / RARITY;
        let scale = problem.expected_mean_pressure() * forces.len() as f64 / load;
        chunks::update(&mut self.pressure, |range, p| range.zip(p).for_each(|(i, p)| *p = scale * forces[i]));
        self.response.displacement(&self.pressure, &mut self.displacement);
        let certificate = Certificate::from_displacement(problem, &self.pressure, &self.displacement);
        run.offer(&certificate, &self.pressure);
        Some(certificate)
    }
}
