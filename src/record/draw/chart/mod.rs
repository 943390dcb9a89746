//! Curves: numbers of every step, and numbers over loads.

pub mod curves;
pub mod figure;
pub mod ghost;
pub mod load_axis;
pub mod load_chart;
pub mod observable_traces;
mod ritz;
pub mod survey_figure;
pub mod traces;

use super::drawing::{Bytes, PartRow};
use crate::setup::Part;

/// The parts of this group.
pub const PARTS: &[PartRow] = &[
    // some twelve numbers of a step and the times that go with each, packed
    PartRow { part: Part::Traces, draw: traces::draw, bytes: |_| Bytes { step: 200.0, ..Bytes::default() } },
    PartRow { part: Part::Ritz, draw: ritz::draw, bytes: |_| Bytes::default() },
];
