//! The table of the states of a run that goes on.

use super::posed::Posed;
use super::sink::StateSink;
use super::tables::cell;
use crate::contact::{Quantity, State};
use crate::error::FileError;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The table of the states so far, `NAME.part.csv` beside the table that is written at the end. A killed run leaves it.
pub struct StateTable {
    path: PathBuf,
    file: Option<File>,
    columns: Vec<Quantity>,
}

impl StateTable {
    /// The table beside the one that is written at the end.
    pub fn beside(table: &Path) -> Self {
        Self { path: Self::part(table), file: None, columns: Vec::new() }
    }

    /// The table that grows beside another one.
    pub fn part(table: &Path) -> PathBuf {
        table.with_extension("part.csv")
    }

    /// Removes the table that grew beside another one.
    pub fn discard(table: &Path) {
        std::fs::remove_file(Self::part(table)).ok();
    }

    fn write(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> std::io::Result<()> {
        if self.file.is_none() {
            let known = state.numbers().iter().map(|(quantity, _)| *quantity);
            self.columns = known.chain(posed.kind.row().columns.iter().copied()).collect();
            self.columns.sort_unstable();
            self.columns.dedup();
            let mut file = OpenOptions::new().create(true).write(true).truncate(true).open(&self.path)?;
            let names = ["state", "status", "claim"].into_iter().chain(self.columns.iter().map(|it| it.name()));
            writeln!(file, "{}", names.collect::<Vec<_>>().join(","))?;
            self.file = Some(file);
        }
        let Some(file) = &mut self.file else { return Ok(()) };
        let values = self.columns.iter().map(|it| cell(*it, state));
        let claim = <&str>::from(state.claim).to_owned();
        let first = [(number + 1).to_string(), state.contact.status.name().to_owned(), claim];
        writeln!(file, "{}", first.into_iter().chain(values).collect::<Vec<_>>().join(","))
    }
}

impl StateSink for StateTable {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if posed.run > 0 {
            return Ok(());
        }
        let written = self.write(posed, number, state);
        written.map_err(|source| FileError::Write { path: self.path.clone(), source })
    }
}
