//! Flows through a contact that cannot be computed.

use super::{ProblemError, SolveError};
use crate::sentence::worded;

worded! {
    /// A flow through a contact that cannot be computed.
    #[derive(Debug, Clone, PartialEq)]
    pub enum FlowError {
        /// A field that does not have the shape of the grid.
        #[error("a field of shape {found:?} does not fit a grid of {ny} x {nx} points", ny = expected[0], nx = expected[1])]
        Shape { found: Vec<usize>, expected: [usize; 2] },
        /// A gap that is not finite.
        #[error("the gap at row {row}, column {column} is {value:?}: all gaps must be finite", row = index[0], column = index[1])]
        Gap { index: [usize; 2], value: f64 },
        /// More cells than the solver can number.
        #[error("the flow on {cells} cells is too large for this solver: give fewer than 4e9 points")]
        TooLarge { cells: usize },
        /// A tolerance out of its range.
        #[error("the tolerance of the flow is {value:?}: give a value from 1e-12 to below 1")]
        Tolerance { value: f64 },
        /// Bounds that are wider than the tolerance.
        #[error(
            "the bounds of the flow, {lower:.6e} and {upper:.6e}, are wider than the relative tolerance {tolerance:.1e} after {steps} \
             steps: raise the tolerance"
        )]
        NotConverged { lower: f64, upper: f64, tolerance: f64, steps: usize },
        /// Resistivities that do not make sense.
        #[error(
            "the resistivities are {first:?} and {second:?}: give two values that are finite, not negative, and not both zero"
        )]
        Resistivity { first: f64, second: f64 },
        /// Conductivities that do not make sense.
        #[error("the conductivities are {first:?} and {second:?}: give two values that are finite and positive")]
        Conductivity { first: f64, second: f64 },
        /// Values for more than two bodies.
        #[error(
            "{values} resistivities or conductivities are given, but a contact has two bodies: give one value for both, or two"
        )]
        Bodies { values: usize },
        /// Two descriptions of the same bodies.
        #[error("both resistivities and conductivities are given: give one of them")]
        Twice,
        /// A solid whose elastic response is not that of conduction.
        #[error(
            "the conductance follows from the stiffness on half-spaces only, since current flows through a {solid} by another law than force: \
             leave the layer out"
        )]
        NeedsHalfSpace { solid: String },
        /// A contact that moves over its solid.
        #[error(
            "the conductance follows from the stiffness of an elastic contact at rest, but this one moves or has a history: leave it out"
        )]
        NeedsRest,
    }
}

worded! {
    /// A load at which a surface seals that cannot be found.
    #[derive(Debug)]
    pub enum SealError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        /// A width out of its range.
        #[error("the relative width of the load is {value:?}: give a value from 1e-9 to below 1")]
        Width { value: f64 },
        /// A line.
        #[error("a line is sealed by one node that touches, under any load: give a surface")]
        Line,
        /// A surface that no load opens.
        #[error(
            "the contact seals along {axis} under all loads down to the reduced pressure {reduced_pressure:.1e}: give another axis or surface"
        )]
        Always { axis: &'static str, reduced_pressure: f64 },
        /// A surface that no load seals.
        #[error(
            "the gap stays open along {axis} under all loads up to the reduced pressure {reduced_pressure:.1e}: raise the hardness, if there is one"
        )]
        Never { axis: &'static str, reduced_pressure: f64 },
    }
}
