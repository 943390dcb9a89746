//! The bookkeeping of a run.

use crate::clock::Instant;
use crate::contact::best::Best;
use crate::contact::{
    Certificate, Contact, Failure, Observer, Problem, Resolved, Solver, Status, Step, Stop, Wish, Work,
};
use crate::elastic::Response;
use std::ops::ControlFlow;

/// Iterations without a better state after which a run stops, see [`Best::is_stale`]: long enough for the plateaus of
/// conjugate gradients and damped dynamics.
const PATIENCE: usize = 2000;

/// The bookkeeping of a run: iterations, the clock, which stops during observers, the best state, and the reasons to
/// stop.
///
/// A solver begins a run, and at each iteration certifies its pressure, offers it as the best one, shows the step, and
/// advances, until the run returns a reason to stop. Then the run makes the contact of the best pressure, and computes
/// its certificate from a transform pair of its pressure.
///
/// ```text
/// let mut run = Run::begin(self, problem, stop, observer);
/// let status = loop {
///     let certificate = Certificate::from_displacement(problem, &p, &u);
///     run.offer(&certificate, &p);
///     let step = Step::new(problem, run.work(response.transforms()), &p, &u).with_certificate(certificate);
///     if let Some(status) = run.show(&step) {
///         break status;
///     }
///     ... // the method: new p and u
///     run.advance();
/// };
/// Ok(run.finish(status, response))
/// ```
pub struct Run<'a, P = Vec<f64>> {
    solver: &'a dyn Solver,
    problem: &'a Problem,
    observer: &'a mut dyn Observer,
    stop: Stop,
    clock: Instant,
    observed_secs: f64,
    /// Seconds of the work, where it was done elsewhere.
    given_secs: Option<f64>,
    iterations: usize,
    patience: usize,
    failure: Option<Failure>,
    /// Area and gradient of the contact on the next coarser grid, see [`Contact::coarser`].
    pub(super) coarser: Option<Resolved>,
    /// The best state found.
    pub(super) best: Best<P>,
}

impl<'a, P: Clone + Into<Vec<f64>>> Run<'a, P> {
    /// Begins a run of `solver` and notifies the observer.
    pub fn begin(solver: &'a dyn Solver, problem: &'a Problem, stop: &Stop, observer: &'a mut dyn Observer) -> Self {
        let failure = observer.begin(solver, problem, stop).err();
        Self {
            solver,
            problem,
            observer,
            stop: *stop,
            clock: Instant::now(),
            observed_secs: 0.0,
            given_secs: None,
            iterations: 0,
            patience: PATIENCE,
            failure,
            coarser: None,
            best: Best::none(0),
        }
    }

    /// The run with another number of iterations without a better state after which it stops.
    pub fn with_patience(self, patience: usize) -> Self {
        Self { patience, ..self }
    }

    /// The problem that is solved.
    pub fn problem(&self) -> &'a Problem {
        self.problem
    }

    /// Iterations so far.
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Work so far, with the transforms that the solver has counted.
    pub fn work(&self, transforms: u64) -> Work {
        let seconds = self.given_secs.unwrap_or_else(|| self.clock.elapsed().as_secs_f64() - self.observed_secs);
        Work { iterations: self.iterations, transforms, seconds }
    }

    /// Sets the seconds of the work so far, which was done elsewhere, instead of using the clock.
    pub fn set_seconds(&mut self, seconds: f64) {
        self.given_secs = Some(seconds);
    }

    /// Whether a certificate meets all goals.
    pub fn is_converged(&self, certificate: &Certificate) -> bool {
        self.stop.is_met(certificate)
    }

    /// How far a certificate is from the goals, see [`Stop::distance`].
    pub fn distance(&self, certificate: &Certificate) -> f64 {
        self.stop.distance(certificate)
    }

    /// The part to which the distance from the goals must fall.
    pub fn missing(&self, certificate: &Certificate) -> f64 {
        self.stop.tolerance() / self.stop.distance(certificate)
    }

    /// Keeps `pressure` if its certificate is the nearest to the goals so far.
    pub fn offer(&mut self, certificate: &Certificate, pressure: &P) {
        self.best.offer(self.stop.distance(certificate), pressure, self.iterations);
    }

    /// Shows a step to the observer, and returns the reason to stop, if any.
    pub fn show(&mut self, step: &Step<'_>) -> Option<Status> {
        let ended = self.pass(step);
        match step.certificate() {
            Some(certificate) if self.is_converged(certificate) && ended != Some(Status::ObserverFailed) => {
                Some(Status::Converged)
            }
            _ if ended.is_some() => ended,
            _ if self.best.is_stale(self.iterations, self.patience) => Some(Status::Stalled),
            _ => None,
        }
    }

    /// Shows an intermediate step, and returns the reason to stop, if any.
    pub fn pass(&mut self, step: &Step<'_>) -> Option<Status> {
        match self.watch(step) {
            Err(failure) => {
                self.failure = Some(failure);
                Some(Status::ObserverFailed)
            }
            Ok(ControlFlow::Break(())) => Some(Status::StoppedByObserver),
            Ok(ControlFlow::Continue(())) => {
                (self.iterations >= self.stop.max_iterations()).then_some(Status::IterationCap)
            }
        }
    }

    /// The observer's wish after a step; its time does not count.
    fn watch(&mut self, step: &Step<'_>) -> Wish {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        let before = Instant::now();
        let wish = self.observer.step(step);
        self.observed_secs += before.elapsed().as_secs_f64();
        wish
    }

    /// Continues with the next iteration.
    pub fn advance(&mut self) {
        self.iterations += 1;
    }

    /// Ends the run: the contact with the best pressure that was offered or, without one, with the uniform pressure,
    /// which is always feasible. The half-space computes its displacement, and counts the transforms of the run.
    pub fn finish(self, status: Status, response: Response) -> Contact {
        let transforms = response.transforms();
        self.finish_after(status, transforms, response)
    }

    /// Ends the run like [`Run::finish`], after more transforms than those of one half-space.
    pub fn finish_after(self, status: Status, transforms: u64, mut response: Response) -> Contact {
        // the response is freed before the gap is made
        self.finish_with(status, transforms + 2, move |pressure| {
            let mut displacement = vec![0.0; pressure.len()];
            response.displacement(pressure, &mut displacement);
            displacement
        })
    }

    /// Ends the run like [`Run::finish`], with the displacement that `displace` gives for a pressure, after as many transforms as it
    /// needs in all. If the solver reports convergence, the certificate of the contact is checked again for all goals.
    pub(super) fn finish_with(
        mut self,
        status: Status,
        transforms: u64,
        displace: impl FnOnce(&[f64]) -> Vec<f64>,
    ) -> Contact {
        let work = self.work(transforms);
        let uniform = || vec![self.problem.expected_mean_pressure(); self.problem.nodes()];
        let pressure = self.best.pressure.take().map_or_else(uniform, P::into);
        let displacement = displace(&pressure);
        let mut contact = Contact::new(self.problem, pressure, displacement, work, self.solver.name());
        contact.coarser = self.coarser;
        let is_missed = status == Status::Converged && !self.is_converged(&contact.certificate);
        contact.status = if is_missed { Status::Stalled } else { status };
        let ended = self.observer.end(&contact);
        contact.failure = self.failure.or(ended.err()).map(Into::into);
        contact
    }
}
