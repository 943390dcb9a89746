//! The file behind a recording.

use super::pace::FlushPace;
use super::viewer_feed::{LeftOut, ViewerFeed};
use crate::error::{FileError, reason};
use crate::files::{Draft, check_target};
use crate::record::digest::{Digest, RunningDigest, SummedFile};
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
/// The file of a recording that is shown only.
const NOWHERE: &str = if cfg!(windows) { "NUL" } else { "/dev/null" };

/// The file behind a recording, which can be read while it is written.
///
/// It is a [`Draft`] that grows, and has its name at the end. Each message is written at once. After the first failure nothing
/// more is written, and the draft stays. (The file sink of the SDK waits forever if the disk is full.)
#[derive(Clone)]
pub struct Output {
    /// The path of the file until it is complete.
    path: Arc<Path>,
    pace: FlushPace,
    /// The first failure. It has its own lock, so that reading it does not wait for a write.
    failure: Arc<OnceLock<io::Error>>,
    state: Arc<Mutex<OutputState>>,
}

struct OutputState {
    encoder: Encoder<SummedFile>,
    /// The digest of what the encoder has written.
    sum: RunningDigest,
    /// Another handle of the file; all handles share one place in it.
    file: File,
    /// Bytes of whole messages in the file.
    written: u64,
    is_finished: bool,
    /// The name of the file, if it has one, until it is complete.
    draft: Option<Draft>,
    /// The viewer, which also gets each message.
    viewer: Option<Box<dyn LogSink>>,
}

impl Output {
    /// Makes the file that becomes the one at `path`.
    pub(super) fn create(path: &Path) -> Result<Self, FileError> {
        Self::new(Some(path), FlushPace::Filed, None)
    }

    /// A temporary file. It has no name where the system allows that, and goes with its last `Output`, or with the process.
    pub(super) fn temporary() -> Result<Self, FileError> {
        let folder = std::env::temp_dir();
        let file = tempfile::tempfile().map_err(|failure| not_made(&folder, &failure))?;
        Self::begin(&folder, (file, None), FlushPace::LIVE, None)
    }

    /// Makes the file that becomes the one at `path`, if there is one, and shows what it gets in the installed viewer, or in the one that runs,
    /// which misses pictures if it is slow.
    pub(super) fn shown(path: Option<&Path>, left_out: LeftOut) -> Result<Self, FileError> {
        path.map_or(Ok(()), check_target)?;
        Self::seen(path, Box::new(ViewerFeed::new(start_viewer()?, left_out)))
    }

    /// Makes the file that becomes the one at `path`, if there is one; `viewer` gets each message as well.
    pub(super) fn seen(path: Option<&Path>, viewer: Box<dyn LogSink>) -> Result<Self, FileError> {
        Self::new(path, FlushPace::SHOWN, Some(viewer))
    }

    fn new(path: Option<&Path>, pace: FlushPace, viewer: Option<Box<dyn LogSink>>) -> Result<Self, FileError> {
        let Some(path) = path else {
            let nowhere = Path::new(NOWHERE);
            let file = File::create(nowhere).map_err(|failure| not_made(nowhere, &failure))?;
            return Self::begin(nowhere, (file, None), pace, viewer);
        };
        let (draft, file) = Draft::growing(path)?;
        let grown_at = draft.path().to_owned();
        Self::begin(&grown_at, (file, Some(draft)), pace, viewer)
    }

    fn begin(
        path: &Path,
        (file, draft): (File, Option<Draft>),
        pace: FlushPace,
        viewer: Option<Box<dyn LogSink>>,
    ) -> Result<Self, FileError> {
        let begin = || {
            let (version, mut end, sum) = (rerun::build_info().version, file.try_clone()?, RunningDigest::default());
            let file = SummedFile::new(file, sum.clone());
            let encoder = Encoder::new_eager(version, EncodingOptions::PROTOBUF_COMPRESSED, file).map_err(io_error)?;
            let written = end.stream_position()?;
            Ok(OutputState { encoder, sum, file: end, written, is_finished: false, draft, viewer })
        };
        let state = begin().map_err(|failure: io::Error| not_made(path, &failure))?;
        Ok(Self { path: path.into(), pace, failure: Arc::default(), state: Arc::new(Mutex::new(state)) })
    }

    /// Removes the file, if it has a name of its own.
    pub(super) fn discard(&self) {
        if let Some(draft) = self.state().draft.take() {
            draft.discard();
        }
    }

    /// The same file at the pace of states, unless a viewer shows it.
    pub(super) fn for_states(self) -> Self {
        let pace = if let FlushPace::Filed = self.pace { FlushPace::STATES } else { self.pace };
        Self { pace, ..self }
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

    /// The digest of the file so far.
    pub(super) fn digest(&self) -> Digest {
        self.state().sum.now()
    }

    /// Notes a failure, after which no more is written.
    pub(super) fn fail(&self, failure: io::Error) {
        self.failure.set(failure).ok(); // the first one counts
    }

    /// Ends the file with its index, and gives it its final name.
    pub(super) fn finish(&self) -> Result<(), FileError> {
        self.check()?;
        let mut state = self.state();
        state.is_finished = true;
        let ended = state.encoder.finish().map_err(io_error);
        if let Some(viewer) = state.viewer.take() {
            viewer.flush_blocking(VIEWER_TIMEOUT).ok(); // a viewer that was closed is none of the file's business
        }
        let draft = state.draft.take();
        ended.and_then(|()| draft.map_or(Ok(()), Draft::finish)).map_err(|failure| self.error(failure))
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

fn not_made(path: &Path, failure: &io::Error) -> FileError {
    FileError::Target { path: path.into(), reason: reason(failure).to_string() }
}

/// The installed viewer, bound to its port so that what is sent does not wait for it.
fn start_viewer() -> Result<GrpcSink, FileError> {
    let options = SpawnOptions { wait_for_bind: true, ..SpawnOptions::default() };
    let missing = || FileError::NoViewer { version: rerun::build_info().version.to_string() };
    let spawned = rerun::spawn(&options).map_err(|_| missing())?;
    let address = format!("rerun+http://127.0.0.1:{}/proxy", spawned.port);
    address.parse().map(GrpcSink::new).map_err(|_| missing())
}
