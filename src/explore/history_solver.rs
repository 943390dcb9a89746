//! A history, of a solid that creeps or with adhesion, as a solver whose steps are its states.

use crate::contact::{Contact, Each, Observables, Observer, Problem, Solver, Status, Step, Stop, Work};
use crate::error::{AdhesionError, Failure, HistoryError, SolveError};
use crate::history::{HistoryNumbers, HistoryState};
use crate::setup::Setup;
use crate::surface::Field;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// The numbers of the state of a history that was shown last. A contact with a memory has its area by the effective pressure, and one
/// with adhesion its load by the attraction as well, which no contact knows by itself. Empty where there is no history.
#[derive(Clone, Default)]
pub struct StateNumbers(Arc<Mutex<Option<NotedState>>>);

/// Observables that a contact takes from the pressure between the surfaces alone, which is not the load where they attract each other.
const UNKNOWN_WITH_ADHESION: [&str; 6] = [
    "reduced_pressure_contact",
    "reduced_pressure_contact_counted",
    "kappa_counted",
    "kappa_corrected",
    "kappa_r_corrected",
    "elastic_energy",
];

/// What is noted of a state.
#[derive(Clone, Copy)]
struct NotedState {
    numbers: HistoryNumbers,
    /// The mean pressure between the surfaces where they touch, and the pressure at which `p*` is 1.
    contact_pressure: f64,
    unit: f64,
}

impl StateNumbers {
    /// Notes the numbers of a state with the contact that it has.
    pub fn set(&self, numbers: HistoryNumbers, contact: &Contact) {
        let unit = contact.problem.rms_gradient() * contact.problem.contact_modulus();
        let noted = NotedState { numbers, contact_pressure: contact.mean_pressure(), unit };
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(noted);
    }

    fn get(&self) -> Option<NotedState> {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The observable `name` of the state, if the state knows it better than its contact.
    pub fn value(&self, name: &str, reduced_pressure: f64) -> Option<f64> {
        let NotedState { numbers, contact_pressure, unit } = self.get()?;
        let HistoryNumbers { relative_area, kappa_r, net_pressure, .. } = numbers;
        let net = net_pressure.map(|net| net / unit);
        match name {
            "mean_pressure" => net_pressure,
            "reduced_pressure" => net,
            "relative_area" => relative_area,
            // the sum with 0 has no sign where nothing touches
            "kappa" => relative_area.map(|area| area / net.unwrap_or(reduced_pressure) + 0.0),
            "kappa_r" => kappa_r.map(|kappa| net_pressure.map_or(kappa, |net| kappa * contact_pressure / net + 0.0)),
            "kappa_r_counted" if net.is_some() => self.value("kappa_r", reduced_pressure),
            _ if net.is_some() && UNKNOWN_WITH_ADHESION.contains(&name) => Some(f64::NAN),
            _ => None,
        }
    }

    /// The observables of a contact or a step, with those that the state knows better.
    pub fn correct(&self, found: Observables) -> Observables {
        let of = |name: &str, own: f64| self.value(name, found.reduced_pressure).unwrap_or(own);
        Observables {
            mean_pressure: of("mean_pressure", found.mean_pressure),
            reduced_pressure: of("reduced_pressure", found.reduced_pressure),
            reduced_pressure_contact: of("reduced_pressure_contact", found.reduced_pressure_contact),
            reduced_pressure_contact_counted: of(
                "reduced_pressure_contact_counted",
                found.reduced_pressure_contact_counted,
            ),
            relative_area: of("relative_area", found.relative_area),
            kappa: of("kappa", found.kappa),
            kappa_counted: of("kappa_counted", found.kappa_counted),
            kappa_corrected: of("kappa_corrected", found.kappa_corrected),
            kappa_r: of("kappa_r", found.kappa_r),
            kappa_r_counted: of("kappa_r_counted", found.kappa_r_counted),
            kappa_r_corrected: of("kappa_r_corrected", found.kappa_r_corrected),
            elastic_energy: of("elastic_energy", found.elastic_energy),
            ..found
        }
    }
}

/// The history of a setup as a solver: each state is a step, and the contact is that of the last state.
pub struct HistorySolver<'a> {
    setup: &'a Setup,
    /// Whether the solve goes on, asked at each step of each state.
    goes_on: &'a dyn Fn() -> bool,
    numbers: StateNumbers,
}

impl<'a> HistorySolver<'a> {
    /// The history of a setup, which notes the numbers of its states.
    pub fn new(setup: &'a Setup, goes_on: &'a dyn Fn() -> bool, numbers: StateNumbers) -> Self {
        Self { setup, goes_on, numbers }
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
        self.numbers.set(numbers, &contact);
        let slice = |field: &Field| field.as_slice().expect("results are made in standard layout").to_vec();
        let [pressure, displacement] = [&contact.pressure, &contact.displacement].map(slice);
        let mut step =
            Step::new(&contact.problem, *work, &pressure, &displacement).with_certificate(contact.certificate);
        if numbers.net_pressure.is_some() {
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
