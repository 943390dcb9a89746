//! Studies that cannot be made, or be put together.

use super::{FileError, SetupError, SolveError};
use crate::quantity::bytes_in_words;
use std::path::PathBuf;

/// A study that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error(transparent)]
    Solve(#[from] SolveError),
    #[error(transparent)]
    File(#[from] FileError),
    /// A load that is no pressure, on a surface that has yielded.
    #[error(
        "the {load} is no load of a surface that has yielded under one before: give pressures, or take the hardness away"
    )]
    Unload { load: &'static str },
    /// A list of loads, grids or surfaces that is empty or out of order.
    #[error("the {what} are {values}: give at least one, in ascending order, each once")]
    List { what: &'static str, values: String },
    /// Values in the lists of a study that make no setup.
    #[error("row {row} ({values}): {source}")]
    Row { row: usize, values: String, source: SetupError },
    /// Lists whose product is out of reach.
    #[error("the lists make {rows} rows, and a study has at most {most}: give fewer values, or several studies")]
    TooManyRows { rows: u128, most: usize },
    /// A tangential load, of which the rows of a study say nothing.
    #[error("a study solves normal loads only: leave the friction out, or solve the setups one by one")]
    Friction,
    /// A number that no row has.
    #[error("there is no row {number}: give a number from 1 to {rows}")]
    NoRow { number: usize, rows: usize },
    /// A realisation that needs more memory than it may have.
    #[error(
        "{values} needs {} of memory and may have {}: allow more, or give fewer points",
        bytes_in_words(*needed), bytes_in_words(*memory)
    )]
    Memory { values: String, needed: f64, memory: f64 },
    /// Points of something else than what was to be solved.
    #[error(
        "{points} points of {version} came for {values}, and are of other heights, loads or another version: install the same version and \
         put the same height files everywhere"
    )]
    OtherPoints { values: String, points: usize, version: String },
    /// Rows that no table holds.
    #[error(
        "{rows} of {of} rows are in none of the tables, or were changed there after they were solved; the first is row {first}: solve them, or give the other tables as well"
    )]
    Missing { rows: usize, first: usize, of: usize },
    /// A row that tables hold twice.
    #[error(
        "row {row} is in {} and again in {}: give the tables of shares that have nothing in common", other.display(), path.display()
    )]
    Overlap { row: usize, path: PathBuf, other: PathBuf },
    /// A table that would be lost.
    #[error(
        "{} holds {points} points of other setups, loads or versions: write elsewhere, or start afresh to replace it",
        path.display()
    )]
    OtherStudy { path: PathBuf, points: usize },
    /// The table of a share of another study, or of this one before it was changed.
    #[error(
        "{} holds {points} points of other setups, loads or versions: solve this share again, or give the study as it was when the share was solved",
        path.display()
    )]
    OtherShare { path: PathBuf, points: usize },
}
