//! Errors, one enum per concern. The message of a variant states what is wrong, with the wrong values (its fields), and
//! what to do.

#![allow(
    missing_docs,
    reason = "fields are the values in the sentence of their variant, and a wrapped error speaks for itself"
)]

mod adhesion;
mod conflict;
mod creep;
mod file;
mod flow;
mod history;
mod input;
mod motion;
mod plastic;
mod preparation;
mod remedy;
mod roughness;
mod setup;
mod study;
mod text;

pub use adhesion::AdhesionError;
pub use conflict::{Conflict, ConflictRule};
pub use creep::CreepError;
pub use file::FileError;
pub(crate) use file::reason;
pub use flow::{FlowError, SealError};
pub use history::{HistoryError, SlipError};
pub use input::{InputError, is_input, sentence_of};
pub use motion::MotionError;
pub use plastic::PlasticError;
pub use preparation::PreparationError;
pub use roughness::RoughnessError;
pub use setup::SetupError;
pub use study::StudyError;
pub use text::{ExpectedValue, FoundValue, TextFault, TextPlace};

use crate::sentence::{LengthValue, shortened, worded};
use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;

/// The failure of an observer, such as a full disk.
pub type Failure = Box<dyn Error + Send + Sync>;

worded! {
    /// An impossible grid.
    #[derive(Debug, Clone, PartialEq)]
    pub enum GridError {
        /// Fewer than [`crate::Grid::MIN_POINTS`] points along an axis.
        #[error("{points} points along {axis} are too few: give at least 4")]
        TooFewPoints { axis: &'static str, points: usize },
        /// More than [`crate::Grid::MAX_POINTS`] points, or more than this machine has memory for.
        #[error("a grid of {ny} x {nx} points does not fit in memory: give fewer points", ny = shape[0], nx = shape[1])]
        TooManyPoints { shape: [usize; 2] },
        /// A period that is not positive and finite.
        #[error("the length along {axis} is {length:?}: give a positive, finite length", length = LengthValue(*length))]
        Length { axis: &'static str, length: f64 },
        /// A solid other than a half-space without images.
        #[error(
            "a free boundary needs a half-space, but this is a {solid}: make the boundary periodic, or leave the layer out"
        )]
        FreeSolid { solid: String },
        /// A solid that is not known for all waves.
        #[error(
            "the stiffness of the solid is given for wavenumbers from {first:e} to {last:e}, but the grid has waves from {longest:e} to \
             {shortest:e}: give it for all of them"
        )]
        UnknownWaves { first: f64, last: f64, longest: f64, shortest: f64 },
        /// A solid whose response to a traction along its surface is not known.
        #[error(
            "the displacement by a tangential load is not known of {solid}: use a half-space whose boundary is periodic, or free along \
             both axes"
        )]
        ShearedSolid { solid: String },
    }
}

