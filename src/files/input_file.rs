//! A file that is read.

use crate::error::FileError;
use crate::memory::check_room;
use crate::quantity::bytes_in_words;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
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

    /// All bytes of a text.
    ///
    /// # Errors
    /// The errors of [`read_text_bytes`].
    pub fn text_bytes(&self) -> Result<Cow<'_, [u8]>, FileError> {
        match &self.bytes {
            None => read_text_bytes(&self.path).map(Cow::Owned),
            Some(bytes) => Ok(Cow::Borrowed(bytes)),
        }
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

/// Bytes at most of a text that is read as a whole: a scene, a study, the setup in a result, a spectrum, an attraction or a path. A table of a million rows
/// fits; read, it needs up to 2 GB.
pub const TEXT_BYTES: u64 = 1 << 25;

/// Bytes for which there is always memory.
const FEW: u64 = 1 << 23;

/// All bytes of a regular file.
///
/// # Errors
/// [`FileError::Read`] for a file that cannot be read or does not fit in memory, and for a directory, a device or a pipe.
///
/// ```
/// let refused = asperity::files::read_bytes(".".as_ref()).unwrap_err();
/// assert_eq!(refused.to_string(), "cannot read .: it is a directory or a device: give a file");
/// ```
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let read = open_regular(path).and_then(|mut file| read_whole(&mut file));
    read.map_err(|source| FileError::Read { path: path.into(), source })
}

/// All bytes of a regular file; none if it is missing.
///
/// # Errors
/// The errors of [`read_bytes`].
pub fn read_if_there(path: &Path) -> Result<Vec<u8>, FileError> {
    match read_bytes(path) {
        Err(FileError::Read { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        read => read,
    }
}

/// All bytes of a regular file that is a text, at most [`TEXT_BYTES`].
///
/// # Errors
/// The errors of [`read_bytes`], and [`FileError::Read`] for a file that is longer.
pub fn read_text_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let read = open_regular(path).and_then(|mut file| {
        check_text(file.metadata()?.len())?;
        let mut bytes = Vec::new();
        file.by_ref().take(TEXT_BYTES + 1).read_to_end(&mut bytes)?;
        check_text(bytes.len() as u64).map(|()| bytes)
    });
    read.map_err(|source| FileError::Read { path: path.into(), source })
}

/// Checks the length of a text in bytes.
///
/// # Errors
/// Of the kind [`io::ErrorKind::InvalidData`] for one of more than [`TEXT_BYTES`].
pub fn check_text(length: u64) -> io::Result<()> {
    if length <= TEXT_BYTES {
        return Ok(());
    }
    let [length, most] = [length, TEXT_BYTES].map(|bytes| bytes_in_words(bytes as f64));
    let reason = format!("it has {length}, and a text may have {most}: give a smaller file");
    Err(io::Error::new(io::ErrorKind::InvalidData, reason))
}

/// All bytes of a source from its beginning on.
///
/// # Errors
/// Those of the source, and one of the kind [`io::ErrorKind::InvalidData`] for one that does not fit in memory.
pub fn read_whole<S: Read + Seek + ?Sized>(source: &mut S) -> io::Result<Vec<u8>> {
    // a file of the system may not know where it ends
    let length = source.seek(SeekFrom::End(0)).unwrap_or(0);
    if length > FEW {
        check_room(length as f64).map_err(|room| {
            let reason = format!("it does not fit in memory, since it needs {room}: give a smaller file");
            io::Error::new(io::ErrorKind::InvalidData, reason)
        })?;
    }
    let mut bytes = Vec::new();
    source.rewind()?;
    source.read_to_end(&mut bytes).map(|_| bytes)
}
