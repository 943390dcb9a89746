//! The best state of a run.

use crate::contact::Problem;

/// The pressure with the smallest certificate among those that the method has made. Until there is one, the uniform pressure,
/// which is always feasible.
pub(super) struct Best {
    pub eta: f64,
    pub pressure: Vec<f64>,
    found_at: usize,
}

impl Best {
    pub fn new(problem: &Problem) -> Self {
        Self { eta: f64::INFINITY, pressure: vec![problem.expected_mean_pressure(); problem.nodes()], found_at: 0 }
    }

    /// Keeps `pressure` if `eta` is smaller than before.
    pub fn offer(&mut self, eta: f64, pressure: &[f64], iteration: usize) {
        if eta < self.eta {
            self.eta = eta;
            self.pressure.copy_from_slice(pressure);
            self.found_at = iteration;
        }
    }

    /// Whether nothing better has been found for `patience` iterations, besides as many again as it took to find this.
    pub fn is_stale(&self, iteration: usize, patience: usize) -> bool {
        iteration > 2 * self.found_at + patience
    }
}