worded! {
    /// A surface that cannot be generated or used.
    #[derive(Debug, Clone, PartialEq)]
    pub enum SurfaceError {
        #[error(transparent)]
        Grid(#[from] GridError),
        /// The heights do not have the shape of the grid.
        #[error("heights of shape {found:?} do not fit a grid of {ny} x {nx} points", ny = expected[0], nx = expected[1])]
        Shape { found: Vec<usize>, expected: [usize; 2] },
        /// A height is NaN or infinite.
        #[error("the height at row {row}, column {column} is {value:?}: all heights must be finite", row = index[0], column = index[1])]
        NonFinite { index: [usize; 2], value: f64 },
        /// The differences of heights are beyond the range of numbers.
        #[error(
            "the heights lie between {least:?} and {most:?}, and differences of so large numbers overflow: give them in a larger unit"
        )]
        Overflow { least: f64, most: f64 },
        /// A parameter that must be positive and finite is not.
        #[error("{name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// A Hurst exponent outside `(0, 1]`.
        #[error("the Hurst exponent is {value:?}: it must lie above 0 and at most at 1")]
        Hurst { value: f64 },
        /// The wavelengths of a spectrum are out of order.
        #[error(
            "the short cut-off {short_cutoff:?} is not shorter than the roll-off wavelength {rolloff:?}: make it shorter"
        )]
        CutoffOrder { rolloff: f64, short_cutoff: f64 },
        /// The roll-off is longer than the period.
        #[error(
            "the roll-off wavelength {rolloff:?} is longer than the period {period:?}: make it shorter, or make the cell \
             larger"
        )]
        RolloffTooLong { rolloff: f64, period: f64 },
        /// The grid cannot carry the shortest wavelength.
        #[error(
            "the short cut-off {short_cutoff:?} is too short for the grid, whose shortest wavelength is {shortest:?}: \
             raise it, or use more points"
        )]
        CutoffTooFine { short_cutoff: f64, shortest: f64 },
        /// An indenter that only makes sense on the other kind of grid.
        #[error("a {indenter} needs a {needs}, but the grid is a {has}")]
        WrongDimension { indenter: &'static str, needs: &'static str, has: &'static str },
        /// An indenter whose half-width or radius is too large for the cell.
        #[error(
            "a {indenter} of half-width {half_width:?} does not fit the shortest period {period:?}: make the half-width \
             less than half the period"
        )]
        TooWide { indenter: &'static str, half_width: f64, period: f64 },
        /// The grid cannot carry the shortest wavelength along an axis, which a lay or a table of a spectrum sets.
        #[error(
            "the shortest wavelength along {axis}, {wavelength:?}, is too short for the grid, whose shortest one is {shortest:?}: use more \
             points, or a longer short cut-off"
        )]
        WavesTooFine { axis: &'static str, wavelength: f64, shortest: f64 },
        /// A table of a spectrum with impossible values.
        #[error("the table of a spectrum cannot be used: {words}", words = shortened(reason))]
        SpectrumTable {
            /// The value of the table that is at fault, counted from 0, if it is one.
            place: Option<usize>,
            /// What is wrong.
            reason: String,
        },
        /// The direction of a lay is NaN or infinite.
        #[error("the angle of the lay is {value:?}: give a finite number of degrees")]
        Angle { value: f64 },
        /// A line has no lay.
        #[error("a line has no lay, but the Peklenik number is {peklenik:?}: leave it out, or give a surface")]
        LayOfLine { peklenik: f64 },
        /// No distribution has this skewness and kurtosis.
        #[error(
            "no heights have skewness {skewness:?} and kurtosis {kurtosis:?}: the kurtosis must be above skewness^2 + 1, which is {least:?}"
        )]
        Kurtosis { skewness: f64, kurtosis: f64, least: f64 },
        /// A distribution that is too close to the bound, or whose tails are too heavy.
        #[error(
            "heights of skewness {skewness:?} and kurtosis {kurtosis:?} are too extreme to be made: give a kurtosis farther from \
             skewness^2 + 1, or a smaller one"
        )]
        ExtremeHeights { skewness: f64, kurtosis: f64 },
        /// All heights of a distribution are the same.
        #[error("all heights of the distribution are the same, or they are too large: give another one")]
        OneHeight,
        /// No wavelength of the grid lies in the band of the spectrum.
        #[error("no wavelength of the cell lies between its period {period:?} and the short cut-off {short_cutoff:?}")]
        EmptySpectrum { period: f64, short_cutoff: f64 },
    }
}

