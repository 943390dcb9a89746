//! A history, of a solid that creeps or with adhesion, as a solver whose steps are its states.

use crate::contact::{Contact, Each, Observer, Problem, Solver, State, StateKind, Status, Step, Stop, Work};
use crate::error::{AdhesionError, Failure, HistoryError, SolveError};
use crate::setup::Setup;
use crate::surface::Field;
use std::ops::ControlFlow;
use std::sync::Arc;

/// The history of a setup as a solver: each state is a step, and the contact is that of the last state.
pub struct HistorySolver<'a> {
    setup: &'a Setup,
    /// Whether the solve goes on, asked at each step of each state.
    goes_on: &'a dyn Fn() -> bool,
}

impl<'a> HistorySolver<'a> {
    /// The history of a setup.
    pub fn new(setup: &'a Setup, goes_on: &'a dyn Fn() -> bool) -> Self {
        Self { setup, goes_on }
    }

    /// The setup without its history, for what asks for the setup of one contact.
    pub fn setup_of_contact(&self) -> Setup {
        Setup { viscoelastic: None, adhesion: None, path: None, ..self.setup.clone() }
    }
}

impl Solver for HistorySolver<'_> {
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
        let process = self.setup.history(problem.clone()).map_err(|error| failed(error.into()))?;
        let mut process = process.ok_or_else(|| failed("the setup has no history".into()))?;
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
            (Ok(()) | Err(HistoryError::Stopped | HistoryError::Adhesion(AdhesionError::Stopped)), Some(contact)) => {
                contact
            }
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

impl HistorySolver<'_> {
    /// Shows a state as a step, and returns its contact with the work so far, and whether it goes on.
    fn show(
        &self,
        state: State,
        work: &mut Work,
        observer: &mut dyn Observer,
    ) -> Result<(Status, Contact), HistoryError> {
        let State { mut contact, .. } = state;
        let added = contact.work;
        *work = Work {
            iterations: work.iterations + added.iterations.max(1),
            transforms: work.transforms + added.transforms,
            seconds: work.seconds + added.seconds,
        };
        contact.work = *work;
        let slice = |field: &Field| field.as_slice().expect("results are made in standard layout").to_vec();
        let [pressure, displacement] = [&contact.pressure, &contact.displacement].map(slice);
        let mut step =
            Step::new(&contact.problem, *work, &pressure, &displacement).with_certificate(contact.certificate);
        step = step.with_values(contact.values().clone());
        if contact.values().kind == StateKind::Adhesion {
            // surfaces that attract each other may be apart
            step = step.with_datum(contact.gap[[0, 0]] - displacement[0] + contact.problem.height()[0]);
        }
        let wish = observer.step(&step).map_err(|failure| SolveError::Observer(Arc::new(failure)))?;
        drop(step);
        if wish.is_break() {
            contact.status = Status::StoppedByObserver;
        }
        Ok((contact.status, contact))
    }
}
