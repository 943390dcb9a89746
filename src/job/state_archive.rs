//! The archive of the states of a run that goes on.

use crate::contact::{State, archive_of_part};
use crate::error::FileError;
use crate::files::{Draft, write_beside};
use crate::setup::{Posed, StateSink};
use std::io::{self, Write};
use std::path::PathBuf;

/// The states so far, each an archive of its own in a folder `NAME.part-XXXXXX` beside the archive that is written at the end, see [`Draft`]. A killed
/// run leaves the folder, which is read like the archive.
pub struct StateArchive {
    archive: PathBuf,
    folder: Option<Draft>,
    /// The text of the setup of the run, after its first state.
    setup: String,
    /// The number of axes of its arrays.
    rank: usize,
}

impl StateArchive {
    /// The folder beside an archive.
    pub fn beside(archive: impl Into<PathBuf>) -> Self {
        Self { archive: archive.into(), folder: None, setup: String::new(), rank: 0 }
    }

    /// Removes the folder, once the archive is written.
    pub fn discard(self) {
        self.folder.into_iter().for_each(Draft::discard);
    }
}

impl StateSink for StateArchive {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        if posed.run > 0 {
            return Ok(());
        }
        let folder = match &mut self.folder {
            Some(folder) => folder,
            none => {
                (self.setup, self.rank) = (posed.text(), posed.rank());
                none.insert(Draft::growing_folder(&self.archive)?)
            }
        };
        let path = folder.path().join(format!("{:06}.npz", number + 1));
        let bytes = archive_of_part(state, self.rank, &self.setup);
        write_beside(&path, |file| file.write_all(&bytes.map_err(io::Error::other)?))
    }
}
