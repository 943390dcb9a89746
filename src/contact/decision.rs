//! Decisions of solvers on their way from step to step.

use strum::{EnumCount, EnumIter, EnumMessage, IntoStaticStr};

/// The decision of a solver on its way to a step, for those who ask why a run is as long as it is.
///
/// ```
/// use asperity::contact::{ContactModulus, Decision, Each, Load, PolonskyKeer, Solver, Step};
/// use asperity::{Grid, Indenter, Problem, Stop};
/// use std::ops::ControlFlow;
/// let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(256, 1.0)?)?;
/// let problem = Problem::new(sine, ContactModulus(1.0), Load::ReducedPressure(0.1))?;
/// let mut conjugate = 0;
/// let mut watch = Each(|step: &Step<'_>| {
///     conjugate += usize::from(matches!(step.decision(), Some(Decision::Conjugate { .. })));
///     ControlFlow::Continue(())
/// });
/// PolonskyKeer.solve(&problem, &Stop::default(), &mut watch)?.converged()?;
/// assert!(conjugate > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, EnumCount, EnumIter, EnumMessage, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum Decision {
    /// The state at the start, or interpolated from a coarser grid.
    #[strum(message = "start, or from the coarser grid")]
    Start,
    /// A step of conjugate gradients on one contact set: so many times the direction, which is the residual (preconditioned, if
    /// it is) and a share of the direction before. With the share 0 the directions begin anew.
    #[strum(message = "conjugate gradients")]
    Conjugate {
        /// The step over the direction, `alpha`.
        length: f64,
        /// The share of the direction before, `beta`.
        share: f64,
    },
    /// A step of conjugate gradients by which nodes entered or left the contact.
    #[strum(message = "nodes exchanged")]
    Exchange,
    /// A gradient step, since the energy would have risen otherwise.
    #[strum(message = "gradient step")]
    Descend,
    /// A free update of the whole contact set.
    #[strum(message = "whole-set update, free")]
    WholeSet,
    /// A guarded step, by which the energy falls for certain.
    #[strum(message = "guarded step")]
    Guarded,
    /// A step of damped motion.
    #[strum(message = "damped motion")]
    Damped,
    /// A step of FIRE at its time step.
    #[strum(message = "FIRE: same time step")]
    Coast,
    /// A step of FIRE with a longer time step.
    #[strum(message = "FIRE: longer time step")]
    Accelerate,
    /// A step of FIRE from rest with a shorter time step, since the power was negative.
    #[strum(message = "FIRE: stopped, shorter time step")]
    Halt,
}

impl Decision {
    /// Its name.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
