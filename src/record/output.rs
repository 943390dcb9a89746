//! The file behind a recording.

use rerun::external::re_log_encoding::{EncodeError, Encoder, EncodingOptions};
use rerun::log::LogMsg;
use rerun::sink::{LogSink, SinkFlushError};
use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A sink that writes each message to the file at once and remembers the first failure, after which it writes no more. (The
/// SDK's own file sink waits for ever when the disk is full.)
#[derive(Clone)]
pub struct Output(Arc<Mutex<State>>);

struct State {
    encoder: Encoder<File>,
    failure: Option<io::Error>,
}

impl Output {
    /// Makes the file, or empties it.
    pub fn create(path: &Path) -> io::Result<Self> {
        let version = rerun::build_info().version;
        let encoder = Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, File::create(path)?);
        let state = State { encoder: encoder.map_err(io_error)?, failure: None };
        Ok(Self(Arc::new(Mutex::new(state))))
    }

    /// The first failure so far.
    pub fn check(&self) -> io::Result<()> {
        let failure = &self.state().failure;
        failure.as_ref().map_or(Ok(()), |failure| Err(io::Error::new(failure.kind(), failure.to_string())))
    }

    /// Ends the file with its index.
    pub fn finish(&self) -> io::Result<()> {
        self.check()?;
        self.state().encoder.finish().map_err(io_error)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl LogSink for Output {
    fn send(&self, message: LogMsg) {
        let mut state = self.state();
        if state.failure.is_none() {
            state.failure = state.encoder.append(&message).err().map(io_error);
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