worded! {
    /// An impossible contact problem.
    #[derive(Debug, Clone, PartialEq)]
    pub enum ProblemError {
        #[error(transparent)]
        Grid(#[from] GridError),
        /// A quantity that must be positive and finite is not.
        #[error("the {name} is {value:?}: give a positive, finite value")]
        NotPositive { name: &'static str, value: f64 },
        /// All heights are the same: the contact area of a flat is its whole area at any load.
        #[error(
            "the surface is flat (all heights are {height:?}): its contact is undefined, give a surface with different heights"
        )]
        Flat { height: f64 },
        /// A mean gap at which even the highest peak does not touch.
        #[error(
            "at a mean gap of {mean_gap:?} nothing touches: give less than {highest:?}, the height of the highest peak \
             above the mean"
        )]
        NothingTouches { mean_gap: f64, highest: f64 },
        /// A mean gap at which everything touches: all sufficiently large pressures have this gap.
        #[error(
            "at a mean gap of {mean_gap:?} everything touches, and the pressure is not determined: give a gap between 0 \
             and {highest:?}, or a pressure"
        )]
        EverythingTouches { mean_gap: f64, highest: f64 },
        /// A mean gap with a free boundary, for which it is not defined.
        #[error(
            "a mean gap of {mean_gap:?} is not a load if the boundary is free: give a pressure, a force, or the approach"
        )]
        GapOfFree { mean_gap: f64 },
        /// An approach on a solid for which it is not defined.
        #[error(
            "an approach of {approach:?} is not defined on a periodic half-space: give a mean gap or a pressure, or use \
             a layer or a free boundary"
        )]
        ApproachOfHalfSpace { approach: f64 },
        /// A mean pressure that the softer body cannot carry, even if all of it yields.
        #[error(
            "a mean pressure of {mean_pressure:?} is above the hardness of {hardness:?}, the highest pressure that the \
             body can carry: give a smaller load, a larger cell, or a higher hardness"
        )]
        AboveHardness { mean_pressure: f64, hardness: f64 },
        /// Values so large or small that sums of their squares are outside the range of doubles.
        #[error("the {name} of {value:?} is out of range: choose units in which it lies between 1e-100 and 1e100")]
        OutOfRange { name: &'static str, value: f64 },
        /// A contact that slides over a viscoelastic solid with a free boundary.
        #[error("steady sliding over a viscoelastic solid needs a periodic boundary: make both axes periodic")]
        NeedsPeriodic,
        /// A contact that rolls on a surface.
        #[error("rolling is solved for lines, but the grid has {ny} x {nx} points: give a line", ny = shape[0], nx = shape[1])]
        NeedsLine { shape: [usize; 2] },
        /// A quantity that must be finite is not.
        #[error("the {name} is {value:?}: give a finite value")]
        NotFinite { name: &'static str, value: f64 },
        /// A quantity that must not be negative is.
        #[error("the {name} is {value:?}: give a finite value that is not negative")]
        Negative { name: &'static str, value: f64 },
    }
}

worded! {
    /// A result of another code that cannot be judged.
    #[derive(Debug, Clone, PartialEq)]
    pub enum ClaimError {
        #[error(transparent)]
        Problem(#[from] ProblemError),
        /// The field does not have the shape of the heights.
        #[error(
            "the {quantity} of shape {found:?} does not fit heights of {ny} x {nx} points: {advice}", ny = expected[0], nx = expected[1],
            advice = if *is_transposed { "it is transposed, give the transpose" } else { "give one value for each height" }
        )]
        Shape { quantity: &'static str, found: Vec<usize>, expected: [usize; 2], is_transposed: bool },
        /// A value of the field is NaN or infinite.
        #[error("the {quantity} at row {row}, column {column} is {value:?}: all values must be finite", row = index[0], column = index[1])]
        NonFinite { quantity: &'static str, index: [usize; 2], value: f64 },
        /// A displacement without a load; its mean does not determine the load.
        #[error("no load is given: give a mean pressure, a reduced pressure or a mean gap")]
        NoLoad,
    }
}

worded! {
    /// Steps of another code that cannot be replayed.
    #[derive(Debug)]
    pub enum StepsError {
        #[error(transparent)]
        File(#[from] FileError),
        /// A step that does not fit the heights or is not finite.
        #[error("{file}, step {step} of the file: {source}", file = path.display())]
        Step { path: PathBuf, step: usize, source: ClaimError },
        /// Not a single step.
        #[error("no steps were found: give files of fields (.npy, .npz or text) with one or several steps each")]
        Nothing,
        /// Seconds that do not fit the steps.
        #[error("there are {seconds} times for {steps} steps: give one for each step")]
        Seconds { seconds: usize, steps: usize },
        /// Seconds in an archive that do not fit its steps.
        #[error("{file} has {seconds} times for {steps} steps: give one for each step", file = path.display())]
        SecondsOfFile { path: PathBuf, seconds: usize, steps: usize },
    }
}

worded! {
    /// An impossible setting of a solver or of its stop.
    #[derive(Debug, Clone, PartialEq)]
    pub enum SettingError {
        /// A setting outside its range.
        #[error("{name} is {value}: it must lie in {range}")]
        Range { name: &'static str, value: f64, range: &'static str },
        /// A grid that is not finer than the one before it.
        #[error("the grids go from {from} to {to} points per side: give the grids from coarse to fine")]
        NotFiner { from: usize, to: usize },
    }
}

worded! {
    /// A solve that did not reach its tolerance, or cannot be done.
    #[derive(Debug, Clone)]
    pub enum SolveError {
        /// The iteration limit, or the limit of accuracy, was reached.
        #[error(
            "not converged: {solver} stopped after {iterations} iterations ({reason}) with the certificate \
             {certificate:.3e} and a relative error of the pressure of at most {pressure_error_bound:.1e}"
        )]
        NotConverged { solver: String, iterations: usize, reason: String, certificate: f64, pressure_error_bound: f64 },
        /// An observer failed, which ended the run.
        #[error("{0}")]
        Observer(Arc<Failure>),
        /// A solver that needs a given pressure was given a mean gap.
        #[error("{solver} needs a given mean pressure: give one, or choose the solver multilevel or polonsky-keer")]
        NeedsPressure { solver: String },
        /// A solver for periodic boundaries was given a free one.
        #[error("{solver} works with periodic boundaries only: choose the solver multilevel or polonsky-keer")]
        NeedsWaves { solver: String },
        /// A solver without plasticity was given a hardness.
        #[error("{solver} cannot solve with a hardness: choose the solver multilevel or polonsky-keer")]
        NeedsHardWall { solver: String },
        /// A solver that minimises an energy was given a contact that slides or rolls steadily, to which no energy belongs.
        #[error(
            "{solver} solves contacts at rest only, but this one moves steadily over its solid: choose the solver monotone"
        )]
        NeedsRest { solver: String },
    }
}

