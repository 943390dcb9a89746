//! What solvers do from step to step.

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
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Decision {
    /// The state at the start, or interpolated from a coarser grid.
    Start,
    /// A step of conjugate gradients on one contact set. The direction is the (preconditioned) residual plus `beta`
    /// times the previous direction. With `beta = 0` the method restarts.
    Conjugate {
        /// The length `alpha` of the step, in units of the direction.
        length: f64,
        /// The weight `beta` of the previous direction.
        share: f64,
    },
    /// A step of conjugate gradients by which nodes entered or left the contact.
    Exchange,
    /// A gradient step, since the energy would have risen otherwise.
    Descend,
    /// A free update of the whole contact set.
    WholeSet,
    /// A guarded step, which always lowers the energy.
    Guarded,
    /// A step of damped motion.
    Damped,
    /// A step of FIRE at its time step.
    Coast,
    /// A step of FIRE with a longer time step.
    Accelerate,
    /// A step of FIRE from rest with a shorter time step, since the power was negative.
    Halt,
}

impl Decision {
    /// Its name and a short description, in the order of declaration.
    pub const NAMES: [(&str, &str); 10] = [
        ("start", "start, or from the coarser grid"),
        ("conjugate", "conjugate gradients"),
        ("exchange", "nodes exchanged"),
        ("descend", "gradient step"),
        ("whole-set", "active-set update, free"),
        ("guarded", "guarded step"),
        ("damped", "damped motion"),
        ("coast", "FIRE: same time step"),
        ("accelerate", "FIRE: longer time step"),
        ("halt", "FIRE: stopped, shorter time step"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        let number = match self {
            Self::Start => 0,
            Self::Conjugate { .. } => 1,
            Self::Exchange => 2,
            Self::Descend => 3,
            Self::WholeSet => 4,
            Self::Guarded => 5,
            Self::Damped => 6,
            Self::Coast => 7,
            Self::Accelerate => 8,
            Self::Halt => 9,
        };
        Self::NAMES[number].0
    }
}
