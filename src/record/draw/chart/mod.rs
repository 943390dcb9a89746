//! Curves: numbers of every step, and numbers over loads.

pub(crate) mod curves;
pub(crate) mod figure;
pub(crate) mod ghost;
pub(crate) mod load_axis;
pub(crate) mod load_chart;
pub(crate) mod observable_traces;
mod ritz;
pub(crate) mod survey_figure;
pub(crate) mod traces;

use super::drawing::{Bytes, PartRow};
use crate::setup::Part;

/// The parts of this group.
pub(crate) const PARTS: &[PartRow] = &[
    // some twelve numbers of a step and the times that go with each, packed
    PartRow { part: Part::Traces, draw: traces::draw, bytes: |_| Bytes { step: 200.0, ..Bytes::default() } },
    PartRow { part: Part::Ritz, draw: ritz::draw, bytes: |_| Bytes::default() },
];
