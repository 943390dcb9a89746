//! The contacts of a line under all loads, one row above the other: how patches grow and merge.

use crate::plot::AxesFrame;
use crate::record::draw::chart::load_axis::LoadAxis;
use crate::record::draw::fields::FrameFields;
use crate::record::draw::ink::canvas::{self, style};
use crate::record::draw::ink::fill::zigzag;
use crate::record::draw::ink::line_plane::LinePlane;
use crate::record::draw::ink::pane::Pane;
use rerun::{Radius, RecordingStream, RecordingStreamResult, Transform3D};
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Half of the width of the bars that fill a row: in a small window still wide enough to leave no pixel out.
const BAR: f32 = 2.0;
/// Share of its room that a row leaves free, and the room from which on it does so.
const FREE: f32 = 0.14;
const ROOMY: f32 = 12.0;

/// A map of the contact, the position to the right and the load upwards. It grows with the load.
pub(crate) struct PatchMap {
    frame: AxesFrame,
    plane: LinePlane,
    root: String,
    /// The name of the quantity along the loads.
    along: String,
    /// The lower and the upper end of the row of each load on the canvas, as it was drawn.
    drawn: Mutex<BTreeMap<usize, [f32; 2]>>,
}

impl PatchMap {
    /// The map of a line under `loads`, on the canvas of its pictures.
    pub(crate) fn new(plane: &LinePlane, loads: &LoadAxis) -> Self {
        let frame = plane.frame_with(&loads.whole());
        let root = format!("{}/patches", plane.root);
        Self { frame, plane: plane.clone(), root, along: loads.name.clone(), drawn: Mutex::default() }
    }

    /// Takes the proportions of its pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        self.plane.fit(pane);
        self.frame = self.plane.frame_with(&self.frame.y);
    }

    /// The view of the map.
    pub(crate) fn pane(&self) -> Pane {
        self.plane.pane("patches", &format!("Contact patches against {}", self.along), false)
    }

    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.plane.log_measured(to, "patches")?;
        canvas::log_axes(to, self.plane.palette, &format!("{}/axes", self.root), &self.frame)
    }

    /// Records the contact under load number `load` of an axis at the current time; it stays for heavier loads.
    pub(crate) fn log(
        &self,
        to: &RecordingStream,
        (load, loads): (usize, &LoadAxis),
        fields: &FrameFields<'_>,
    ) -> RecordingStreamResult<()> {
        let Some(ends) = ends(&self.frame, loads, load) else { return Ok(()) };
        self.drawn().insert(load, ends);
        let row = style(self.plane.palette.contact, Radius::new_scene_units(BAR), 10.0);
        let row = row.with_strips(self.plane.segments(fields).into_iter().map(|segment| filled(segment, ends)));
        to.log(self.row(load), &row)?;
        self.log_cursor(to, ends)
    }

    /// Marks the row of the current load on both sides.
    fn log_cursor(&self, to: &RecordingStream, ends: [f32; 2]) -> RecordingStreamResult<()> {
        let width = self.frame.size[0] as f32;
        let cursor = style(self.plane.palette.ink, Radius::new_ui_points(2.0), 30.0);
        let sides = [0.0, width].map(|x| ends.map(|y| [x, y]));
        to.log(format!("{}/cursor", self.root), &cursor.with_strips(sides))
    }

    /// Stretches the map to the loads that came, for all times. Where the rooms of rows were not known when they were drawn, since the loads after
    /// them had not come, each is moved to its own place and marked again at the times to which `turn` goes.
    pub(crate) fn settle(
        &self,
        to: &RecordingStream,
        turn: &dyn Fn(&RecordingStream, usize),
        loads: &LoadAxis,
    ) -> RecordingStreamResult<()> {
        let drawn = self.drawn();
        let frame = AxesFrame { y: loads.over(drawn.keys().copied()), ..self.frame.clone() };
        canvas::log_axes(to, self.plane.palette, &format!("{}/axes", self.root), &frame)?;
        if drawn.iter().all(|(load, own)| ends(&self.frame, loads, *load) == Some(*own)) {
            let [from, onto] =
                [&self.frame, &frame].map(|it| frame.y.range.map(|end| it.position([0.0, it.y.place(end)])[1] as f32));
            let stretched = ["row", "cursor"].map(|name| format!("{}/{name}", self.root));
            return stretched.into_iter().try_for_each(|entity| to.log_static(entity, &stretch(from, onto)));
        }
        for (&load, &own) in drawn.iter() {
            let Some(settled) = ends(&frame, loads, load) else { continue };
            to.log_static(self.row(load), &stretch(own, settled))?;
            turn(to, load);
            self.log_cursor(to, settled)?;
        }
        Ok(())
    }

    /// The entity of the row of a load.
    fn row(&self, load: usize) -> String {
        format!("{}/row/{}", self.root, load + 1)
    }

    fn drawn(&self) -> MutexGuard<'_, BTreeMap<usize, [f32; 2]>> {
        self.drawn.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The transform that carries one range of heights on the canvas onto another one.
fn stretch(from: [f32; 2], onto: [f32; 2]) -> Transform3D {
    let stretch = (onto[0] - onto[1]) / (from[0] - from[1]);
    Transform3D::from_translation([0.0, onto[1] - stretch * from[1], 0.0]).with_scale([1.0, stretch, 1.0])
}

/// The lower and the upper end of the row of a load in a frame, with some room free beside its neighbours.
fn ends(frame: &AxesFrame, loads: &LoadAxis, load: usize) -> Option<[f32; 2]> {
    let [bottom, top] = loads.room(load)?.map(|end| frame.position([0.0, frame.y.place(end)])[1] as f32);
    let free = if bottom - top > ROOMY { 0.5 * FREE * (bottom - top) + BAR } else { 0.0 };
    let ends = [bottom - free, top + free];
    (ends[0] > ends[1]).then_some(ends)
}

/// Bars between the heights `ends`, side by side from `left` to `right` so that they do not stick out; one or two where that
/// is narrower than they are.
fn filled([left, right]: [f32; 2], ends: [f32; 2]) -> Vec<[f32; 2]> {
    let reach = (0.5 * (right - left) - BAR).max(0.0);
    let steps = (2.0 * reach / BAR).ceil().max(1.0);
    let (middle, half_pitch) = (left.midpoint(right), reach / steps);
    let outer = reach + half_pitch;
    zigzag([middle - outer, middle + outer], steps as usize + 1, |_, _| ends)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_fill_a_patch_from_side_to_side_and_no_more() {
        let points = filled([10.0, 31.0], [60.0, 40.0]);
        let ends = |axis: usize| {
            let values = points.iter().map(|point| point[axis]);
            values.fold([f32::MAX, f32::MIN], |[low, high], value| [low.min(value), high.max(value)])
        };
        for (found, expected) in [(ends(0), [10.0 + BAR, 31.0 - BAR]), (ends(1), [40.0, 60.0])] {
            assert!((0..2).all(|end| (found[end] - expected[end]).abs() < 1e-4), "{found:?}");
        }
        assert!(points.windows(2).all(|pair| (pair[1][0] - pair[0][0]).abs() < 1.01 * BAR));
        let narrow = filled([5.0, 5.5], [60.0, 40.0]);
        assert!(narrow.iter().all(|point| (point[0] - 5.25).abs() < 1e-4), "{narrow:?}");
    }
}
