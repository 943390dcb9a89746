//! The process of a viscoelastic solid along a path of loads and times.

use super::process::{PathPoint, Process};
use super::{Creep, CreepPath, CreepState, CreepSteps, TimeErrors};
use crate::contact::{
    Feels, FieldKind, Load, Observer, Problem, Quantity, ResultClaim, Solver, State, StateField, StateValues, Stop,
};
use crate::elastic::Prony;
use crate::error::{CreepError, HistoryError};

/// The process of a viscoelastic solid in time.
pub struct CreepProcess<'s> {
    steps: CreepSteps<'s>,
    points: Vec<(f64, Load)>,
    /// Points that were put before those of the path.
    before: usize,
    /// The next point.
    next: usize,
}

impl<'s> CreepProcess<'s> {
    /// The process of a problem on a solid with a memory along a path whose points have times. A path that does not begin at time 0 begins
    /// with the load of its first point at that time. There are as many equal `steps` between two points, or as many as a `tolerance` needs.
    ///
    /// # Errors
    /// The errors of [`CreepPath::new`], [`CreepSteps::fixed`] and [`CreepSteps::adaptive`].
    pub fn new(
        (problem, prony): (Problem, Prony),
        path: &[PathPoint],
        (steps, tolerance): (Option<usize>, f64),
        (solver, stop): (&'s dyn Solver, Stop),
    ) -> Result<Self, CreepError> {
        let mut points: Vec<(f64, Load)> = path.iter().map(|it| (it.time.unwrap_or(0.0), it.load)).collect();
        let begin = points.first().filter(|(time, _)| *time > 0.0).map(|(_, load)| (0.0, *load));
        points.splice(0..0, begin);
        let (creep, path) = (Creep::new(problem, prony), CreepPath::new(points)?);
        let points = path.points().to_vec();
        let steps = match steps {
            Some(count) => CreepSteps::fixed(creep, path, count, solver, stop)?,
            None => CreepSteps::adaptive(creep, path, tolerance, solver, stop)?,
        };
        Ok(Self { steps, points, before: usize::from(begin.is_some()), next: 0 })
    }
}

impl Process for CreepProcess<'_> {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let state = match self.steps.next_watched(observer)? {
            Ok(state) => state,
            Err(error) => return Some(Err(error.into())),
        };
        let reached =
            self.points.get(self.next).filter(|(time, load)| *time == state.time && Some(*load) == state.load);
        let point = reached.and_then(|_| self.next.checked_sub(self.before));
        if let Some(point) = reached.copied() {
            // a load that is given twice at one time has one state
            let again = self.points[self.next..].iter().take_while(|other| **other == point).count();
            self.next += again;
        }
        Some(Ok(state.into_state(point)))
    }

    /// Goes on to a time, in steps of its own; the load changes linearly on the way. Without a time, or at the last one, it jumps.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        self.steps.extend(point.time, point.load)?;
        let mut last = None;
        while let Some(state) = self.steps.next_watched(observer) {
            last = Some(state?);
        }
        Ok(last.ok_or(HistoryError::Pathless)?.into_state(None))
    }
}

impl CreepState {
    /// The state as one of any history.
    pub fn into_state(self, point: Option<usize>) -> State {
        let effective = self.effective_pressure().clone();
        let is_pressed = self.contact.mean_pressure() > 0.0;
        let resolved = self.resolved();
        // a contact of single nodes may have neither an area nor a gradient
        let kappa_r = Some(resolved.kappa_r).filter(|kappa_r| is_pressed && *kappa_r > 0.0);
        let by_grid = if is_pressed { self.grid_errors() } else { None };
        let error = |of: fn(&TimeErrors) -> f64| self.time_errors.as_ref().map(of);
        let values = StateValues::new(Feels::MEMORY)
            .with(Quantity::Time, self.time)
            .with(Quantity::ReducedPressure, self.load.and_then(|load| load.reduced_pressure()))
            .with(Quantity::EffectivePressure, effective.mean())
            .with(Quantity::RelativeArea, if is_pressed { resolved.relative_area } else { 0.0 })
            .with(Quantity::KappaR, kappa_r)
            .with(Quantity::RelativeAreaError, by_grid.map(|it| it.relative_area))
            .with(Quantity::KappaRError, kappa_r.and(by_grid).map(|it| it.kappa_r))
            .with(Quantity::Dissipated, self.energy.lost)
            .with(Quantity::Stored, self.energy.stored)
            .with(Quantity::WorkDone, self.energy.work)
            .with(Quantity::TimeError, is_pressed.then(|| self.time_error()).flatten())
            .with(Quantity::MeanPressureTimeError, error(|it| it.mean_pressure))
            .with(Quantity::MeanGapTimeError, error(|it| it.mean_gap))
            .with(Quantity::RelativeAreaTimeError, error(|it| it.relative_area))
            .with(Quantity::DissipatedTimeError, error(|it| it.lost))
            .with(Quantity::WorkTimeError, error(|it| it.work))
            .with(Quantity::HistoryBound, self.error_bound());
        let fields = vec![StateField::new(FieldKind::StoredStrain, effective - &self.contact.pressure)];
        State::new(self.contact.with_values(values), ResultClaim::Solution).at(point).with_fields(fields)
    }
}
