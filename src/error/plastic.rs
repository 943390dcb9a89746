//! Solids that yield below the surface and cannot be solved.

use super::{ProblemError, SolveError, SurfaceError};
use crate::sentence::worded;

worded! {
    /// A contact of a solid that yields below its surface, which cannot be solved.
    #[derive(Debug, Clone)]
    pub enum PlasticError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// A quantity that must be positive and finite is not.
        #[error("the {name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// A solid without hardening.
        #[error(
            "the hardening modulus is {hardening:?}: give a positive, finite value; {least:e}, a millionth of Young's modulus, hardly differs \
             from none"
        )]
        NoHardening { hardening: f64, least: f64 },
        #[error("the kinematic hardening modulus is {kinematic:?}: give a finite value that is not negative")]
        Kinematic { kinematic: f64 },
        #[error("Poisson's ratio is {poisson:?}: it must lie above -1 and at most at 0.5")]
        Poisson { poisson: f64 },
        /// Depths of interfaces that do not begin at 0 or do not rise.
        #[error("the interface at depth {depth:?} follows the one at {before:?}: give finite depths that rise, from 0 on")]
        LayerOrder { before: f64, depth: f64 },
        /// No layers, or too many.
        #[error("there are {count} layers below the surface: give between 1 and 10000")]
        LayerCount { count: usize },
        /// Layers that cannot be made.
        #[error(
            "layers whose first one is {first:?} thick, whose thickness grows by {ratio:?} and that end at depth {depth:?} cannot be made: give \
             positive, finite lengths and a ratio of at least 1"
        )]
        Grading { first: f64, ratio: f64, depth: f64 },
        /// A free boundary.
        #[error(
            "the stress that a plastic strain leaves is known below a periodic surface only: make the boundary periodic"
        )]
        NeedsPeriodic,
        /// A solid of the problem that is not the one that yields.
        #[error(
            "the problem has a {solid} of contact modulus {found:?}, but the solid that yields is a half-space of {expected:?}: give the problem \
             that modulus"
        )]
        OtherSolid { solid: String, found: f64, expected: f64 },
        /// A hardness beside the yield stress.
        #[error("both a yield stress and a hardness are given: leave the hardness out")]
        Hardness,
        /// A load that is not a pressure.
        #[error(
            "a {load} cannot be given where the solid yields below the surface: give a mean pressure, a reduced pressure, a force or a mean gap"
        )]
        NeedsPressure { load: &'static str },
        /// A load below zero, or not finite.
        #[error("the {load} is {value:?}: give a finite value that is not negative")]
        Load { load: &'static str, value: f64 },
        /// A mean pressure under which no depth is deep enough.
        #[error(
            "the mean pressure of {mean_pressure:?} is above {most}, (1 - nu)/(1 - 2 nu) times the yield stress, from which on the solid yields at \
             all depths, and no layers are deep enough: give less pressure, or a higher yield stress", most = crate::quantity::number_in_words(*limit)
        )]
        YieldsEverywhere { mean_pressure: f64, limit: f64 },
        /// A setting outside its range.
        #[error("{name} is {value}: it must lie in {range}")]
        Range { name: &'static str, value: f64, range: &'static str },
        /// Errors of a history that has begun.
        #[error("errors are estimated of a history from its first load on, but this one has begun: ask for them before")]
        HasBegun,
        /// An observer stopped the step.
        #[error("the load step was stopped")]
        Stopped,
        /// A history that needs more memory than is free, or than the system allows.
        #[error(
            "{layers} layers below {ny} x {nx} points need {memory}, {left}: give fewer layers or points", ny = shape[0], nx = shape[1],
            memory = crate::quantity::bytes_in_words(*needed), left = crate::memory::free_in_words(*free)
        )]
        Memory { layers: usize, shape: [usize; 2], needed: f64, free: Option<f64> },
    }
}
