//! The file behind a recording.

use rerun::external::re_log_encoding::{EncodeError, Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};
use std::fs::File;
#[cfg(feature = "explore")]
use std::io::Read;
use std::io::{self, Seek};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time by which a viewer that does not answer may hold up the end of a recording.
const VIEWER_TIMEOUT: Duration = Duration::from_secs(5);

/// A sink that writes each message to the file at once and remembers the first failure, after which it writes no more. (The
/// SDK's own file sink waits for ever when the disk is full.)
#[derive(Clone)]
pub struct Output(Arc<Mutex<State>>);

struct State {
    encoder: Encoder<File>,
    /// Bytes of whole messages in the file.
    written: u64,
    is_finished: bool,
    failure: Option<io::Error>,
    /// A viewer that gets each message as well.
    viewer: Option<Box<dyn LogSink>>,
}

impl Output {
    /// Makes the file, or empties it.
    pub fn create(path: &Path) -> io::Result<Self> {
        Self::over(File::create(path)?)
    }

    /// Writes to an empty file.
    pub fn over(file: File) -> io::Result<Self> {
        let version = rerun::build_info().version;
        let mut end = file.try_clone()?;
        let encoder = Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, file).map_err(io_error)?;
        let written = end.stream_position()?;
        let state = State { encoder, written, is_finished: false, failure: None, viewer: None };
        Ok(Self(Arc::new(Mutex::new(state))))
    }

    /// Sends each further message to `viewer` as well.
    pub fn show(&self, viewer: Box<dyn LogSink>) {
        self.state().viewer = Some(viewer);
    }

    /// Bytes of whole messages so far; none once nothing more will be written.
    #[cfg(feature = "explore")]
    pub fn written(&self) -> Option<u64> {
        let state = self.state();
        (!state.is_finished && state.failure.is_none()).then_some(state.written)
    }

    /// The first failure so far.
    pub fn check(&self) -> io::Result<()> {
        let failure = &self.state().failure;
        failure.as_ref().map_or(Ok(()), |failure| Err(io::Error::new(failure.kind(), failure.to_string())))
    }

    /// Ends the file with its index.
    pub fn finish(&self) -> io::Result<()> {
        self.check()?;
        let mut state = self.state();
        state.is_finished = true;
        let ended = state.encoder.finish().map_err(io_error);
        if let Some(viewer) = state.viewer.take() {
            viewer.flush_blocking(VIEWER_TIMEOUT).ok(); // a viewer that was closed is none of the file's business
        }
        ended
    }

    /// At most `most` bytes of `file`, a handle of the file that is written to, from the byte `from` on.
    #[cfg(feature = "explore")]
    pub fn read(&self, mut file: &File, from: u64, most: u64) -> io::Result<Vec<u8>> {
        let _waiting = self.state(); // all handles share one place in the file
        let mut piece = Vec::new();
        file.seek(io::SeekFrom::Start(from))?;
        let read = io::Read::take(file, most).read_to_end(&mut piece);
        file.seek(io::SeekFrom::End(0))?;
        read.map(|_| piece)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl LogSink for Output {
    fn send(&self, message: LogMsg) {
        let mut state = self.state();
        if state.failure.is_none() {
            match state.encoder.append(&message) {
                Ok(bytes) => state.written += bytes,
                Err(failure) => state.failure = Some(io_error(failure)),
            }
        }
        if let Some(viewer) = &state.viewer {
            viewer.send(message);
        }
    }

    fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
        self.check().map_err(|failure| SinkFlushError::Failed { message: failure.to_string() })
    }
}

fn io_error(failure: EncodeError) -> io::Error {
    match failure {
        EncodeError::Write(failure) => failure,
        other => io::Error::other(other),
    }
}
