//! The file behind a recording.

use super::pace::FlushPace;
use crate::error::{FileError, reason};
use crate::files::check_target;
use rerun::SpawnOptions;
use rerun::external::re_log_encoding::{EncodeError, Encoder, EncodingOptions};
use rerun::log::{ChunkBatcherConfig, LogMsg};
use rerun::sink::{GrpcSink, LogSink, SinkFlushError};
use std::fs::File;
use std::io::{self, Read, Seek};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

/// Longest time to wait for a viewer that does not answer at the end of a recording.
const VIEWER_TIMEOUT: Duration = Duration::from_secs(5);
/// Ending of the name of an unfinished recording, if an older recording has its final name.
const PART: &str = "part.rrd";
/// The file of a recording that is shown only.
const NOWHERE: &str = if cfg!(windows) { "NUL" } else { "/dev/null" };

/// The file behind a recording, which can be read while it is written.
///
/// If an older file has its name, the new file is written beside it, and replaces it at the end. Each message is
/// written at once. After the first failure nothing more is written. (The file sink of the SDK waits forever if the
/// disk is full.)
#[derive(Clone)]
pub struct Output {
    path: Arc<Path>,
    /// The path of the file until it is complete.
    grown_at: Arc<Path>,
    pace: FlushPace,
    /// The first failure. It has its own lock, so that reading it does not wait for a write.
    failure: Arc<OnceLock<io::Error>>,
    state: Arc<Mutex<OutputState>>,
}

struct OutputState {
    encoder: Encoder<File>,
    /// Another handle of the file; all handles share one place in it.
    file: File,
    /// Bytes of whole messages in the file.
    written: u64,
    is_finished: bool,
    /// The viewer, which also gets each message.
    viewer: Option<Box<dyn LogSink>>,
}

impl Output {
    /// Makes the file at `path`, or beside an older one there.
    pub(super) fn create(path: &Path) -> Result<Self, FileError> {
        check_target(path)?;
        Self::named(path, FlushPace::Filed, None)
    }

    /// A temporary file. It has no name where the system allows that, and goes with its last `Output`, or with the process.
    pub(super) fn temporary() -> Result<Self, FileError> {
        Self::new(&std::env::temp_dir(), tempfile::tempfile(), FlushPace::LIVE, None)
    }

    /// Makes the file at `path`, if there is one, and shows what it gets in the installed viewer, or in the one that runs.
    pub(super) fn shown(path: Option<&Path>) -> Result<Self, FileError> {
        path.map_or(Ok(()), check_target)?;
        Self::seen(path, Box::new(start_viewer()?))
    }

    /// Makes the file at `path`, if there is one; `viewer` gets each message as well.
    pub(super) fn seen(path: Option<&Path>, viewer: Box<dyn LogSink>) -> Result<Self, FileError> {
        path.map_or(Ok(()), check_target)?;
        Self::named(path.unwrap_or(Path::new(NOWHERE)), FlushPace::SHOWN, Some(viewer))
    }

    fn named(path: &Path, pace: FlushPace, viewer: Option<Box<dyn LogSink>>) -> Result<Self, FileError> {
        let is_taken = path.metadata().is_ok_and(|file| file.is_file() && file.len() > 0);
        let grown_at = if is_taken { path.with_extension(PART) } else { path.to_owned() };
        let output = Self::new(path, File::create(&grown_at), pace, viewer)?;
        Ok(Self { grown_at: grown_at.into(), ..output })
    }

