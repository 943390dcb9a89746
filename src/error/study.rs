//! Studies that cannot be solved or merged.

use super::{FileError, HistoryError, SetupError, SolveError};
use crate::quantity::bytes_in_words;
use crate::sentence::worded;
use std::path::PathBuf;

worded! {
    /// A study that cannot be solved or merged.
    #[derive(Debug)]
    pub enum StudyError {
        #[error(transparent)]
        Setup(#[from] SetupError),
        #[error(transparent)]
        Solve(#[from] SolveError),
        #[error(transparent)]
        File(#[from] FileError),
        /// A list of loads, grids or surfaces that is empty or out of order.
        #[error("the {what} are {values}: give at least one value, in ascending order, each once")]
        List { what: &'static str, values: String },
        /// Values in the lists of a study that give an invalid setup.
        #[error("row {row} ({values}): {source}")]
        Row { row: usize, values: String, source: SetupError },
        /// Lists with too many combinations.
        #[error("the lists make {rows} rows, and a study has at most {most}: give fewer values, or several studies")]
        TooManyRows { rows: u128, most: usize },
        /// A tangential load, which studies do not support.
        #[error("a study has no tangential loads: leave the friction out, or solve the setups one by one")]
        Friction,
        /// A history, where contacts under loads are solved.
        #[error("the setup describes a history: follow it, or leave the path out")]
        OneContact,
        /// One contact, where a history is followed.
        #[error("the setup describes no history: give a path, several speeds or rolling")]
        NoHistory,
        /// Several loads of a study of histories.
        #[error("a study of histories goes along a path in each row: give one load, and further ones as path.load")]
        HistoryLoads,
        /// A row number that does not exist.
        #[error("there is no row {number}: give a number from 1 to {rows}")]
        NoRow { number: usize, rows: usize },
        /// A realisation that needs more memory than is allowed.
        #[error(
            "{values} needs {amount} of memory, but the limit is {limit}: raise the limit, or give fewer points",
            amount = bytes_in_words(*needed), limit = bytes_in_words(*memory)
        )]
        Memory { values: String, needed: f64, memory: f64 },
        /// Points of other realisations than those that were to be solved.
        #[error(
            "{points} points of {version} were returned for {values}, but their heights, loads or version differ: \
             install the same version and the same height files on all machines"
        )]
        OtherPoints { values: String, points: usize, version: String },
        /// Rows that are missing in all tables.
        #[error(
            "{rows} of {of} rows are missing in the tables, or were changed after they were solved; the first is row \
             {first}{which}: solve them, or give the missing tables",
            which = in_brackets(values)
        )]
        Missing { rows: usize, first: usize, values: String, of: usize },
        /// A row that was changed after it was solved, which is in no other table.
        #[error("{file} is damaged: row {row} fails its check sum: solve this share again", file = path.display())]
        Damaged { path: PathBuf, row: usize },
        /// A row that is in two tables.
        #[error(
            "row {row}{which} is in {first} and also in {second}: give tables of different shares",
            which = in_brackets(values), first = other.display(), second = path.display()
        )]
        Overlap { row: usize, values: String, path: PathBuf, other: PathBuf },
        /// A table of another study, which would be overwritten.
        #[error(
            "{file} holds {points} rows of another study, or of another version: give another file, or start again to replace it",
            file = path.display()
        )]
        OtherStudy { path: PathBuf, points: usize },
        /// The table of a share of another study, or of this one before it was changed.
        #[error(
            "{file} holds {points} rows of another study, or of another version: solve this share again, or give the study with \
             which the share was solved",
            file = path.display()
        )]
        OtherShare { path: PathBuf, points: usize },
    }
}

/// The values of a row behind its number, if there are any.
fn in_brackets(values: &str) -> String {
    if values.is_empty() { String::new() } else { format!(" ({values})") }
}

impl From<HistoryError> for StudyError {
    fn from(error: HistoryError) -> Self {
        match error {
            HistoryError::Solve(error) => error.into(),
            error => SetupError::from(error).into(),
        }
    }
}
