//! A state that outlives its step.

use crate::contact::{Phase, Step, Work};
use crate::record::draw::Fields;
use crate::record::parts::Parts;

/// The moment of a state.
#[derive(Debug, Clone, Copy)]
pub struct Moment {
    /// Work so far.
    pub work: Work,
    /// Place of the solver in its scheme.
    pub phase: Phase,
}

/// A copy of the fields of a step, for the case that it turns out to be the last one of its level.
pub struct Snapshot {
    /// Moment of the step.
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

    /// The fields of the step.
    pub fn fields(&self) -> Fields<'_> {
        Fields { stride: self.stride, pressure: &self.pressure, gap: &self.gap }
    }
}
