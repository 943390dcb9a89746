//! Vectors that are used again.

/// Vectors of at most a given length that are not needed at the moment.
///
/// A long vector that is freed goes back to the operating system, which clears each page of the next one. On large contacts that took
/// up to half of the time of a solve.
pub(super) struct Workspace {
    longest: usize,
    spare: Vec<Vec<f64>>,
}

impl Workspace {
    /// No vectors yet; none will have more than `longest` entries.
    pub(crate) fn new(longest: usize) -> Self {
        Self { longest, spare: Vec::new() }
    }

    /// A vector of `length` zeros.
    pub(crate) fn zeros(&mut self, length: usize) -> Vec<f64> {
        let mut vector = self.spare.pop().unwrap_or_else(|| Vec::with_capacity(self.longest));
        vector.clear();
        vector.resize(length, 0.0);
        vector
    }

    /// Keeps vectors for later use.
    pub(crate) fn keep(&mut self, vectors: impl IntoIterator<Item = Vec<f64>>) {
        self.spare.extend(vectors);
    }
}
