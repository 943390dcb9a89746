//! A contact with adhesion that is moved by hand.

use super::adhesive::AdhesiveProcess;
use super::adhesive_place::{AdhesivePlace, AdhesiveStep, AdhesiveVisit};
use super::adhesive_walk::BranchWalk;
use crate::adhesion::AdhesiveControl;
use crate::contact::{Load, State, Work};
use crate::error::AdhesionError;

/// The longest step of a move over the range of the attraction, and the most steps of one: longer ones let go of what holds.
const LONGEST: f64 = 0.25;
const MOST_STEPS: f64 = 64.0;

/// The part of a move within which a jump is located.
const FINEST: f64 = 1e-3;

/// A contact with adhesion that is moved from load to load, whatever these will be. Each move starts from the last state.
pub struct AdhesiveHand {
    process: AdhesiveProcess,
    last: AdhesiveVisit,
}

impl AdhesiveHand {
    /// The contact at the end of the path of a process.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`](crate::adhesion::AdhesiveProblem::solve), and [`AdhesionError::Pathless`].
    pub fn new(process: AdhesiveProcess) -> Result<Self, AdhesionError> {
        let loads: Vec<Load> = process.loads().collect();
        let (first, rest) = loads.split_first().ok_or(AdhesionError::Pathless)?;
        let control = process.control(*first);
        let AdhesiveStep { place, work, .. } = process.search().solve(control, None, &mut ())?;
        place.fault().map_or(Ok(()), Err)?;
        let mut last = AdhesiveVisit::first(place, control, work);
        for load in rest {
            last = end_of(&process, &last, process.control(*load))?;
        }
        Ok(Self { process, last })
    }

    /// Moves the contact to another load, in short steps where a length is given. A jump takes place in one of them.
    ///
    /// # Errors
    /// The errors of [`AdhesiveProblem::solve`](crate::adhesion::AdhesiveProblem::solve).
    pub fn move_to(&mut self, load: Load) -> Result<(), AdhesionError> {
        let target = self.process.control(load);
        let (begin, range) = (self.begin(target).value(), self.process.range());
        let way = target.value() - begin;
        let steps = match target {
            AdhesiveControl::MeanPressure(_) => 1,
            _ => (way.abs() / (LONGEST * range)).ceil().clamp(1.0, MOST_STEPS) as usize,
        };
        for step in 1..=steps {
            let value = if step == steps { target.value() } else { begin + way * step as f64 / steps as f64 };
            self.step_to(target.with_value(value))?;
        }
        Ok(())
    }

    /// Goes on in one step, or in as many as it takes to find each state.
    fn step_to(&mut self, target: AdhesiveControl) -> Result<(), AdhesionError> {
        self.last = match self.process.search().solve(target, Some(&self.last.place), &mut ()) {
            Ok(AdhesiveStep { place, work, .. }) if place.fault().is_none() => {
                AdhesiveVisit::first(place, target, work)
            }
            Ok(_) | Err(AdhesionError::NotFound { .. }) => {
                let from = AdhesiveVisit::first(self.last.place.clone(), self.begin(target), Work::default());
                end_of(&self.process, &from, target)?
            }
            Err(error) => return Err(error),
        };
        Ok(())
    }

    /// Where the contact is, in the terms of a control.
    fn begin(&self, target: AdhesiveControl) -> AdhesiveControl {
        let AdhesivePlace::State(state) = &self.last.place else { return target };
        target.with_value(match target {
            AdhesiveControl::MeanPressure(_) => state.mean_pressure,
            AdhesiveControl::MeanGap(_) => state.mean_gap(),
            AdhesiveControl::Approach(_) => self.process.highest() - state.datum,
        })
    }

    /// The state.
    pub fn state(&self) -> State {
        self.process.told(self.last.kept(), None)
    }
}

/// The last of the visits on the way to a control.
fn end_of(
    process: &AdhesiveProcess,
    from: &AdhesiveVisit,
    target: AdhesiveControl,
) -> Result<AdhesiveVisit, AdhesionError> {
    let mut visits = Vec::new();
    let finest = FINEST * (target.value() - from.control.value()).abs();
    BranchWalk::new(process.search(), from, target, finest).run(&mut (), &mut visits)?;
    Ok(visits.pop().expect("a step has an end"))
}
