//! A file that is read.

use crate::error::FileError;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that is read: its path, or a name and its bytes in memory. As text it is the path or the name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "PathBuf", into = "String")]
pub struct InputFile {
    path: PathBuf,
    /// Its bytes, if it is not on disk.
    bytes: Option<Arc<[u8]>>,
}

impl InputFile {
    /// A file of some name that is not on disk.
    pub fn in_memory(name: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { path: name.into(), bytes: Some(bytes.into()) }
    }

    /// The path, or the name of one in memory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is a file on disk.
    pub fn is_on_disk(&self) -> bool {
        self.bytes.is_none()
    }

    /// Its bytes, if it is not on disk.
    pub(crate) fn kept(&self) -> Option<&[u8]> {
        self.bytes.as_deref()
    }

    /// All bytes of it.
    ///
    /// # Errors
    /// The errors of [`read_bytes`].
    pub fn bytes(&self) -> Result<Cow<'_, [u8]>, FileError> {
        match &self.bytes {
            None => read_bytes(&self.path).map(Cow::Owned),
            Some(bytes) => Ok(Cow::Borrowed(bytes)),
        }
    }

    /// Names it by its full path; one in memory has none, and one whose full path is not text keeps its own.
    pub fn make_absolute(&mut self) {
        match std::path::absolute(&self.path) {
            Ok(full) if self.is_on_disk() && full.to_str().is_some() => self.path = full,
            _ => {}
        }
    }
}

impl From<PathBuf> for InputFile {
    fn from(path: PathBuf) -> Self {
        Self { path, bytes: None }
    }
}

impl From<InputFile> for String {
    fn from(file: InputFile) -> Self {
        file.path.to_string_lossy().into_owned()
    }
}

/// The path of a file as text, such as that of a scene.
///
/// # Errors
/// [`FileError::Read`] for a path that is not UTF-8.
pub fn path_in_text(path: &Path) -> Result<String, FileError> {
    let reason = "its path is not UTF-8, so that no scene can name it: rename the file or its folder";
    let wrong = || FileError::Read { path: path.into(), source: io::Error::new(io::ErrorKind::InvalidData, reason) };
    path.to_str().map(str::to_owned).ok_or_else(wrong)
}

/// Opens a regular file. Others are refused: a device may have no end, and a pipe may never begin.
///
/// # Errors
/// Those of the system, and one of the kind [`io::ErrorKind::InvalidData`] for a directory, a device or a pipe.
pub fn open_regular(path: &Path) -> io::Result<File> {
    match std::fs::metadata(path)?.is_file() {
        true => File::open(path),
        false => {
            let reason = "it is a directory or a device: give a file";
            Err(io::Error::new(io::ErrorKind::InvalidData, reason))
        }
    }
}

/// All bytes of a regular file.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read, and for a directory, a device or a pipe.
///
/// ```
/// let refused = asperity::files::read_bytes(".".as_ref()).unwrap_err();
/// assert_eq!(refused.to_string(), "cannot read .: it is a directory or a device: give a file");
/// ```
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    let read = open_regular(path).and_then(|mut file| file.read_to_end(&mut bytes));
    read.map(|_| bytes).map_err(|source| FileError::Read { path: path.into(), source })
}
