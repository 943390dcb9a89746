//! Setups that cannot be.

use super::{
    AdhesionError, Conflict, ConflictRule, CreepError, FileError, FlowError, GridError, HistoryError, PreparationError,
    ProblemError, SettingError, SlipError, SolidError, SolveError, SurfaceError, TextFault, TextPlace,
};
use crate::memory::free_in_words;
use crate::quantity::{bytes_in_words, grouped};
use crate::sentence::{Sentence, sentence, shortened, worded};
use std::path::PathBuf;

worded! {
    /// A setup that cannot be read, or that describes nothing that can be solved.
    #[derive(Debug)]
    pub enum SetupError {
        #[error(transparent)]
        Grid(#[from] GridError),
        #[error(transparent)]
        Surface(#[from] SurfaceError),
        #[error(transparent)]
        Preparation(#[from] PreparationError),
        #[error(transparent)]
        Solid(#[from] SolidError),
        #[error(transparent)]
        Problem(#[from] ProblemError),
        #[error(transparent)]
        Slip(#[from] SlipError),
        #[error(transparent)]
        History(#[from] HistoryError),
        #[error(transparent)]
        Creep(#[from] CreepError),
        /// What does not go together, or is missing.
        #[error(transparent)]
        Conflict(#[from] Conflict),
        /// A table that was read from a file and cannot be a path or an attraction.
        #[error("{file}: {words}", file = path.display(), words = shortened(reason))]
        Table { path: PathBuf, reason: String },
        #[error(transparent)]
        Attraction(#[from] AdhesionError),
        #[error(transparent)]
        Flow(#[from] FlowError),
        #[error(transparent)]
        Setting(#[from] SettingError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        #[error(transparent)]
        File(#[from] FileError),
        /// A unit for one quantity and none for another of its kind.
        #[error("{without} has no unit, but {with} has one: give a unit for every {kind}, or for none")]
        MixedUnits {
            /// `pressure`, `length`, `force`, `energy per area`, `time`, `speed` or `load of a path`.
            kind: &'static str,
            /// The quantity without a unit, and its value.
            without: String,
            /// The quantity with a unit, and its value.
            with: String,
        },
        /// A number alone as the force, beside a quantity with a unit.
        #[error("the force {force} has no unit, but {with} has one: give it with a unit, such as {example}")]
        ForceWithoutUnit {
            force: String,
            /// The quantity with a unit, and its value.
            with: String,
            /// The same force with a unit.
            example: String,
        },
        /// A force per length on a surface, or a force that is not per length on a line.
        #[error("the force {force} {kind}: did you mean {meant}?", kind = if *is_line { "is not per length, as that on a line is" } else { "is per length, as that on a line is, but this is a surface" })]
        ForceUnit { force: String, meant: String, is_line: bool },
        /// A mean pressure without a modulus.
        #[error(
            "the {load} {value:?} is given without a modulus: give the contact modulus, or Young's modulus and Poisson's ratio of one body or of both"
        )]
        NoModulus { load: &'static str, value: f64 },
        /// A quantity with a unit that is compared with a modulus, where no modulus is given.
        #[error(
            "{given} has a unit, but no modulus is given that it is compared with: give the contact modulus, or Young's modulus and Poisson's ratio \
             of one body or of both; or give a number alone, which is taken over the contact modulus"
        )]
        UnitWithoutModulus {
            /// The quantity and its value.
            given: String,
        },
        /// Bodies of which one conducts electricity and the other one heat.
        #[error("{electrical} is electrical and {thermal} is thermal: give both bodies of one kind")]
        ElectricalAndThermal { electrical: String, thermal: String },
        /// A second file of heights that does not fit the first.
        #[error(
            "the heights in {file} have the shape {found:?} and those of the other body {expected:?}: give arrays of the \
             same shape", file = path.display()
        )]
        Against { path: PathBuf, found: Vec<usize>, expected: Vec<usize> },
        /// Boundaries that fit no axes.
        #[error("{boundaries} boundaries are given for {axes} axes: give one for all of them, or one for each")]
        Boundaries { boundaries: usize, axes: usize },
        /// A datum that is shorter than the cell.
        #[error(
            "the datum distance {datum:?} is too short: give at least the length of the cell along a free axis, {length:?}"
        )]
        Datum { datum: f64, length: f64 },
        /// A unit for a file that has its own.
        #[error("the file has units, so leave the unit {unit:?} out")]
        UnitOfFile { unit: f64 },
        /// Positions that are not evenly spaced.
        #[error("the positions in {file} are not evenly spaced: resample the heights to even spacing", file = path.display())]
        Uneven { path: PathBuf },
        /// Heights that are void.
        #[error("{voids} of {points} heights in {file} are void: fill them, or crop the heights", file = path.display())]
        Voids { path: PathBuf, voids: usize, points: usize },
        /// A seed that a scene in TOML cannot hold.
        #[error("the seed {seed} is too large: give at most {most}", most = i64::MAX)]
        Seed { seed: u64 },
        /// Lengths of the cell that do not fit the axes.
        #[error("the size of the cell has {sizes} lengths for {axes} axes: give one for all axes, or one for each")]
        Sizes { sizes: usize, axes: usize },
        /// An array that is neither a line nor a surface.
        #[error("the grid has {axes} axes: give one for a line, two for a surface")]
        Axes { axes: usize },
        /// A part of a recording that the grid does not have.
        #[error("the recording part {part} does not exist for a {of}: leave it out")]
        NoSuchPart { part: &'static str, of: &'static str },
        /// A row or a column that a surface does not have.
        #[error(
            "there is no row {row} and column {column} for the raster in {ny} x {nx} nodes: give a row and a column of a \
             surface, counted from 0",
            ny = shape[0], nx = shape[1]
        )]
        NoSuchNode { row: usize, column: usize, shape: [usize; 2] },
        /// A text that is not a setup.
        #[error("{words}", words = shortened(&format!("{place}{fault}")))]
        Text { place: TextPlace, fault: Box<TextFault> },
        /// A solve that needs more memory than is free, or than the system allows.
        #[error("{words}", words = memory_in_words(*shape, *states, what, *needed, *free))]
        Memory {
            /// Rows and columns of the grid.
            shape: [usize; 2],
            /// States of a history, if they need most of it; or else 0.
            states: usize,
            /// What needs it.
            what: String,
            /// Bytes.
            needed: f64,
            /// Bytes that are free, if the system reports them and they are too few.
            free: Option<f64>,
        },
    }
}

impl SetupError {
    /// A text that is not a setup: what is wrong with the value at some keys, which may be empty.
    pub(crate) fn text(keys: &str, reason: impl Into<String>) -> Self {
        Self::Text {
            place: TextPlace::keys(keys),
            fault: TextFault::Other { reason: reason.into(), flags: Vec::new() }.into(),
        }
    }
}

impl From<ConflictRule> for SetupError {
    fn from(rule: ConflictRule) -> Self {
        Self::Conflict(rule.into())
    }
}

/// The sentence about memory that is missing.
fn memory_in_words([ny, nx]: [usize; 2], states: usize, what: &str, needed: f64, free: Option<f64>) -> Sentence {
    let needed = bytes_in_words(needed);
    let free = free_in_words(free);
    let points = if ny == 1 { nx.to_string() } else { format!("{ny} x {nx}") };
    match states {
        0 => sentence!(
            "a grid of {ny} x {nx} points does not fit in memory: {what} needs at least {needed}, {free}: give fewer points",
            ny,
            nx,
            what,
            needed,
            free,
        ),
        states => {
            let states = grouped(states);
            sentence!(
                "{states} states of {points} points need {needed}, {free}: give fewer steps",
                states,
                points,
                needed,
                free
            )
        }
    }
}
