//! The interfaces of solvers and of observers.

use crate::contact::{Contact, Problem, Relaxation, Step, Stop};
use crate::error::{Failure, SolveError};
use crate::surface::Field;
use std::ops::ControlFlow;

/// A solver of contact problems. [`crate::contact::Run`] does the bookkeeping of a solve.
pub trait Solver {
    /// Name of the solver, as in scenes and on the command line.
    fn name(&self) -> &str;

    /// Settings of the solver, in words.
    fn settings(&self) -> String;

    /// The theoretical relaxation rates of free waves, for solvers with constant rates.
    fn relaxation(&self, _problem: &Problem) -> Option<Relaxation> {
        None
    }

    /// Solves `problem` from the flat start, until `stop`, showing every step to `observer`. The contact is returned
    /// even if the run did not converge: its status states it, and [`Contact::converged`] returns an error if it did
    /// not.
    ///
    /// # Errors
    /// For problems that the solver cannot take on.
    fn solve(&self, problem: &Problem, stop: &Stop, observer: &mut dyn Observer) -> Result<Contact, SolveError> {
        self.solve_from(None, problem, stop, observer)
    }

    /// Solves `problem` from the pressure `start`, such as the solution at a neighbouring load. Any values are allowed,
    /// see [`Problem::first_pressure`].
    ///
    /// # Errors
    /// The errors of [`Solver::solve`].
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

/// The wish of an observer after a step: continue, end the run with its best state, or end it because the observer
/// failed.
pub type Wish = Result<ControlFlow<()>, Failure>;

/// Observes a solver. Solvers know only this interface, not the observer.
///
/// `&mut ()` does nothing, and [`crate::contact::Each`] makes an observer of a closure. Several observers of one run
/// are a tuple, a `Vec` or an `Option`: each of them sees every step, and the run ends when any of them wishes or
/// fails. A failure ends the run with [`crate::contact::Status::ObserverFailed`]; [`Contact::converged`] returns it.
pub trait Observer {
    /// Called before the first step, with the problem, the solver and its goals.
    ///
    /// # Errors
    /// For an observer that cannot watch: the run ends at its first step.
    fn begin(&mut self, _solver: &dyn Solver, _problem: &Problem, _stop: &Stop) -> Result<(), Failure> {
        Ok(())
    }

    /// Called at each step; `Break` ends the run with its best state.
    ///
    /// # Errors
    /// For an observer that cannot go on: the run ends.
    fn step(&mut self, step: &Step<'_>) -> Wish;

    /// Asked in each iteration of work that has no step of a solver to show, such as plastic flow below the surface; `Break` ends the work.
    ///
    /// # Errors
    /// For an observer that cannot go on: the work ends.
    fn ask(&mut self) -> Wish {
        Ok(ControlFlow::Continue(()))
    }

    /// Called at the end, with the contact.
    ///
    /// # Errors
    /// For an observer that could not finish.
    fn end(&mut self, _contact: &Contact) -> Result<(), Failure> {
        Ok(())
    }
}
