//! Steady motions one after the other: speeds of sliding, creepages or loads of rolling.

use super::{EachState, Process, Rolling, RollingConditions, Sliding};
use crate::contact::{
    MonotoneSets, Observer, Problem, Quantity, ResultClaim, Solver, State, StateField, StateKind, StateValues, Stop,
    Work,
};
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
            each(sliding.into_state(speed))?;
        }
        Ok(())
    }
}

impl Sliding {
    /// The state as one of any history, at its speed.
    pub fn into_state(self, speed: f64) -> State {
        let is_line = self.contact.problem.surface().grid().is_line();
        let values = StateValues::new(StateKind::Elastic)
            .with(Quantity::Speed, speed)
            .with(Quantity::EffectiveModulus, self.contact.effective_modulus())
            .with(Quantity::Friction, self.friction)
            .with(Quantity::LateralFriction, (!is_line).then_some(self.lateral))
            .with(Quantity::FrictionFullContact, self.full_contact)
            .with(Quantity::FrictionPersson, self.persson)
            .with(Quantity::MeanTraction, self.friction * self.contact.mean_pressure());
        let contact = self.contact.with_values(values);
        State { contact, point: None, claim: ResultClaim::Bounded, fields: Vec::new() }
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
            each(Rolling::solve(&self.problem, *conditions, &self.stop, observer)?.into_state())?;
        }
        Ok(())
    }
}

impl Rolling {
    /// The state as one of any history.
    pub fn into_state(self) -> State {
        let (sticks, mean_pressure) = (self.sticks(), self.contact.mean_pressure());
        let touching = self.contact.pressure.iter().filter(|p| **p > 0.0).count();
        let values = StateValues::new(StateKind::Elastic)
            .with(Quantity::Creepage, self.creepage())
            .with(Quantity::MeanTraction, self.traction.mean())
            .with(Quantity::Friction, self.traction.mean().map(|traction| traction / mean_pressure))
            .with(Quantity::StickShare, sticks.iter().filter(|it| **it).count() as f64 / touching as f64)
            .with(Quantity::TractionCertificate, self.traction_certificate);
        let claim = if self.conditions.beta == 0.0 { ResultClaim::Bounded } else { ResultClaim::RoundsConverged };
        let work = Work { transforms: self.transforms, ..self.contact.work };
        let fields = vec![StateField::traction(self.traction), StateField::slip(self.slip)];
        let contact = self.contact.with_work(work).with_values(values);
        State { contact, point: None, claim, fields }
    }
}
