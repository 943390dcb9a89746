//! Iterations of other codes, replayed.

use super::fault::feasible;
use super::given_field::GivenField;
use super::tension::Tension;
use crate::contact::{Certificate, Contact, Observer, Problem, Run, Solver, Status, Step, Stop};
use crate::elastic::Response;
use crate::error::{Failure, SolveError};
use crate::surface::Field;
use std::cell::RefCell;

/// A step of another code.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// The field, row by row.
    pub values: Vec<f64>,
    /// Seconds from the start, if they are known.
    pub seconds: Option<f64>,
}

/// The steps of another code, as a solver: all of them are certified and shown like those of any solver, even after one
/// has converged.
///
/// The pressure of a step is clipped and scaled to the load where it is not feasible. The contact that comes back is
/// that of the last step, and is converged if that meets the goals. Work is that of the other code: steps, and seconds
/// where they are known, or else none. A frame that cannot be read ends the run with its failure.
///
/// ```
/// use asperity::contact::{ContactModulus, Each, Load, Solver};
/// use asperity::foreign::{Frame, GivenField, Replay};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::ops::ControlFlow;
///
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.01))?;
/// // two steps of somebody: a uniform pressure, and one under the peak
/// let steps = [vec![0.01; 256], problem.height().iter().map(|h| h.max(0.0)).collect()];
/// let frames = steps.into_iter().map(|values| Ok(Frame { values, seconds: None }));
/// let mut certificates = Vec::new();
/// let mut watch = Each(|step: &asperity::contact::Step<'_>| {
///     certificates.extend(step.certificate().map(|it| it.eta));
///     ControlFlow::Continue(())
/// });
/// let replay = Replay::new("mine", GivenField::Pressure, frames);
/// let contact = replay.solve(&problem, &Stop::default(), &mut watch)?;
/// assert!(certificates[1] < certificates[0] && !contact.is_converged());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Replay<I> {
    name: String,
    quantity: GivenField,
    frames: RefCell<I>,
    is_endless: bool,
}

impl<I: Iterator<Item = Result<Frame, Failure>>> Replay<I> {
    /// The replay of steps of a quantity, made by a code of some name. They can be replayed once.
    pub fn new(name: &str, quantity: GivenField, frames: I) -> Self {
        Self { name: name.into(), quantity, frames: RefCell::new(frames), is_endless: false }
    }

    /// The steps of a code that is still running and does not know when to end: no more steps are taken once the goals are met or the
    /// iterations have reached their cap.
    pub fn endless(self) -> Self {
        Self { is_endless: true, ..self }
    }

    /// Shows a frame as a step, and says why to stop, if so.
    fn show(&self, frame: &Frame, run: &mut Run<'_>, response: &mut Response) -> (ReplayedState, Option<Status>) {
        run.set_seconds(frame.seconds.unwrap_or(0.0));
        let state = response.uncounted(|response| self.state(run.problem(), frame, response));
        let work = run.work(response.transforms());
        let step = Step::new(run.problem(), work, &state.pressure, &state.displacement);
        let ended = run.pass(&step.with_certificate(state.certificate));
        let is_met = self.is_endless && run.is_converged(&state.certificate);
        let ended = ended.filter(|ended| self.is_endless || *ended != Status::IterationCap);
        (state, ended.or(is_met.then_some(Status::Converged)))
    }

    /// The feasible pressure of a frame, and what follows from it.
    fn state(&self, problem: &Problem, frame: &Frame, response: &mut Response) -> ReplayedState {
        let pressure = self.quantity.pressure(problem, &frame.values, response);
        let pressure = feasible(problem, &pressure, &Tension::new(&pressure)).unwrap_or(pressure);
        let mut displacement = vec![0.0; pressure.len()];
        response.displacement(&pressure, &mut displacement);
        let certificate = Certificate::from_displacement(problem, &pressure, &displacement);
        ReplayedState { pressure, displacement, certificate }
    }
}

/// The state of a step.
struct ReplayedState {
    pressure: Vec<f64>,
    displacement: Vec<f64>,
    certificate: Certificate,
}

impl<I: Iterator<Item = Result<Frame, Failure>>> Solver for Replay<I> {
    fn name(&self) -> &str {
        &self.name
    }

    fn settings(&self) -> String {
        format!("{}s of another code, step by step", self.quantity)
    }

    /// Replays the steps, wherever they start.
    fn solve_from(
        &self,
        _: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError> {
        let mut run = Run::begin(self, problem, stop, observer);
        let mut response = problem.response();
        let (mut last, mut failure) = (None, None);
        let status = loop {
            let frame = match self.frames.borrow_mut().next() {
                Some(Ok(frame)) => frame,
                missing => {
                    failure = missing.and_then(Result::err);
                    let holds = |state: &ReplayedState| run.is_converged(&state.certificate);
                    break if last.as_ref().is_some_and(holds) { Status::Converged } else { Status::Ended };
                }
            };
            if last.is_some() {
                run.advance();
            }
            let (state, ended) = self.show(&frame, &mut run, &mut response);
            last = Some(state);
            if let Some(ended) = ended {
                break ended;
            }
        };
        if let Some(ReplayedState { pressure, certificate, .. }) = &last {
            run.offer(certificate, pressure);
        }
        let mut contact = run.finish(status, response);
        if let Some(failure) = failure {
            contact.fail(failure);
        }
        Ok(contact)
    }
}
