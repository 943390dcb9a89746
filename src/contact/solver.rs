//! The interface of all solvers.

use crate::contact::{Contact, Observer, Problem, Stop};
use crate::error::SolveError;
use crate::surface::Field;

/// A solver of contact problems. [`crate::contact::Run`] keeps the books of one.
pub trait Solver {
    /// Its name, as in scenes and on the command line.
    fn name(&self) -> &str;

    /// Its settings, in words.
    fn settings(&self) -> String;

    /// Solves `problem` from the flat start, until `stop`, showing every step to `observer`. The contact comes back whether
    /// the run converged or not: its status says so, and [`Contact::converged`] makes an error of one that did not.
    ///
    /// # Errors
    /// For problems that the solver cannot take on.
    fn solve(&self, problem: &Problem, stop: &Stop, observer: &mut dyn Observer) -> Result<Contact, SolveError> {
        self.solve_from(None, problem, stop, observer)
    }

    /// Solves `problem` from the pressure `start`, such as the solution at a neighbouring load. Any values will do, see
    /// [`Problem::first_pressure`].
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
