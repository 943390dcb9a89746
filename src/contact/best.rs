//! The best state of a run.

/// The pressure with the smallest certificate among those that the method has made.
pub(super) struct Best<P = Vec<f64>> {
    pub eta: f64,
    pub pressure: Option<P>,
    found_at: usize,
}

impl<P: Clone> Best<P> {
    /// Nothing yet, at the given iteration.
    pub fn none(iteration: usize) -> Self {
        Self { eta: f64::INFINITY, pressure: None, found_at: iteration }
    }

    /// Keeps `pressure` if `eta` is smaller than before.
    pub fn offer(&mut self, eta: f64, pressure: &P, iteration: usize) {
        if eta < self.eta {
            self.eta = eta;
            self.found_at = iteration;
            match &mut self.pressure {
                Some(best) => best.clone_from(pressure),
                None => self.pressure = Some(pressure.clone()),
            }
        }
    }

    /// Whether nothing better has been found for `patience` iterations, besides as many again as it took to find this.
    pub fn is_stale(&self, iteration: usize, patience: usize) -> bool {
        iteration > 2 * self.found_at + patience
    }
}
