//! The steps of a history with adhesion from one point of its path to the next.

use super::adhesive::{AdhesivePlace, AdhesiveProcess, AdhesiveStep, AdhesiveVisit};
use crate::adhesion::AdhesiveControl;
use crate::contact::{Observer, Work};
use crate::error::AdhesionError;

/// The part of a step of the path below which a step is not halved again.
const FINEST: f64 = 1e-3;

/// The part of a load that pulls by which the last state that holds may lie below the one that parts the surfaces.
const PULL_OFF: f64 = 1e-3;

/// The part of a step of the path below which a step towards a pull-off is not halved again.
const LEAST: f64 = 1e-9;

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
    parted: Option<PathStep>,
}

impl AdhesiveProcess {
    /// The next step of a walk; none where it is too long, and has been halved. The load that parts the surfaces is found by bisection to a part of
    /// itself, whatever the length of the path. A state that is not found is the end of the walk.
    pub(super) fn step(
        &self,
        walk: &mut Walk,
        target: AdhesiveControl,
        observer: &mut dyn Observer,
    ) -> Result<Option<PathStep>, AdhesionError> {
        if let Some(known) = walk.parted.take_if(|it| !is_far(walk.at, it.to, walk.path)) {
            return Ok(Some(known));
        }
        let end = target.value();
        let to = if (end - walk.at).abs() <= walk.length.abs() { end } else { walk.at + walk.length };
        let is_short = (to - walk.at).abs() <= FINEST * walk.path.abs();
        let step = self.solve(target.with_value(to), Some(&walk.from), observer)?;
        let is_parting = matches!(step.place, AdhesivePlace::Apart) && !walk.has_parted();
        match step.place.fault() {
            Some(error) if is_short => {
                walk.work = sum(walk.work, step.work);
                // close to a jump the safe method may be too slow; where the surfaces part beyond, they part here
                let Some(known) = walk.parted.take() else {
                    (walk.from, walk.at) = (step.place, to);
                    return Err(error);
                };
                Ok(Some(known))
            }
            Some(_) => {
                walk.halve(to, step.work);
                Ok(None)
            }
            None if is_parting && is_far(walk.at, to, walk.path) => {
                walk.halve(to, step.work);
                walk.parted = Some(PathStep { to, is_short, step: AdhesiveStep { work: Work::default(), ..step } });
                Ok(None)
            }
            None => Ok(Some(PathStep { to, is_short, step })),
        }
    }
}

impl Walk {
    /// The walk from a visit to a load.
    pub fn new(last: &AdhesiveVisit, end: f64) -> Self {
        let (at, path) = (last.control.value(), end - last.control.value());
        Self { from: last.place.clone(), at, length: path, path, work: Work::default(), parted: None }
    }

    /// Whether the surfaces have parted before.
    fn has_parted(&self) -> bool {
        matches!(self.from, AdhesivePlace::Apart)
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
