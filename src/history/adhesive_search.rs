//! The search for the places of a history with adhesion, each from the last one.

use super::adhesive_place::{AdhesivePlace, AdhesiveStep, Branch};
use crate::adhesion::{AdhesiveControl, AdhesiveMethod, AdhesiveMotion, AdhesiveProblem, AdhesiveState, Attraction};
use crate::contact::{Observer, ResultClaim, Stop};
use crate::error::AdhesionError;

/// The part of the work of adhesion to which the energies of states are found, over the tolerance of their residual.
const NOISE: f64 = 10.0;

/// The search for the places of a history: a problem, and how its states are found.
pub(super) struct PlaceSearch {
    problem: AdhesiveProblem,
    method: AdhesiveMethod,
    stop: Stop,
}

impl PlaceSearch {
    pub(crate) fn new(problem: AdhesiveProblem, method: AdhesiveMethod, stop: Stop) -> Self {
        Self { problem, method, stop }
    }

    /// The part of the work of adhesion to which the energies of states are found.
    pub(crate) fn noise(&self) -> f64 {
        NOISE * self.stop.tolerance()
    }

    /// The problem.
    pub(crate) fn problem(&self) -> &AdhesiveProblem {
        &self.problem
    }

    /// The attraction.
    pub(crate) fn attraction(&self) -> &Attraction {
        self.problem.attraction()
    }

    /// The place under a control, from the last one.
    pub(crate) fn solve(
        &self,
        control: AdhesiveControl,
        from: Option<&AdhesivePlace>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveStep, AdhesionError> {
        let start = from.and_then(AdhesivePlace::state);
        if start.is_none() && self.stays_apart(control, from) {
            return Ok(AdhesiveStep::apart());
        }
        self.step(control, start.map(|it| &**it), observer)
    }

    /// The place under a control, from the last one on its branch. On periodic grids a state of the fast method is not tested for stability.
    pub(crate) fn probe(
        &self,
        control: AdhesiveControl,
        from: &AdhesivePlace,
        branch: &Branch,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveStep, AdhesionError> {
        let (AdhesiveMethod::Fast | AdhesiveMethod::Safe, Some(state)) = (self.method, from.state()) else {
            return self.solve(control, Some(from), observer);
        };
        let carried = branch.carried_on(state, control);
        let start = carried.as_ref().unwrap_or(state);
        match self.method {
            AdhesiveMethod::Fast => Ok(self.problem.probe(control, start, &self.stop, observer)?.into()),
            _ => self.step(control, Some(start), observer),
        }
    }

    /// Tests the stability of where a step leads, if it was not tested. A saddle is left.
    pub(crate) fn test_stability(
        &self,
        step: &mut AdhesiveStep,
        observer: &mut dyn Observer,
    ) -> Result<(), AdhesionError> {
        let is_periodic = self.problem.problem().surface().grid().is_periodic();
        let Some(state) = step.place.state().filter(|state| is_periodic && state.claim == ResultClaim::Stationary)
        else {
            return Ok(());
        };
        let tested = self.step(state.control, Some(state), observer)?;
        *step = AdhesiveStep { work: step.work + tested.work, ..tested };
        Ok(())
    }

    fn step(
        &self,
        control: AdhesiveControl,
        start: Option<&AdhesiveState>,
        observer: &mut dyn Observer,
    ) -> Result<AdhesiveStep, AdhesionError> {
        match self.method {
            AdhesiveMethod::Gfmd => {
                let AdhesiveMotion { frames, outcome } = self.problem.motion(control, start, &self.stop, observer)?;
                Ok(AdhesiveStep { frames, ..outcome.into() })
            }
            AdhesiveMethod::Fast | AdhesiveMethod::Safe => {
                Ok(self.problem.solve(control, start, self.method, &self.stop, observer)?.into())
            }
        }
    }

    /// Whether surfaces that have parted stay apart: under a load that pulls.
    fn stays_apart(&self, control: AdhesiveControl, from: Option<&AdhesivePlace>) -> bool {
        from.is_some() && control.value() < 0.0
    }
}
