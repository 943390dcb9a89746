//! Contacts of viscoelastic solids that cannot be solved.

use super::{ProblemError, SolveError, SurfaceError};
use crate::sentence::worded;

worded! {
    /// A step in time of a viscoelastic contact that cannot be solved.
    #[derive(Debug, Clone)]
    pub enum CreepError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// The displacement by earlier pressures is not finite.
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        /// A step in time that is negative or not finite.
        #[error("the step in time is {step:?}: give a finite step that is not negative")]
        Step { step: f64 },
        /// A path in time that has no points.
        #[error("the path has no points: give a time and a load at least")]
        NoPoints,
        /// Times of a path that fall or are not finite.
        #[error("the time {time:?} comes after the time {before:?}: give finite times in ascending order")]
        Order { before: f64, time: f64 },
        /// Two kinds of loads between which a path is no straight line.
        #[error(
            "the path goes from {from} to {to}: between two times give loads of one kind, or change the kind at one time"
        )]
        Kinds { from: String, to: String },
        /// A setting that must be positive and finite.
        #[error("{name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
    }
}
