//! When a search for a state ends.

/// The tolerance at which a search has found a state, and the steps after which it gives up.
#[derive(Debug, Clone, Copy)]
pub(super) struct SearchLimits {
    /// Largest residual, over the strength or the range of the attraction.
    pub tolerance: f64,
    /// Most steps.
    pub steps: usize,
}
