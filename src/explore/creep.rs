//! A contact on a solid that creeps in time, as a solver whose steps are the states of its history.

use crate::contact::{Contact, Each, Observables, Observer, Problem, Solver, Status, Step, Stop, Work};
use crate::error::{Failure, HistoryError, SolveError};
use crate::history::{HistoryNumbers, HistoryState, Process};
use crate::setup::Setup;
use crate::surface::Field;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// The numbers of the state of a history that was shown last. A contact with a memory has its area by the effective pressure,
/// which no contact knows by itself. Empty where there is no history.
#[derive(Clone, Default)]
pub struct StateNumbers(Arc<Mutex<Option<HistoryNumbers>>>);

impl StateNumbers {
    fn set(&self, numbers: HistoryNumbers) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(numbers);
    }

    fn get(&self) -> Option<HistoryNumbers> {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The observable `name` of the state, if the state knows it better than its contact.
    pub fn value(&self, name: &str, reduced_pressure: f64) -> Option<f64> {
        let HistoryNumbers { relative_area, kappa_r, .. } = self.get()?;
        match name {
            "relative_area" => relative_area,
            "kappa" => relative_area.map(|area| area / reduced_pressure),
            "kappa_r" => kappa_r,
            _ => None,
        }
    }

    /// The observables of a contact or a step, with those that the state knows better.
    pub fn correct(&self, found: Observables) -> Observables {
        let of = |name: &str, own: f64| self.value(name, found.reduced_pressure).unwrap_or(own);
        Observables {
            relative_area: of("relative_area", found.relative_area),
            kappa: of("kappa", found.kappa),
            kappa_r: of("kappa_r", found.kappa_r),
            ..found
        }
    }
}

/// The history of a setup as a solver: each state is a step, and the contact is that of the last state.
pub struct CreepSolver<'a> {
    setup: &'a Setup,
    /// Whether the solve goes on, asked at each step of each state.
    goes_on: &'a dyn Fn() -> bool,
    numbers: StateNumbers,
}

impl<'a> CreepSolver<'a> {
    /// The history of a setup, which notes the numbers of its states.
    pub fn new(setup: &'a Setup, goes_on: &'a dyn Fn() -> bool, numbers: StateNumbers) -> Self {
        Self { setup, goes_on, numbers }
    }

    /// The setup without its history, for what asks for the setup of one contact.
    pub fn setup_of_contact(&self) -> Setup {
        Setup { viscoelastic: None, path: None, ..self.setup.clone() }
    }
}

impl Solver for CreepSolver<'_> {
    fn name(&self) -> &str {
        self.setup.solver.name()
    }

    fn settings(&self) -> String {
        self.setup.solver.solver().settings()
    }

    fn solve_from(
        &self,
        _: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let failed = |failure: Failure| SolveError::Observer(Arc::new(failure));
        let mut process = self.setup.creep(problem.clone()).map_err(|error| failed(error.into()))?;
        observer.begin(self, problem, stop).map_err(failed)?;
        let (mut work, mut last) = (Work::default(), None);
        let mut asked =
            Each(|_: &Step<'_>| if (self.goes_on)() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) });
        let ended = process.run(&mut asked, &mut |state| {
            let (status, contact) = self.show(state, &mut work, observer)?;
            last = Some(contact);
            if status == Status::StoppedByObserver { Err(HistoryError::Stopped) } else { Ok(()) }
        });
        let mut contact = match (ended, last) {
            (Ok(()) | Err(HistoryError::Stopped), Some(contact)) => contact,
            (Err(HistoryError::Solve(error)), _) => return Err(error),
            (Err(error), _) => return Err(failed(error.into())),
            (Ok(()), None) => return Err(failed("the history has no states".into())),
        };
        if let Err(failure) = observer.end(&contact) {
            contact.fail(failure);
        }
        Ok(contact)
    }
}

impl CreepSolver<'_> {
    /// Shows a state as a step, and returns its contact with the work so far, and whether it goes on.
    fn show(
        &self,
        state: HistoryState,
        work: &mut Work,
        observer: &mut dyn Observer,
    ) -> Result<(Status, Contact), HistoryError> {
        let HistoryState { mut contact, numbers, work: added, .. } = state;
        *work = Work {
            iterations: work.iterations + added.iterations.max(1),
            transforms: work.transforms + added.transforms,
            seconds: work.seconds + added.seconds,
        };
        contact.work = *work;
        self.numbers.set(numbers);
        let slice = |field: &Field| field.as_slice().expect("results are made in standard layout").to_vec();
        let [pressure, displacement] = [&contact.pressure, &contact.displacement].map(slice);
        let step = Step::new(&contact.problem, *work, &pressure, &displacement).with_certificate(contact.certificate);
        let wish = observer.step(&step).map_err(|failure| SolveError::Observer(Arc::new(failure)))?;
        drop(step);
        if wish.is_break() {
            contact.status = Status::StoppedByObserver;
        }
        Ok((contact.status, contact))
    }
}
