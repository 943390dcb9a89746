//! The size of a recording.

use super::draw::{CUT_PIXELS, Columns, has_contour, pixels, vertices};
use super::file::Schedule;
use super::parts::Parts;
use crate::grid::Grid;
use crate::setup::Part;

/// The parts that are drawn at the recorded steps.
const FRAMED: [Part; 8] =
    [Part::Profile, Part::Fields, Part::Mask, Part::Mesh, Part::Spectrum, Part::Error, Part::Stress, Part::Fringes];

/// Bytes of a recording, about: packing makes the pictures smaller by up to half, most at low loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// Everything that does not change: layout, text and axes.
    pub still: f64,
    /// The pictures of a frame.
    pub frame: f64,
    /// Some twelve numbers of a step and the times that go with each, packed.
    pub step: f64,
    schedule: Schedule,
}

impl Size {
    /// The size of `parts`, as far as a scene on `grid` can show them.
    pub fn of(parts: Parts, grid: &Grid) -> Self {
        let parts = parts.and(Parts::on(grid));
        let bytes = |part: Part| if parts.has(part) { bytes(part, grid) } else { 0.0 };
        Self {
            still: 150e3
                + [Part::Raster, Part::Waterfall, Part::Energy]
                    .map(|part| if parts.has(part) { still(part, grid) } else { 0.0 })
                    .iter()
                    .sum::<f64>(),
            frame: FRAMED.map(bytes).iter().sum(),
            step: if parts.has(Part::Traces) { 200.0 } else { 0.0 } + if parts.has_instruments() { 60.0 } else { 0.0 },
            schedule: Schedule::on(grid),
        }
    }

    /// Frames of the automatic schedule at the most, of so many steps on the finest grid above `coarser` ones.
    pub fn frames(&self, steps: usize, coarser: usize) -> usize {
        self.schedule.most_frames(steps, coarser)
    }
}

/// Bytes of the images of a whole run, which are written anew whenever it has become twice as long.
fn still(part: Part, grid: &Grid) -> f64 {
    let rows = 2.0 * (grid.len() as f64).log2();
    match (part, grid.is_line()) {
        (Part::Raster, true) => 100e3,
        (Part::Raster, false) => 200e3 + 4.0 * pixels(grid) as f64,
        (Part::Waterfall, _) => 2.0 * 6e3 * rows,
        (Part::Energy, _) => 6e3 * rows,
        _ => 0.0,
    }
}

/// Bytes of a part in a frame, which are single precision but for the classes of a mask.
fn bytes(part: Part, grid: &Grid) -> f64 {
    let points = grid.len().min(2 * Columns::MOST) as f64;
    let [pixels, vertices] = [pixels(grid), vertices(grid)].map(|count| count as f64);
    match (part, grid.is_line()) {
        (Part::Profile, _) => 12.0 * points,
        (Part::Fields, true) => 16.0 * points + 40.0 * Columns::new(grid.len()).count() as f64,
        (Part::Fields, false) => 8.0 * pixels,
        (Part::Mask, true) => points,
        // the classes, packed, and some lines of the contour where there is one
        (Part::Mask, false) if has_contour(grid) => 1.3 * pixels,
        (Part::Mask, false) => 0.1 * pixels,
        (Part::Mesh, _) => 28.0 * vertices,
        (Part::Spectrum, _) => 2e3,
        (Part::Error, true) => 12.0 * points,
        (Part::Error, false) => 4.0 * pixels,
        (Part::Stress | Part::Fringes, _) => (4 * CUT_PIXELS) as f64,
        (Part::Traces | Part::Raster | Part::Waterfall | Part::Energy | Part::Decisions | Part::Ritz, _) => 0.0,
    }
}
