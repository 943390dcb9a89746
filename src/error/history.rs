//! Contacts with friction, and histories of contacts, that cannot be solved.

use super::{
    AdhesionError, CreepError, FlowError, GridError, MotionError, PlasticError, ProblemError, SolveError, SurfaceError,
};
use crate::sentence::worded;

worded! {
    /// A tangential load that cannot be carried or solved.
    #[derive(Debug, Clone)]
    pub enum SlipError {
        #[error(transparent)]
        Grid(#[from] GridError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// A quantity that must be positive and finite is not.
        #[error("the {name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// A coefficient of friction that is not positive and finite.
        #[error(
            "the coefficient of friction is {value}: give a {finite}number above 0",
            finite = if *value == f64::INFINITY { "finite " } else { "" }
        )]
        Coefficient { value: f64 },
        /// A tangential load that is at the limit of friction, or above it.
        #[error(
            "the tangential load {tangential:?} makes everything slide, since friction carries less than {limit:?}: give \
             less, or more friction or more normal load"
        )]
        Sliding { tangential: f64, limit: f64 },
        /// A hardness beside friction.
        #[error("friction cannot be computed where the surface yields: leave the hardness out, or the friction")]
        Yielding,
        /// A normal load that is not a pressure.
        #[error(
            "friction needs a given pressure, but {load} is given: give a mean pressure, a reduced pressure or a force"
        )]
        NeedsPressure { load: String },
        /// Dundurs' constant out of its range.
        #[error("Dundurs' constant beta is {value:?}: it must lie between -0.5 and 0.5")]
        Beta { value: f64 },
    }
}

worded! {
    /// A history that cannot go on.
    #[derive(Debug, Clone)]
    pub enum HistoryError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        #[error(transparent)]
        Slip(#[from] SlipError),
        #[error(transparent)]
        Creep(#[from] CreepError),
        #[error(transparent)]
        Motion(#[from] MotionError),
        #[error(transparent)]
        Adhesion(AdhesionError),
        #[error(transparent)]
        Plastic(PlasticError),
        #[error(transparent)]
        Flow(#[from] FlowError),
        /// A load that is not a pressure, on a surface that has yielded.
        #[error("the {load} cannot be solved after the surface has yielded: give pressures, or leave the hardness out")]
        Unload { load: &'static str },
        /// A path without points.
        #[error("the path has no points: give at least one")]
        Pathless,
        /// An observer stopped the history.
        #[error("the history was stopped")]
        Stopped,
    }
}

impl From<AdhesionError> for HistoryError {
    fn from(error: AdhesionError) -> Self {
        match error {
            AdhesionError::Stopped => Self::Stopped,
            error => Self::Adhesion(error),
        }
    }
}

impl From<PlasticError> for HistoryError {
    fn from(error: PlasticError) -> Self {
        match error {
            PlasticError::Stopped => Self::Stopped,
            error => Self::Plastic(error),
        }
    }
}