/// A sentence on elastic constants that are missing, or that do not fit the number of bodies.
fn bodies_in_words(young: usize, poisson: usize) -> String {
    match (young, poisson) {
        (_, 0) => "Poisson's ratio is missing: give one value per body".into(),
        (0, _) => "Young's modulus is missing: give one value per body".into(),
        (2, 1) => "2 Young's moduli and 1 Poisson's ratio are given: give one of each per body; a study that varies one body takes lists \
                   of lists, such as young = [[210e9], [70e9]]"
            .into(),
        (1, 2) => "1 Young's modulus and 2 Poisson's ratios are given: give one of each per body, and write a ratio with a decimal point, \
                   such as 0.3"
            .into(),
        _ => format!("{young} Young's moduli and {poisson} Poisson's ratios are given: give one of each per body"),
    }
}

worded! {
    /// Elastic constants that do not define a solid.
    #[derive(Debug, Clone, PartialEq)]
    pub enum SolidError {
        /// No constants at all.
        #[error("the solid is empty: give the contact modulus, or Young's modulus and Poisson's ratio")]
        Nothing,
        /// A contact modulus together with elastic constants.
        #[error(
            "both a contact modulus and elastic constants are given: give only the modulus, or only Young's modulus and \
             Poisson's ratio"
        )]
        Both,
        /// Constants that are missing, or too many.
        #[error("{words}", words = bodies_in_words(*young, *poisson))]
        Bodies { young: usize, poisson: usize },
        #[error("Young's modulus is {young:?}: give a positive, finite value")]
        Young { young: f64 },
        #[error("the thickness of the layer is {thickness:?}: give a positive, finite length")]
        Thickness { thickness: f64 },
        /// A solid in which the stress cannot be computed.
        #[error(
            "the stress can be computed in a half-space only, below a line or a periodic surface: leave the stress out"
        )]
        NoStress,
        /// A base without a layer on it.
        #[error("a base is given without a layer on it: give the thickness of the layer, or leave the base out")]
        BaseWithoutLayer,
        /// A layer below an elastic body.
        #[error(
            "{bodies} Young's moduli are given with a layer: give only that of the layer, since the other body is rigid"
        )]
        BodiesOfLayer { bodies: usize },
        /// A layer with more than one Poisson's ratio.
        #[error("{count} Poisson's ratios are given for a layer: give one")]
        PoissonOfLayer { count: usize },
        #[error("Poisson's ratio is {poisson:?}: it must lie above -1 and at most at 0.5")]
        Poisson { poisson: f64 },
        /// A table that is not one of stiffnesses.
        #[error("the table of stiffnesses cannot be used: {words}", words = shortened(reason))]
        StiffnessTable { reason: String },
        /// A table of stiffnesses together with other constants.
        #[error("both a stiffness and elastic constants are given: give only the stiffness, or leave it out")]
        StiffnessAndConstants,
        /// Columns of a table of stiffnesses.
        #[error("there are {wavenumbers} wavenumbers and {stiffnesses} stiffnesses: give as many of both")]
        StiffnessColumns { wavenumbers: usize, stiffnesses: usize },
        #[error("a Prony term has the ratio {ratio:?} and the time {time:?}: give positive, finite values")]
        PronyTerm { ratio: f64, time: f64 },
        #[error("the ratios of the relaxation add up to {sum:?}: give ratios whose sum is below 1")]
        PronySum { sum: f64 },
    }
}
