//! Observers of one closure, of nothing, and of several observers together.

use crate::contact::{Contact, Failure, Observer, Problem, Solver, Step, Stop, Wish};
use std::ops::ControlFlow;

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
///     areas.push(step.counted().relative_area);
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

/// Whether an observer lets work without steps go on. One that fails does not.
pub(crate) fn goes_on(observer: &mut dyn Observer) -> bool {
    matches!(observer.ask(), Ok(ControlFlow::Continue(())))
}

impl Observer for () {
    fn step(&mut self, _: &Step<'_>) -> Wish {
        Ok(ControlFlow::Continue(()))
    }
}

/// Forwards to the observers that `$self` holds: all of them see every step, and the first wish or failure counts.
macro_rules! forward {
    ($self:ident => $each:expr) => {
        fn begin(&mut $self, solver: &dyn Solver, problem: &Problem, stop: &Stop) -> Result<(), Failure> {
            $each.map(|observer| observer.begin(solver, problem, stop)).fold(Ok(()), Result::and)
        }

        fn step(&mut $self, step: &Step<'_>) -> Wish {
            $each.map(|observer| observer.step(step)).fold(Ok(ControlFlow::Continue(())), both)
        }

        fn ask(&mut $self) -> Wish {
            $each.map(|observer| observer.ask()).fold(Ok(ControlFlow::Continue(())), both)
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
