//! The contacts of a line under all loads, one row above the other: how patches grow and merge.

use crate::record::axes::{Axis, Frame, Quantity};
use crate::record::palette::{self, colour};
use crate::record::part::Part;
use crate::record::stage::{Picture, Stage};
use rerun::{LineStrips2D, Radius, RecordingStream, RecordingStreamResult};

/// Bars of a row along the line.
const BARS: usize = 1024;
/// Share of its room that a row fills.
const FILL: f32 = 0.86;
/// Rows that there is room for at least, so that the numbers of the loads are whole.
const FEWEST: usize = 4;

/// A map of the contact, the position to the right and the load upwards. It grows with the load.
pub struct PatchMap {
    frame: Frame,
    root: String,
}

impl PatchMap {
    /// The map of a line under so many loads, if contacts are recorded.
    pub fn new(stage: &Stage, loads: usize) -> Option<Self> {
        let Picture::Line(line) = &stage.picture else { return None };
        let quantity = Quantity { symbol: "load", unit: String::new() };
        let y = Axis::new(quantity, 0.5, loads.max(FEWEST) as f64 + 0.5);
        let map = Self { frame: Frame { y, ..line.frame().clone() }, root: format!("{}/patches", stage.root) };
        stage.what.has(Part::Mask).then_some(map)
    }

    /// Root of its entities.
    pub fn root(&self) -> &str {
        &self.root
    }

    /// The part of the canvas that it takes.
    pub fn bounds(&self) -> [f64; 4] {
        self.frame.bounds()
    }

    /// Records the axes.
    pub fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.frame.log(to, &format!("{}/axes", self.root))
    }

    /// Records the contact under load number `load` at the current time, as `segments` of the width; it stays for heavier loads.
    pub fn log(&self, to: &RecordingStream, load: usize, segments: &[[[f32; 2]; 2]]) -> RecordingStreamResult<()> {
        let [below, above] = [-0.5, 0.5].map(|side| self.frame.place_y(load as f64 + 1.0 + f64::from(FILL * side)));
        let bar = self.frame.width / BARS as f32;
        let row = LineStrips2D::new(segments.iter().map(|[start, end]| hatch([start[0], end[0]], [below, above], bar)))
            .with_colors([colour(palette::CONTACT)])
            .with_radii([Radius::new_scene_units(bar)])
            .with_draw_order(10.0);
        to.log(format!("{}/row/{}", self.root, load + 1), &row)?;
        self.log_cursor(to, [below, above])
    }

    /// Brackets the current row.
    fn log_cursor(&self, to: &RecordingStream, [below, above]: [f32; 2]) -> RecordingStreamResult<()> {
        let edges = [0.0, self.frame.width].map(|x| [[x, below], [x, above]]);
        let cursor = LineStrips2D::new(edges)
            .with_colors([colour(palette::EXACT)])
            .with_radii([Radius::new_ui_points(2.0)])
            .with_draw_order(30.0);
        to.log(format!("{}/cursor", self.root), &cursor)
    }
}

/// A filled rectangle: one strip up and down, in steps of `bar`.
fn hatch([start, end]: [f32; 2], [below, above]: [f32; 2], bar: f32) -> Vec<[f32; 2]> {
    let bars = ((end - start) / bar).ceil().max(1.0) as usize;
    let ends = |i: usize| {
        let x = start + (i as f32 + 0.5) / bars as f32 * (end - start);
        if i.is_multiple_of(2) { [[x, below], [x, above]] } else { [[x, above], [x, below]] }
    };
    (0..bars).flat_map(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_is_filled_from_end_to_end_and_a_narrow_one_is_one_bar() {
        let wide = hatch([2.0, 7.0], [0.0, 1.0], 1.0);
        assert_eq!(wide.len(), 10);
        assert_eq!((wide[0], wide[1], wide[2]), ([2.5, 0.0], [2.5, 1.0], [3.5, 1.0]));
        assert_eq!(wide[9][0], 6.5);
        assert_eq!(hatch([3.0, 3.1], [0.0, 1.0], 1.0), [[3.05, 0.0], [3.05, 1.0]]);
    }
}
