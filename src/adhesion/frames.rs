//! The frames of a motion: which of its states are kept.

use super::gap_energy::GapState;
use super::state::{AdhesiveMotion, AdhesiveState};

/// The part of the range by which some node has moved, and the share of the nodes by which the area has changed, from one frame to the next.
const MOVED: f64 = 0.1;
const AREA: f64 = 0.01;

/// The frames of a motion so far, about equally far from one another. Where they become too many, every second one is dropped.
pub(super) struct MotionFrames {
    frames: Vec<AdhesiveState>,
    /// How far a node moves, and by how many nodes the area changes, to the next frame.
    length: f64,
    nodes: f64,
    /// Gap and nodes in contact of the last frame, or of the start.
    gap: Vec<f64>,
    touching: usize,
}

impl MotionFrames {
    /// No frames yet, of a motion that begins with a state.
    pub(crate) fn new(range: f64, start: &GapState) -> Self {
        let (gap, touching) = (start.gap.clone(), touching(start));
        Self { frames: Vec::new(), length: MOVED * range, nodes: AREA * gap.len() as f64, gap, touching }
    }

    /// Whether a state is far enough from the last frame to be the next one.
    pub(crate) fn is_due(&self, state: &GapState) -> bool {
        touching(state).abs_diff(self.touching) as f64 >= self.nodes
            || state.gap.iter().zip(&self.gap).any(|(to, from)| (to - from).abs() >= self.length)
    }

    /// Keeps a frame of a state.
    pub(crate) fn keep(&mut self, state: &GapState, frame: AdhesiveState) {
        (self.gap, self.touching) = (state.gap.clone(), touching(state));
        self.frames.push(frame);
        if self.frames.len() >= AdhesiveMotion::MOST_FRAMES {
            let mut is_kept = true;
            self.frames.retain(|_| {
                is_kept = !is_kept;
                is_kept
            });
            (self.length, self.nodes) = (2.0 * self.length, 2.0 * self.nodes);
        }
    }

    /// The frames, in their order.
    pub(crate) fn into_vec(self) -> Vec<AdhesiveState> {
        self.frames
    }
}

/// The number of nodes that touch.
fn touching(state: &GapState) -> usize {
    (0..state.gap.len()).filter(|&i| state.touches(i)).count()
}
