//! Solids that yield below the surface and cannot be solved.

use super::{ProblemError, SolveError, SurfaceError};

/// A contact of a solid that yields below its surface, which cannot be solved.
#[derive(Debug, Clone, thiserror::Error)]
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
}
