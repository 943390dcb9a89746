//! The best state of a run.

/// The pressure that is nearest to the goals of its run among those that the method has made.
pub(super) struct Best<P = Vec<f64>> {
    /// Its distance from them, see [`crate::contact::Stop::distance`].
    pub distance: f64,
    pub pressure: Option<P>,
    found_at: usize,
}

impl<P: Clone> Best<P> {
    /// Nothing yet, at the given iteration.
    pub(crate) fn none(iteration: usize) -> Self {
        Self { distance: f64::INFINITY, pressure: None, found_at: iteration }
    }

    /// Keeps `pressure` if its distance is smaller than before.
    pub(crate) fn offer(&mut self, distance: f64, pressure: &P, iteration: usize) {
        if distance < self.distance {
            self.distance = distance;
            self.found_at = iteration;
            match &mut self.pressure {
                Some(best) => best.clone_from(pressure),
                None => self.pressure = Some(pressure.clone()),
            }
        }
    }

    /// Whether nothing better has been found for `patience` iterations, besides as many again as it took to find this.
    pub(crate) fn is_stale(&self, iteration: usize, patience: usize) -> bool {
        iteration > 2 * self.found_at + patience
    }
}
