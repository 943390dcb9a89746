//! The work that a run may do.

use asperity::contact::{Observer, Step};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Ends a run after the step in which its time is up.
pub struct Budget {
    end: Instant,
}

impl Budget {
    /// Starts the clock.
    pub fn new(time: Duration) -> Self {
        Self { end: Instant::now() + time }
    }
}

impl Observer for Budget {
    fn step(&mut self, _: &Step<'_>) -> ControlFlow<()> {
        if Instant::now() < self.end { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}
