//! A file of heights, on disk or in memory.

use super::{Layout, Measurement, explained};
use crate::error::FileError;
use crate::files::InputFile;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::path::{Display, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// A file of heights: its path, or a name and its bytes in memory. As text it is the path or the name. The content is
/// cached and shared with clones, so that it is read once.
///
/// ```
/// use asperity::formats::HeightFile;
/// let file = HeightFile::in_memory("ramp.txt", *b"0 1 2 3\n4 5 6 7\n1 1 1 1\n2 2 2 2\n");
/// assert_eq!(file.layout(None)?.shape, [4, 4]);
/// assert_eq!(file.measurement(None)?.height[[1, 0]], 4.0);
/// # Ok::<(), asperity::error::FileError>(())
/// ```
#[derive(Clone, Serialize, Deserialize)]
#[serde(from = "PathBuf", into = "String")]
pub struct HeightFile {
    file: InputFile,
    kept: Arc<Mutex<Kept>>,
}

/// The content of a file: that of the last requested channel.
#[derive(Default)]
struct Kept {
    layout: Option<(Option<String>, Layout)>,
    measurement: Option<(Option<String>, Measurement)>,
}

impl PartialEq for HeightFile {
    fn eq(&self, other: &Self) -> bool {
        self.file == other.file
    }
}

impl HeightFile {
    /// A file of some name that is not on disk.
    pub fn in_memory(name: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { file: InputFile::in_memory(name, bytes), kept: Arc::default() }
    }

    /// The path, or the name of one in memory.
    pub fn path(&self) -> &Path {
        self.file.path()
    }

    /// The file as any other that a setup names.
    pub(crate) fn file_mut(&mut self) -> &mut InputFile {
        &mut self.file
    }

    /// The path or the name, as text.
    pub fn display(&self) -> Display<'_> {
        self.path().display()
    }

    /// Reads it, see [`Measurement::read`].
    ///
    /// # Errors
    /// The errors of [`Measurement::read`].
    pub fn measurement(&self, channel: Option<&str>) -> Result<Measurement, FileError> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, measurement)) = kept.measurement.as_ref().filter(|it| it.0.as_deref() == channel) {
            return Ok(measurement.clone());
        }
        let measurement = match self.file.kept() {
            None => Measurement::read(self.path(), channel)?,
            Some(bytes) => {
                Measurement::from_bytes(bytes, channel).map_err(|error| explained(self.path(), "height", error))?
            }
        };
        kept.layout = Some((channel.map(str::to_owned), measurement.layout()));
        kept.measurement = Some((channel.map(str::to_owned), measurement.clone()));
        Ok(measurement)
    }

    /// Shape and spacing of what is in it, see [`Measurement::read_layout`].
    ///
    /// # Errors
    /// The errors of [`Measurement::read`].
    pub fn layout(&self, channel: Option<&str>) -> Result<Layout, FileError> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, layout)) = kept.layout.as_ref().filter(|it| it.0.as_deref() == channel) {
            return Ok(layout.clone());
        }
        let layout = match self.file.kept() {
            None => Measurement::read_layout(self.path(), channel)?,
            Some(bytes) => {
                Measurement::layout_of(bytes, channel).map_err(|error| explained(self.path(), "height", error))?
            }
        };
        kept.layout = Some((channel.map(str::to_owned), layout.clone()));
        Ok(layout)
    }

    /// All bytes of it.
    ///
    /// # Errors
    /// [`FileError::Read`].
    pub fn bytes(&self) -> Result<Cow<'_, [u8]>, FileError> {
        self.file.bytes()
    }
}

impl From<PathBuf> for HeightFile {
    fn from(path: PathBuf) -> Self {
        Self { file: path.into(), kept: Arc::default() }
    }
}

impl From<HeightFile> for String {
    fn from(file: HeightFile) -> Self {
        file.file.into()
    }
}

impl fmt::Debug for HeightFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.path().fmt(f)
    }
}
