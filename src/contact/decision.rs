//! What solvers do from step to step.

use strum::{EnumCount, EnumIter, EnumMessage, IntoStaticStr};

/// What a solver did to reach a step. It helps to find out why a run needs many steps.
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
    /// A step of conjugate gradients on one contact set. The direction is the (preconditioned) residual plus `beta`
    /// times the previous direction. With `beta = 0` the method restarts.
    #[strum(message = "conjugate gradients")]
    Conjugate {
        /// The length `alpha` of the step, in units of the direction.
        length: f64,
        /// The weight `beta` of the previous direction.
        share: f64,
    },
    /// A step of conjugate gradients by which nodes entered or left the contact.
    #[strum(message = "nodes exchanged")]
    Exchange,
    /// A gradient step, since the energy would have risen otherwise.
    #[strum(message = "gradient step")]
    Descend,
    /// A free update of the whole contact set.
    #[strum(message = "active-set update, free")]
    WholeSet,
    /// Active-set updates on candidate nodes with transforms in single precision, and then a displacement in double precision.
    #[strum(message = "active-set updates in single precision")]
    SinglePrecision,
    /// Active-set updates on candidate nodes with a compliance that is split into near and far sums, and then a displacement in
    /// double precision.
    #[strum(message = "active-set updates, split compliance")]
    SplitCompliance,
    /// A guarded step, which always lowers the energy; of a contact that moves, to which no energy belongs, an extragradient step.
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
