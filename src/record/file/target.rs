//! Where a recording goes.

use super::output::Output;
use super::pieces::Pieces;
use super::viewer_feed::LeftOut;
use crate::error::FileError;
use std::path::{Path, PathBuf};

/// Where a recording goes.
pub enum Target<'a> {
    /// Into a file, which grows as a [`Draft`](crate::files::Draft) until it is whole.
    File(PathBuf),
    /// Into the installed viewer, or the one that runs, and into a file, if there is one. The solver does not wait for the viewer: pictures that it is
    /// too slow to get are left out there and counted. Numbers are not left out, and the file has everything.
    Viewer(Option<PathBuf>, LeftOut),
    /// To others, who take it in pieces as it grows, and into a file, if there is one.
    Pieces(Pieces, Option<PathBuf>),
    /// Into a temporary file under a name. The function gets the means to read it when the recording begins.
    Temporary(String, Box<dyn FnOnce(Output) + 'a>),
    /// Opened before, with the name of the recording, if it has one.
    Opened(Output, Option<String>),
}

impl Target<'_> {
    /// The file, if there is one with a name.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Viewer(path, _) | Self::Pieces(_, path) => path.as_deref(),
            Self::Temporary(..) | Self::Opened(..) => None,
        }
    }

    /// The target, opened: what cannot be written or shown is known from now on.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made, and [`FileError::NoViewer`] where there is no viewer.
    pub fn opened(self) -> Result<Self, FileError> {
        let (output, id) = self.open()?;
        Ok(Self::Opened(output, id))
    }

    /// Removes the file that was opened and got nothing.
    pub fn discard(self) {
        if let Self::Opened(output, _) = self {
            output.discard();
        }
    }

    /// Opens it, and returns the name of the recording, if it has one.
    pub(super) fn open(self) -> Result<(Output, Option<String>), FileError> {
        Ok(match self {
            Self::File(path) => (Output::create(&path)?, None),
            Self::Viewer(path, left_out) => (Output::shown(path.as_deref(), left_out)?, None),
            Self::Pieces(pieces, path) => (Output::seen(path.as_deref(), Box::new(pieces))?, None),
            Self::Temporary(name, begun) => {
                let output = Output::temporary()?;
                begun(output.clone());
                (output, Some(name))
            }
            Self::Opened(output, id) => (output, id),
        })
    }
}