    fn new(
        path: &Path,
        file: io::Result<File>,
        pace: FlushPace,
        viewer: Option<Box<dyn LogSink>>,
    ) -> Result<Self, FileError> {
        let begin = |file: File| {
            let (version, mut end) = (rerun::build_info().version, file.try_clone()?);
            let encoder = Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, file).map_err(io_error)?;
            let written = end.stream_position()?;
            Ok(OutputState { encoder, file: end, written, is_finished: false, viewer })
        };
        let error = |failure: io::Error| FileError::Target { path: path.into(), reason: reason(&failure) };
        let state = file.and_then(begin).map_err(error)?;
        Ok(Self {
            path: path.into(),
            grown_at: path.into(),
            pace,
            failure: Arc::default(),
            state: Arc::new(Mutex::new(state)),
        })
    }

    /// Removes the file, if it has a name of its own.
    pub(super) fn discard(&self) {
        if self.grown_at.is_file() {
            std::fs::remove_file(&self.grown_at).ok();
        }
    }

    /// When waiting steps are written.
    pub(super) fn pace(&self) -> FlushPace {
        self.pace
    }

    /// Bytes that can be read so far and end with a whole message; none once nothing more will be written.
    pub fn written(&self) -> Option<u64> {
        let state = self.state();
        (!state.is_finished && self.failure.get().is_none()).then_some(state.written)
    }

    /// At most `most` bytes from the byte `from` on; fewer only at the end of the file.
    ///
    /// # Errors
    /// Errors of the system.
    pub fn read(&self, from: u64, most: u64) -> io::Result<Vec<u8>> {
        let file = &mut self.state().file;
        let mut piece = Vec::new();
        file.seek(io::SeekFrom::Start(from))?;
        let read = file.by_ref().take(most).read_to_end(&mut piece);
        file.seek(io::SeekFrom::End(0))?;
        read.map(|_| piece)
    }

    /// The first failure so far.
    pub(super) fn check(&self) -> Result<(), FileError> {
        let copy = |failure: &io::Error| self.error(io::Error::new(failure.kind(), failure.to_string()));
        self.failure.get().map(copy).map_or(Ok(()), Err)
    }

    /// Notes a failure, after which no more is written.
    pub(super) fn fail(&self, failure: io::Error) {
        self.failure.set(failure).ok(); // the first one counts
    }

    /// Ends the file with its index, and gives it the name of an older one.
    pub(super) fn finish(&self) -> Result<(), FileError> {
        self.check()?;
        let mut state = self.state();
        state.is_finished = true;
        let ended = state.encoder.finish().map_err(io_error);
        if let Some(viewer) = state.viewer.take() {
            viewer.flush_blocking(VIEWER_TIMEOUT).ok(); // a viewer that was closed is none of the file's business
        }
        let named = || if self.grown_at == self.path { Ok(()) } else { std::fs::rename(&self.grown_at, &self.path) };
        ended.and_then(|()| named()).map_err(|failure| self.error(failure))
    }

    /// The error of a file that could not be written.
    pub(super) fn error(&self, source: io::Error) -> FileError {
        FileError::Write { path: self.path.to_path_buf(), source }
    }

    fn state(&self) -> MutexGuard<'_, OutputState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl LogSink for Output {
    fn send(&self, message: LogMsg) {
        let mut state = self.state();
        if self.failure.get().is_none() {
            match state.encoder.append(&message) {
                Ok(bytes) => state.written += bytes,
                Err(failure) => self.fail(io_error(failure)),
            }
        }
        if let Some(viewer) = &state.viewer {
            viewer.send(message);
        }
    }

    fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
        self.check().map_err(|failure| SinkFlushError::Failed { message: failure.to_string() })
    }

    fn default_batcher_config(&self) -> ChunkBatcherConfig {
        ChunkBatcherConfig { flush_tick: self.pace.tick(), ..ChunkBatcherConfig::DEFAULT }
    }
}

pub(super) fn io_error(failure: EncodeError) -> io::Error {
    match failure {
        EncodeError::Write(failure) => failure,
        other => io::Error::other(other),
    }
}

/// The installed viewer, bound to its port so that what is sent does not wait for it.
fn start_viewer() -> Result<GrpcSink, FileError> {
    let options = SpawnOptions { wait_for_bind: true, ..SpawnOptions::default() };
    let missing = || FileError::NoViewer { version: rerun::build_info().version.to_string() };
    let spawned = rerun::spawn(&options).map_err(|_| missing())?;
    let address = format!("rerun+http://127.0.0.1:{}/proxy", spawned.port);
    address.parse().map(GrpcSink::new).map_err(|_| missing())
}
