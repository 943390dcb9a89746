//! Errors of contacts with adhesion.

use super::{ProblemError, SolveError, SurfaceError};
use crate::sentence::{LengthValue, shortened, worded};

worded! {
    /// A contact with adhesion that cannot be posed or solved.
    #[derive(Debug, Clone)]
    pub enum AdhesionError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// A quantity that must be positive and finite is not.
        #[error("the {name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// A load that is not finite.
        #[error("the {name} is {value:?}: give a finite value")]
        NotFinite { name: &'static str, value: f64 },
        /// A table that is no attraction.
        #[error("the table is no attraction: {words}", words = shortened(reason))]
        Table {
            /// The point of the table that is at fault, counted from 0, if it is one.
            point: Option<usize>,
            /// What is wrong.
            reason: String,
        },
        /// A hardness or a motion beside adhesion.
        #[error("adhesion is solved for elastic contacts at rest: leave out the {what}")]
        NotElastic { what: &'static str },
        /// A grid that does not resolve the zone in which the attraction acts at an edge.
        #[error(
            "the grid is too coarse for this attraction: its process zone at an edge is {zone:.3e} long, {spacings:.2} spacings, so \
             that the nodes would hold the edges fast. Use at least {points} points along x, or a longer range", zone = LengthValue(*zone)
        )]
        Coarse { zone: f64, spacings: f64, points: usize },
        /// A mean gap that is not positive.
        #[error("the mean gap is {value:?}: give a positive one")]
        MeanGap { value: f64 },
        /// A gap or an approach at which surfaces are farther from each other, or deeper in each other, than any contact is.
        #[error(
            "the {name} is {value:?}: give one of at most {most:.0e}, as no contact with adhesion is as far apart or as deep"
        )]
        Far { name: &'static str, value: f64, most: f64 },
        /// A control that the boundary leaves without a meaning.
        #[error("{reason}")]
        Control { control: &'static str, reason: &'static str },
        /// A damped motion on a free boundary.
        #[error("damped motion needs a periodic boundary: choose the adhesion method fast or safe")]
        FreeMotion,
        /// The state was not found.
        #[error(
            "the state with adhesion was not found in {steps} iterations: its residual is {residual:.1e}. Allow more iterations or a larger \
             tolerance, or use another method; along a path, smaller steps help as well"
        )]
        NotFound { steps: usize, residual: f64 },
        /// An observer stopped the solve.
        #[error("the solve was stopped")]
        Stopped,
    }
}
