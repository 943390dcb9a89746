//! A state that outlives its step.

use super::part::Parts;
use super::scene::Fields;
use crate::contact::{Phase, Step, Work};

/// When a state was taken.
#[derive(Debug, Clone, Copy)]
pub struct Moment {
    /// Work so far.
    pub work: Work,
    /// Where in its scheme the solver stood.
    pub phase: Phase,
}

/// The fields of a step, kept until it turns out whether it was the last one of its level.
pub struct Snapshot {
    /// When it was taken.
    pub moment: Moment,
    stride: [usize; 2],
    pressure: Vec<f64>,
    gap: Vec<f64>,
}

impl Snapshot {
    /// A copy of the fields of `step` that `parts` show.
    pub fn of(step: &Step<'_>, moment: Moment, stride: [usize; 2], parts: Parts) -> Self {
        let Fields { pressure, gap, .. } = Fields::of(step, stride, parts);
        Self { moment, stride, pressure: pressure.to_vec(), gap: gap.to_vec() }
    }

    /// The fields.
    pub fn fields(&self) -> Fields<'_> {
        Fields { stride: self.stride, pressure: &self.pressure, gap: &self.gap }
    }
}
