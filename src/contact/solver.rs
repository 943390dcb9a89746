//! What all solvers have in common.

use crate::contact::best::Best;
use crate::contact::result::Ended;
use crate::contact::{Contact, Load, Observer, Problem, Status, Step, Stop, Work, chunks};
use crate::elastic::HalfSpace;
use crate::error::SolveError;
use crate::surface::Field;
use std::ops::ControlFlow;
use std::time::Instant;

/// Iterations without a better state after which a run is given up, see [`Best::is_stale`]: long enough for the plateaus of
/// conjugate gradients and damped dynamics.
const PATIENCE: usize = 2000;

/// A solver of contact problems.
pub trait Solver {
    /// Its name, as on the command line.
    fn name(&self) -> &'static str;

    /// Its settings, in words.
    fn settings(&self) -> String;

    /// Solves `problem` from the flat start, until `stop`, showing every step to `observer`.
    ///
    /// # Errors
    /// [`SolveError::NotConverged`] with the best state found, when the cap is reached or nothing improves any more. A run that
    /// the observer ends is no error; its status says so.
    fn solve(&self, problem: &Problem, stop: &Stop, observer: &mut dyn Observer) -> Result<Contact, SolveError> {
        self.solve_from(None, problem, stop, observer)
    }

    /// Solves `problem` from the pressure `start`, such as the solution at a neighbouring load. Any values will do: those that are
    /// no pressures (negative, not finite) count as none, and what is left is scaled to the load.
    ///
    /// # Errors
    /// As [`Solver::solve`].
    ///
    /// # Panics
    /// If the shape of `start` is not that of the grid.
    fn solve_from(
        &self,
        start: Option<&Field>,
        problem: &Problem,
        stop: &Stop,
        observer: &mut dyn Observer,
    ) -> Result<Contact, SolveError>;
}

/// The pressure to start from: what `start` holds of one, scaled to the mean pressure if one is given, or the uniform pressure.
pub(super) fn first_pressure(start: Option<&Field>, problem: &Problem) -> Vec<f64> {
    let load = problem.expected_mean_pressure();
    let Some(start) = start else { return vec![load; problem.nodes()] };
    assert_eq!(start.shape(), problem.surface().grid().shape(), "the start must fit the grid");
    let pressure: Vec<f64> = start.iter().map(|&p| if p.is_finite() { p.max(0.0) } else { 0.0 }).collect();
    let highest = chunks::visit(pressure.len(), |range| range.fold(0.0, |high: f64, i| high.max(pressure[i])));
    let highest = highest.into_iter().fold(0.0, f64::max);
    if highest <= 0.0 {
        return vec![load; pressure.len()];
    }
    if let Load::MeanGap(_) = problem.load() {
        return pressure;
    }
    let mean = chunks::sum(pressure.len(), |i| pressure[i] / highest) / pressure.len() as f64;
    pressure.into_iter().map(|p| p / highest * (load / mean)).collect()
}

/// The bookkeeping of a run: iterations, the clock that halts for observers, the best state, and the reasons to stop.
pub(super) struct Run<'a, P = Vec<f64>> {
    observer: &'a mut dyn Observer,
    stop: Stop,
    clock: Instant,
    observed_secs: f64,
    iterations: usize,
    patience: usize,
    /// The best state found.
    pub best: Best<P>,
}

impl<'a, P: Clone> Run<'a, P> {
    pub fn new(stop: &Stop, observer: &'a mut dyn Observer) -> Self {
        let best = Best::none(0);
        let clock = Instant::now();
        Self { observer, stop: *stop, clock, observed_secs: 0.0, iterations: 0, patience: PATIENCE, best }
    }

    /// The same with another patience.
    pub fn with_patience(self, patience: usize) -> Self {
        Self { patience, ..self }
    }

    pub fn iterations(&self) -> usize {
        self.iterations
    }

    pub fn work(&self, transforms: u64) -> Work {
        let seconds = self.clock.elapsed().as_secs_f64() - self.observed_secs;
        Work { iterations: self.iterations, transforms, seconds }
    }

    /// Whether a certificate meets the tolerance.
    pub fn is_converged(&self, eta: f64) -> bool {
        eta <= self.stop.tolerance()
    }

    /// Shows a step to the observer and says why to stop, if so.
    pub fn show(&mut self, step: &Step<'_>) -> Option<Status> {
        let ended = self.pass(step);
        match step.certificate() {
            Some(eta) if self.is_converged(eta) => Some(Status::Converged),
            _ if ended.is_some() => ended,
            _ if self.best.is_stale(self.iterations, self.patience) => Some(Status::Stalled),
            _ => None,
        }
    }

    /// Shows a step on the way to one that counts, and says why to stop, if so.
    pub fn pass(&mut self, step: &Step<'_>) -> Option<Status> {
        let before = Instant::now();
        let wish = self.observer.step(step);
        self.observed_secs += before.elapsed().as_secs_f64();
        match wish {
            ControlFlow::Break(()) => Some(Status::StoppedByObserver),
            ControlFlow::Continue(()) => {
                (self.iterations >= self.stop.max_iterations()).then_some(Status::IterationCap)
            }
        }
    }

    /// Goes on to the next iteration.
    pub fn advance(&mut self) {
        self.iterations += 1;
    }

    /// The contact with `pressure`, that of the best state, or with the uniform one, which is always feasible.
    pub fn finish(
        self,
        problem: &Problem,
        pressure: Option<Vec<f64>>,
        half_space: HalfSpace,
        ended: Ended,
    ) -> Result<Contact, SolveError> {
        let status = ended.status;
        let pressure = pressure.unwrap_or_else(|| vec![problem.expected_mean_pressure(); problem.nodes()]);
        let contact = Contact::of(problem, pressure, half_space, ended);
        match status {
            Status::Converged | Status::StoppedByObserver => Ok(contact),
            Status::IterationCap | Status::Stalled => Err(SolveError::NotConverged(Box::new(contact))),
        }
    }
}
