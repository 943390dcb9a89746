//! Steady motions one after the other: speeds of sliding, creepages or loads of rolling.

use super::{PathPoint, Process, Rolling, RollingConditions, Sliding};
use crate::contact::{
    Contact, Feels, FieldKind, MonotoneSets, Observer, Problem, Quantity, ResultClaim, Solver, State, StateField,
    StateValues, Stop, Work,
};
use crate::elastic::{Prony, SteadyMotion};
use crate::error::HistoryError;
use crate::surface::Field;

/// The process of steady sliding at some speeds: one state for each, which starts from the pressure at the speed before.
pub struct SlidingProcess {
    problem: Problem,
    prony: Prony,
    speeds: Vec<f64>,
    stop: Stop,
    /// The number of the next speed.
    next: usize,
    /// The pressure at the speed before.
    start: Option<Field>,
}

impl SlidingProcess {
    /// The process of a problem at rest on a solid with a memory.
    pub fn new(problem: Problem, prony: Prony, speeds: Vec<f64>, stop: Stop) -> Self {
        Self { problem, prony, speeds, stop, next: 0, start: None }
    }
}

impl Process for SlidingProcess {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let speed = *self.speeds.get(self.next)?;
        self.next += 1;
        let state = self.slide(self.problem.clone(), speed, observer);
        if state.is_err() {
            self.next = self.speeds.len();
        }
        Some(state)
    }

    /// Slides under another load, at the last speed.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let speed = self.speeds.get(self.next.saturating_sub(1)).copied().unwrap_or(0.0);
        let problem = self.problem.clone().with_load(point.load)?;
        self.slide(problem, speed, observer)
    }
}

impl SlidingProcess {
    fn slide(&mut self, problem: Problem, speed: f64, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let terms: Vec<(f64, f64)> = self.prony.terms().iter().map(|term| (term.ratio, term.time)).collect();
        let problem = problem.sliding(speed, &terms)?;
        let contact = MonotoneSets.solve_from(self.start.as_ref(), &problem, &self.stop, observer)?;
        let sliding = Sliding::new(contact)?;
        self.start = Some(sliding.contact.pressure.clone());
        Ok(sliding.into_state(speed))
    }
}

impl Sliding {
    /// The numbers of a contact that slides which only its motion gives.
    pub const NUMBERS: [Quantity; 6] = [
        Quantity::Speed,
        Quantity::LateralFriction,
        Quantity::FrictionFullContact,
        Quantity::FrictionPersson,
        Quantity::FrictionError,
        Quantity::MeanTraction,
    ];

    /// The contact with the numbers of its motion, if it slides over a solid that creeps; others as they are. All processes of single contacts end with
    /// it, so that one speed is told what several are.
    pub(crate) fn measured(contact: Contact) -> Contact {
        let Some(SteadyMotion::Sliding { speed, .. }) = contact.problem.compliance().motion() else { return contact };
        let speed = *speed;
        match Self::new(contact.clone()) {
            Ok(sliding) => sliding.with_numbers(speed),
            Err(_) => contact,
        }
    }

    /// The contact with the numbers of its motion at a speed.
    fn with_numbers(self, speed: f64) -> Contact {
        let is_line = self.contact.problem.surface().grid().is_line();
        let values = StateValues::new(Feels::PRESSURE)
            .with(Quantity::Speed, speed)
            .with(Quantity::EffectiveModulus, self.contact.effective_modulus())
            .with(Quantity::Friction, self.friction)
            .with(Quantity::LateralFriction, (!is_line).then_some(self.lateral))
            .with(Quantity::FrictionFullContact, self.full_contact)
            .with(Quantity::FrictionPersson, self.persson)
            .with(Quantity::FrictionError, self.grid_error)
            .with(Quantity::MeanTraction, self.friction * self.contact.mean_pressure());
        self.contact.with_values(values)
    }

    /// The state as one of any history, at its speed.
    pub fn into_state(self, speed: f64) -> State {
        State::new(self.with_numbers(speed), ResultClaim::Bounded)
    }
}

/// The process of steady rolling under some conditions: one state for each.
pub struct RollingProcess {
    problem: Problem,
    conditions: Vec<RollingConditions>,
    stop: Stop,
    /// The number of the next conditions.
    next: usize,
}

impl RollingProcess {
    /// The process of a problem at rest.
    pub fn new(problem: Problem, conditions: Vec<RollingConditions>, stop: Stop) -> Self {
        Self { problem, conditions, stop, next: 0 }
    }
}

impl Process for RollingProcess {
    fn next(&mut self, observer: &mut dyn Observer) -> Option<Result<State, HistoryError>> {
        let conditions = *self.conditions.get(self.next)?;
        self.next += 1;
        let rolling = Rolling::solve(&self.problem, conditions, &self.stop, observer);
        if rolling.is_err() {
            self.next = self.conditions.len();
        }
        Some(rolling.map(Rolling::into_state).map_err(HistoryError::from))
    }

    /// Rolls under another load, in the last conditions.
    fn move_to(&mut self, point: PathPoint, observer: &mut dyn Observer) -> Result<State, HistoryError> {
        let last = self.conditions.get(self.next.saturating_sub(1)).copied();
        let conditions = last.ok_or(HistoryError::Pathless)?;
        let problem = self.problem.clone().with_load(point.load)?;
        Ok(Rolling::solve(&problem, conditions, &self.stop, observer)?.into_state())
    }
}

impl Rolling {
    /// The state as one of any history.
    pub fn into_state(self) -> State {
        let (sticks, mean_pressure) = (self.sticks(), self.contact.mean_pressure());
        let touching = self.contact.pressure.iter().filter(|p| **p > 0.0).count();
        let values = StateValues::new(Feels::PRESSURE)
            .with(Quantity::Creepage, self.creepage())
            .with(Quantity::MeanTraction, self.traction.mean())
            .with(Quantity::Friction, self.traction.mean().map(|traction| traction / mean_pressure))
            .with(Quantity::StickShare, sticks.iter().filter(|it| **it).count() as f64 / touching as f64)
            .with(Quantity::TractionCertificate, self.traction_certificate);
        let claim = if self.conditions.beta == 0.0 { ResultClaim::Bounded } else { ResultClaim::RoundsConverged };
        let work = Work { transforms: self.transforms, ..self.contact.work };
        let fields =
            vec![StateField::new(FieldKind::Traction, self.traction), StateField::new(FieldKind::Slip, self.slip)];
        let contact = self.contact.with_work(work).with_values(values);
        State::new(contact, claim).with_fields(fields)
    }
}
