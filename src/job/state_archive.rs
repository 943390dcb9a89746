//! The archive of the states of a run that goes on.

use super::posed::Posed;
use super::sink::StateSink;
use crate::contact::{State, archive_of_states};
use crate::error::FileError;
use crate::files::write_beside;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::slice::from_ref;

/// The states so far, each an archive of its own in a folder `NAME.part` beside the archive that is written at the end. A killed run leaves the folder,
/// which is read like the archive.
pub struct StateArchive {
    folder: PathBuf,
}

impl StateArchive {
    /// The folder beside an archive.
    pub fn beside(archive: &Path) -> Self {
        Self { folder: archive.with_extension("part") }
    }

    /// Removes the folder that grew beside an archive.
    pub fn discard(archive: &Path) {
        std::fs::remove_dir_all(archive.with_extension("part")).ok();
    }
}

impl StateSink for StateArchive {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if number == 0 {
            std::fs::remove_dir_all(&self.folder).ok();
            let made = std::fs::create_dir_all(&self.folder);
            made.map_err(|source| FileError::Write { path: self.folder.clone(), source })?;
        }
        let bytes = archive_of_states(from_ref(state), posed.rank(), &posed.text());
        let path = self.folder.join(format!("{:06}.npz", number + 1));
        write_beside(&path, |file| file.write_all(&bytes.map_err(io::Error::other)?))
    }
}
