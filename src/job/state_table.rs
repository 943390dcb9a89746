//! The table of the states of a run that goes on.

use super::tables::{names, words};
use crate::contact::{Quantity, State, StateRow};
use crate::error::FileError;
use crate::files::Draft;
use crate::setup::{Posed, StateSink};
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

/// The table of the states so far, `NAME.part-XXXXXX.csv` beside the table that is written at the end, see [`Draft`]. A killed run leaves it.
pub struct StateTable {
    table: PathBuf,
    growing: Option<(Draft, File)>,
    columns: Vec<Quantity>,
}

impl StateTable {
    /// The table beside the one that is written at the end.
    pub fn beside(table: impl Into<PathBuf>) -> Self {
        Self { table: table.into(), growing: None, columns: Vec::new() }
    }

    /// Removes it, once the other one is written.
    pub fn discard(self) {
        self.growing.into_iter().for_each(|(draft, _)| draft.discard());
    }

    /// Begins it with the names of its columns.
    fn begin(&mut self, posed: &Posed<'_>, first: &State) -> Result<(), FileError> {
        let known = first.numbers().iter().map(|(quantity, _)| *quantity);
        self.columns = known.chain(posed.drive.columns.iter().copied()).collect();
        self.columns.sort_unstable();
        self.columns.dedup();
        self.growing = Some(Draft::growing(&self.table)?);
        self.write(names(&self.columns))
    }

    /// Writes a row.
    fn write(&mut self, words: Vec<String>) -> Result<(), FileError> {
        let Some((draft, file)) = &mut self.growing else { return Ok(()) };
        let written = writeln!(file, "{}", words.join(","));
        written.map_err(|source| FileError::Write { path: draft.path().into(), source })
    }
}

impl StateSink for StateTable {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if posed.run > 0 {
            return Ok(());
        }
        if self.growing.is_none() {
            self.begin(posed, state)?;
        }
        self.write(words(number, &StateRow::new(state), &self.columns))
    }
}
