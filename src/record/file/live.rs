//! A recording that is read while it is written.

use super::loads::{LoadRecording, Loads};
use super::output::Output;
use super::recording::{Recording, target_error};
use crate::error::FileError;
use crate::record::options::Options;
use crate::record::scene::Scene;
use std::fs::File;
use std::io;
use std::sync::Arc;
use std::time::Duration;

/// Time after which a picture can be read, at the latest.
const FLUSH_INTERVAL: Duration = Duration::from_millis(40);

/// The temporary file behind a recording, which can be read at any time. It has no name where the system allows that, and
/// goes with its last `Live`, or with the process.
#[derive(Clone)]
pub struct Live {
    file: Arc<File>,
    output: Output,
}

impl Recording {
    /// Begins a recording under the name `id` in a temporary file, and returns the means to read it.
    ///
    /// # Errors
    /// [`FileError::Target`] if no temporary file can be made, [`FileError::Write`] if writing to it fails.
    pub fn live(id: &str, scenes: &[Scene<'_>], options: Options) -> Result<(Self, Live), FileError> {
        let live = Live::new()?;
        let mut recording = Self::begin(live.output.clone(), &std::env::temp_dir(), Some(id), scenes, options)?;
        recording.flush_interval = FLUSH_INTERVAL;
        Ok((recording, live))
    }
}

impl LoadRecording {
    /// Begins a recording under the name `id` in a temporary file, and returns the means to read it.
    ///
    /// # Errors
    /// [`FileError::Target`] if no temporary file can be made, [`FileError::Write`] if writing to it fails.
    pub fn live(id: &str, loads: &Loads<'_>, options: Options) -> Result<(Self, Live), FileError> {
        let live = Live::new()?;
        let recording = Self::begin(live.output.clone(), &std::env::temp_dir(), Some(id), loads, options)?;
        Ok((recording, live))
    }
}

impl Live {
    fn new() -> Result<Self, FileError> {
        let error = |failure: io::Error| target_error(&std::env::temp_dir(), &failure);
        let file = tempfile::tempfile().map_err(error)?;
        let output = file.try_clone().and_then(Output::over).map_err(error)?;
        Ok(Self { file: Arc::new(file), output })
    }

    /// Bytes that can be read so far and end with a whole message; none once nothing more will be written.
    pub fn written(&self) -> Option<u64> {
        self.output.written()
    }

    /// At most `most` bytes from the byte `from` on; fewer only at the end of the file.
    ///
    /// # Errors
    /// Errors of the system.
    pub fn read(&self, from: u64, most: u64) -> io::Result<Vec<u8>> {
        self.output.read(&self.file, from, most)
    }
}
