//! Watching a solver: its beginning, every step, and its end.

use crate::contact::{Contact, Problem, Solver, Step, Stop};
use std::error::Error;
use std::ops::ControlFlow;

/// Why an observer cannot go on, such as a full disk.
pub type Failure = Box<dyn Error + Send + Sync>;

/// What an observer wishes after a step: to go on, to end the run with what it has found, or to end it since the observer failed.
pub type Wish = Result<ControlFlow<()>, Failure>;

/// Watches a solver. Solvers know this interface and never who watches.
///
/// `&mut ()` watches nothing and [`Each`] makes an observer of a closure. Several observers of one run are a tuple, a `Vec` or an
/// `Option`: each of them sees every step, and the run ends when any of them wishes or fails. A failure ends the run with
/// [`crate::contact::Status::ObserverFailed`]; [`Contact::converged`] returns it.
pub trait Observer {
    /// Sees what will be solved, by which solver, and when that stops.
    ///
    /// # Errors
    /// For an observer that cannot watch: the run ends at its first step.
    fn begin(&mut self, _solver: &dyn Solver, _problem: &Problem, _stop: &Stop) -> Result<(), Failure> {
        Ok(())
    }

    /// Sees one relaxation step; `Break` ends the run with what it has found.
    ///
    /// # Errors
    /// For an observer that cannot go on: the run ends.
    fn step(&mut self, step: &Step<'_>) -> Wish;

    /// Sees what came out.
    ///
    /// # Errors
    /// For an observer that could not finish.
    fn end(&mut self, _contact: &Contact) -> Result<(), Failure> {
        Ok(())
    }
}

/// The observer that calls a closure at each step.
///
/// ```
/// use asperity::contact::{ContactModulus, Each, Load, PolonskyKeer, Solver};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::ops::ControlFlow;
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
/// let mut areas = Vec::new();
/// let mut watch = Each(|step: &asperity::contact::Step<'_>| {
///     areas.push(step.measures().relative_area);
///     ControlFlow::Continue(())
/// });
/// let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut watch)?;
/// assert_eq!(areas.len(), contact.work.iterations + 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Each<F>(pub F);

impl<F: FnMut(&Step<'_>) -> ControlFlow<()>> Observer for Each<F> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        Ok((self.0)(step))
    }
}

impl Observer for () {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(ControlFlow::Continue(()))
    }
}

/// Forwards to the observers that `$self` holds: all see everything, and the first wish or failure counts.
macro_rules! forward {
    ($self:ident => $each:expr) => {
        fn begin(&mut $self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
            $each.map(|observer| observer.begin(solver, problem, stop)).fold(Ok(()), Result::and)
        }

        fn step(&mut $self, step: &Step<'_>) -> Wish {
            $each.map(|observer| observer.step(step)).fold(Ok(ControlFlow::Continue(())), both)
        }

        fn end(&mut $self, contact: &Contact) -> Result<(), Failure> {
            $each.map(|observer| observer.end(contact)).fold(Ok(()), Result::and)
        }
    };
}

/// The wish of two observers.
fn both(a: Wish, b: Wish) -> Wish {
    match (a?, b?) {
        (ControlFlow::Continue(()), wish) => Ok(wish),
        (wish, _) => Ok(wish),
    }
}

impl<O: Observer + ?Sized> Observer for &mut O {
    forward!(self => std::iter::once(&mut **self));
}

impl<O: Observer + ?Sized> Observer for Box<O> {
    forward!(self => std::iter::once(&mut **self));
}

impl<O: Observer> Observer for Option<O> {
    forward!(self => self.iter_mut());
}

impl<O: Observer> Observer for Vec<O> {
    forward!(self => self.iter_mut());
}

impl<A: Observer, B: Observer> Observer for (A, B) {
    forward!(self => [&mut self.0 as &mut dyn Observer, &mut self.1].into_iter());
}

impl<A: Observer, B: Observer, C: Observer> Observer for (A, B, C) {
    forward!(self => [&mut self.0 as &mut dyn Observer, &mut self.1, &mut self.2].into_iter());
}
