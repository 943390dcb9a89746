//! Pictures of the fields of a scene.

use super::eye::Eye;
use super::fields::{Extent, Fields};
use crate::plot::Frame;
use rerun::{RecordingStream, RecordingStreamResult};

/// The pictures of the fields of a scene: those of a line or those of a surface.
pub trait Picture: Send + Sync {
    /// The frame above which captions stand.
    fn frame(&self) -> &Frame;

    /// Gives the flat pictures the proportions of a pane of so many points, before anything is recorded.
    fn fit(&mut self, pane: [f64; 2]);

    /// Gives the picture in space the proportions of a pane of so many points.
    fn fit_relief(&mut self, _pane: [f64; 2]) {}

    /// The root of the picture in space and the eye that sees it, if there is one.
    fn relief(&self) -> Option<(&str, Eye)> {
        None
    }

    /// The part of the canvas that each flat picture takes: left, right, top, bottom.
    fn bounds(&self) -> [f64; 4];

    /// Records axes, styles and everything else that stays.
    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()>;

    /// Records a state at the current time.
    fn log_frame(&self, to: &RecordingStream, fields: &Fields<'_>) -> RecordingStreamResult<()>;

    /// Records the pressure of an earlier solve along the same line, on any number of nodes.
    fn log_ghost(&self, _to: &RecordingStream, _pressure: &[f64]) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// The reach of the fields of a state.
    fn extent(&self, fields: &Fields<'_>) -> Extent;

    /// Fits axes and scales to some states, for all times.
    fn settle(&self, to: &RecordingStream, extent: Extent) -> RecordingStreamResult<()>;

    /// The contact of a line, as the ends of segments of the width of its frame.
    fn segments(&self, _fields: &Fields<'_>) -> Vec<[f32; 2]> {
        Vec::new()
    }
}
