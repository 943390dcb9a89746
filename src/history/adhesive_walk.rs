//! The steps of a history with adhesion from one point of its path to the next.

use crate::adhesion::AdhesiveState;
use crate::contact::{ResultClaim, Work};
use crate::error::AdhesionError;

/// The part of a step of the path below which a step is not halved again.
const FINEST: f64 = 1e-3;

/// The part of a load that pulls by which the last state that holds may lie below the one that parts the surfaces.
const PULL_OFF: f64 = 1e-3;

/// The part of a step of the path below which a step towards a pull-off is not halved again.
const LEAST: f64 = 1e-9;

/// A place on the path.
#[derive(Clone)]
pub(super) enum AdhesivePlace {
    State(Box<AdhesiveState>),
    /// The surfaces have parted.
    Apart,
}

/// Where a step leads.
pub(super) struct AdhesiveStep {
    pub place: AdhesivePlace,
    /// The frames of the motion, with the method `gfmd`.
    pub frames: Vec<AdhesiveState>,
    pub work: Work,
}

/// A step to a load, and whether it is not halved again.
pub(super) struct PathStep {
    pub to: f64,
    pub is_short: bool,
    pub step: AdhesiveStep,
}

/// A walk from one point of the path to the next.
pub(super) struct Walk {
    pub from: AdhesivePlace,
    pub at: f64,
    /// The length of the next step, and of the whole walk.
    length: f64,
    path: f64,
    pub work: Work,
    /// The nearest step that parts the surfaces, as far as one is known.
    pub parted: Option<PathStep>,
}

impl AdhesivePlace {
    /// The error of a state that misses equilibrium by more than the tolerance.
    pub fn fault(&self) -> Option<AdhesionError> {
        match self {
            Self::State(state) if state.claim == ResultClaim::NotConverged => {
                Some(AdhesionError::NotFound { steps: state.steps, residual: state.residual })
            }
            _ => None,
        }
    }
}

impl Walk {
    /// The walk from a place at one load to another load.
    pub fn new(from: AdhesivePlace, at: f64, end: f64) -> Self {
        Self { from, at, length: end - at, path: end - at, work: Work::default(), parted: None }
    }

    /// The load of the next step on the way to an end, and whether the step is not halved again.
    pub fn next(&self, end: f64) -> (f64, bool) {
        let to = if (end - self.at).abs() <= self.length.abs() { end } else { self.at + self.length };
        (to, (to - self.at).abs() <= FINEST * self.path.abs())
    }

    /// The step that parts the surfaces, if it is close enough.
    pub fn known(&mut self) -> Option<PathStep> {
        let (at, path) = (self.at, self.path);
        self.parted.take_if(|it| !is_far(at, it.to, path))
    }

    /// Whether a step parts the surfaces at a load that is still far from the last one that does not.
    pub fn parts_far(&self, step: &PathStep) -> bool {
        let parts = matches!(step.step.place, AdhesivePlace::Apart) && !matches!(self.from, AdhesivePlace::Apart);
        parts && is_far(self.at, step.to, self.path)
    }

    /// Halves a step to a load that was too long.
    pub fn halve(&mut self, to: f64, spent: Work) {
        self.work = sum(self.work, spent);
        self.length = 0.5 * (to - self.at);
    }

    /// Goes on from a place, with twice as long a step, or half the way to where the surfaces part.
    pub fn arrive(&mut self, place: AdhesivePlace, at: f64) {
        self.length = self.parted.as_ref().map_or(2.0 * (at - self.at), |beyond| 0.5 * (beyond.to - at));
        (self.from, self.at) = (place, at);
    }
}

/// Whether the load that parts the surfaces is still far from the last one that does not.
fn is_far(at: f64, to: f64, path: f64) -> bool {
    (to - at).abs() > (PULL_OFF * to.abs()).max(LEAST * path.abs())
}

pub(super) fn sum(a: Work, b: Work) -> Work {
    Work {
        iterations: a.iterations + b.iterations,
        transforms: a.transforms + b.transforms,
        seconds: a.seconds + b.seconds,
    }
}
