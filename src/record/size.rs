//! The size of a recording.

use super::draw;
use super::file::Schedule;
use super::parts::Parts;
use crate::grid::Grid;

/// Bytes of layout and text.
const LAYOUT: f64 = 150e3;
/// Bytes of the line at the current step in the pictures of a run.
const CURSOR: f64 = 60.0;

/// Bytes of a recording, about: packing makes the pictures smaller by up to half, most at low loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Everything that does not change: layout, text and axes.
    pub still: f64,
    /// The pictures of a frame.
    pub frame: f64,
    /// The numbers of a step.
    pub step: f64,
    /// The pictures of a contact, which its steps do not have.
    pub contact: f64,
    schedule: Schedule,
}

impl Size {
    /// The size of `parts`, as far as a scene on `grid` can show them.
    pub fn new(parts: Parts, grid: &Grid) -> Self {
        let parts = parts.and(Parts::on(grid));
        let bytes = || draw::parts().filter(|row| parts.has(row.part)).map(|row| (row.bytes)(grid));
        Self {
            still: LAYOUT + bytes().map(|bytes| bytes.still).sum::<f64>(),
            frame: bytes().map(|bytes| bytes.frame).sum(),
            contact: bytes().map(|bytes| bytes.contact).sum(),
            step: bytes().map(|bytes| bytes.step).sum::<f64>() + if parts.has_instruments() { CURSOR } else { 0.0 },
            schedule: Schedule::on(grid),
        }
    }

    /// Largest number of frames of the automatic schedule, for a number of steps on the finest grid above `coarser`
    /// ones.
    pub fn frames(&self, steps: usize, coarser: usize) -> usize {
        self.schedule.most_frames(steps, coarser)
    }
}
