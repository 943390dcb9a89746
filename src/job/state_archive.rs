//! The archive of the states of a run that goes on.

use super::posed::Posed;
use super::sink::StateSink;
use crate::contact::{State, archive_of_part};
use crate::error::FileError;
use crate::files::write_beside;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The states so far, each an archive of its own in a folder `NAME.part` beside the archive that is written at the end. A killed run leaves the folder,
/// which is read like the archive.
pub struct StateArchive {
    folder: PathBuf,
    /// The text of the setup of the run, after its first state.
    setup: String,
    /// The number of axes of its arrays.
    rank: usize,
}

impl StateArchive {
    /// The folder beside an archive.
    pub fn beside(archive: &Path) -> Self {
        Self { folder: Self::folder(archive), setup: String::new(), rank: 0 }
    }

    /// The folder that grows beside an archive.
    pub fn folder(archive: &Path) -> PathBuf {
        archive.with_extension("part")
    }

    /// Removes the archives of states beside an archive, and their folder if there is nothing else in it.
    pub fn discard(archive: &Path) {
        let folder = Self::folder(archive);
        let mut numbers = 1..;
        while numbers.next().is_some_and(|number| std::fs::remove_file(part(&folder, number)).is_ok()) {}
        std::fs::remove_dir(folder).ok();
    }
}

impl StateSink for StateArchive {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if posed.run > 0 {
            return Ok(());
        }
        if number == 0 {
            let made = std::fs::create_dir(&self.folder);
            made.map_err(|source| FileError::Write { path: self.folder.clone(), source })?;
            (self.setup, self.rank) = (posed.text(), posed.rank());
        }
        let bytes = archive_of_part(state, self.rank, &self.setup);
        let path = part(&self.folder, number + 1);
        write_beside(&path, |file| file.write_all(&bytes.map_err(io::Error::other)?))
    }
}

/// The archive of a state by its number, from 1.
fn part(folder: &Path, number: usize) -> PathBuf {
    folder.join(format!("{number:06}.npz"))
}
