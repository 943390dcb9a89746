//! Steady motions one after the other: speeds of sliding, creepages or loads of rolling.

use super::{EachState, HistoryField, HistoryNumbers, HistoryState, Process, Rolling, RollingConditions, Sliding};
use crate::contact::{MonotoneSets, Observer, Problem, ResultClaim, Solver, Stop, Work};
use crate::elastic::Prony;
use crate::error::HistoryError;
use crate::surface::Field;

/// The process of steady sliding at some speeds: one state for each, which starts from the pressure at the speed before.
pub struct SlidingProcess {
    problem: Problem,
    prony: Prony,
    speeds: Vec<f64>,
    stop: Stop,
}

impl SlidingProcess {
    /// The process of a problem at rest on a solid with a memory.
    pub fn new(problem: Problem, prony: Prony, speeds: Vec<f64>, stop: Stop) -> Self {
        Self { problem, prony, speeds, stop }
    }
}

impl Process for SlidingProcess {
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        let terms: Vec<(f64, f64)> = self.prony.terms().iter().map(|term| (term.ratio, term.time)).collect();
        let mut start: Option<Field> = None;
        for &speed in &self.speeds {
            let problem = self.problem.clone().sliding(speed, &terms)?;
            let contact = MonotoneSets.solve_from(start.as_ref(), &problem, &self.stop, observer)?;
            let sliding = Sliding::new(contact)?;
            start = Some(sliding.contact.pressure.clone());
            each(sliding.into_history(speed))?;
        }
        Ok(())
    }
}

impl Sliding {
    /// The state as one of any history, at its speed.
    pub fn into_history(self, speed: f64) -> HistoryState {
        let numbers = HistoryNumbers {
            speed: Some(speed),
            effective_modulus: Some(self.contact.effective_modulus()),
            friction: Some(self.friction),
            lateral_friction: (!self.contact.problem.surface().grid().is_line()).then_some(self.lateral),
            friction_full_contact: Some(self.full_contact),
            friction_persson: Some(self.persson),
            mean_traction: Some(self.friction * self.contact.mean_pressure()),
            ..HistoryNumbers::default()
        };
        let (claim, work, contact) = (ResultClaim::Bounded, self.contact.work, self.contact);
        HistoryState { contact, point: None, claim, numbers, fields: Vec::new(), work }
    }
}

/// The process of steady rolling under some conditions: one state for each.
pub struct RollingProcess {
    problem: Problem,
    conditions: Vec<RollingConditions>,
    stop: Stop,
}

impl RollingProcess {
    /// The process of a problem at rest.
    pub fn new(problem: Problem, conditions: Vec<RollingConditions>, stop: Stop) -> Self {
        Self { problem, conditions, stop }
    }
}

impl Process for RollingProcess {
    fn run(&mut self, observer: &mut dyn Observer, each: &mut EachState<'_>) -> Result<(), HistoryError> {
        for conditions in &self.conditions {
            each(Rolling::solve(&self.problem, *conditions, &self.stop, observer)?.into_history())?;
        }
        Ok(())
    }
}

impl Rolling {
    /// The state as one of any history.
    pub fn into_history(self) -> HistoryState {
        let (sticks, mean_pressure) = (self.sticks(), self.contact.mean_pressure());
        let touching = self.contact.pressure.iter().filter(|p| **p > 0.0).count();
        let numbers = HistoryNumbers {
            creepage: Some(self.creepage()),
            mean_traction: self.traction.mean(),
            friction: self.traction.mean().map(|traction| traction / mean_pressure),
            stick_share: Some(sticks.iter().filter(|it| **it).count() as f64 / touching as f64),
            traction_certificate: Some(self.traction_certificate),
            ..HistoryNumbers::default()
        };
        let claim = if self.conditions.beta == 0.0 { ResultClaim::Bounded } else { ResultClaim::RoundsConverged };
        let work = Work { transforms: self.transforms, ..self.contact.work };
        let fields = vec![HistoryField::traction(self.traction), HistoryField::slip(self.slip)];
        HistoryState { contact: self.contact, point: None, claim, numbers, fields, work }
    }
}
