//! Errors of contacts that move.

use super::{ProblemError, SolveError, SurfaceError};
use crate::sentence::worded;

worded! {
    /// A contact that slides or rolls steadily and cannot be solved.
    #[derive(Debug, Clone)]
    pub enum MotionError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// A quantity that must be positive and finite is not.
        #[error("the {name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// A quantity that must be finite is not.
        #[error("the {name} is {value:?}: give a finite value")]
        NotFinite { name: &'static str, value: f64 },
        /// Dundurs' parameter beyond its range.
        #[error("Dundurs' parameter beta is {value:?}: it must lie between -0.5 and 0.5")]
        Beta { value: f64 },
        /// A tangential force that friction cannot carry.
        #[error(
            "a tangential force of {ratio:?} of the limit of friction slides: give a part between -1 and 1, or a creepage"
        )]
        Slides { ratio: f64 },
        /// A solid whose tangential compliance on a line is not the normal one.
        #[error("rolling is solved on half-spaces, but this is a {solid}: leave the layer out")]
        NeedsHalfSpace { solid: String },
        /// A contact that yields.
        #[error("rolling is solved for elastic contacts: leave the hardness out")]
        NeedsHardWall,
        /// The contact slides already.
        #[error("the problem slides or rolls already: give the problem at rest")]
        NeedsRest,
        /// A problem at rest, or that rolls, where one that slides is needed.
        #[error("the problem does not slide: give it a speed and the terms of a viscoelastic solid")]
        NeedsSliding,
        /// A step of rolling in which material would cross the contact.
        #[error(
            "the step of rolling is {step:?}, longer than the contact of {length:?}: give a shorter one, such as the spacing of the grid"
        )]
        LongStep { step: f64, length: f64 },
    }
}
