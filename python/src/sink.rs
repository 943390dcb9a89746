//! Where a recording goes.

use crate::detached::Detached;
use crate::error::bail;
use crate::output::check_output;
use crate::warn::warn_sentence;
use asperity::record::{LeftOut, Pieces, Target};
use asperity::setup;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The shortest time between two pieces of a stream: smaller pieces are put together.
const PIECE_INTERVAL: Duration = Duration::from_millis(50);

/// Why keywords of a recording alone are refused.
pub const NOTHING_RECORDED: &str = "recording says what is recorded, but nothing is recorded: give a file (record), live or stream as well, or leave it out";

/// Where a recording goes: to a file, to the installed viewer, in pieces to a callable, or nowhere.
#[derive(Default)]
pub struct RecordingSink {
    pub path: Option<PathBuf>,
    pub is_live: bool,
    stream: Option<Stream>,
    /// What the viewer missed.
    left_out: LeftOut,
}

/// A callable that takes a recording in pieces.
struct Stream {
    pieces: Pieces,
    state: Mutex<SinkState>,
}

struct SinkState {
    /// The callable, until it raises an exception.
    callable: Option<Py<PyAny>>,
    last_piece: Instant,
}

impl RecordingSink {
    /// The sink that writes a file, if there is a path, and shows the recording in the installed viewer, if it is live.
    pub fn new(path: Option<PathBuf>, is_live: bool) -> Self {
        Self { path, is_live, ..Self::default() }
    }

    /// Whether a callable takes the recording.
    pub fn is_streamed(&self) -> bool {
        self.stream.is_some()
    }

    /// Adds a callable that takes the recording as bytes.
    pub fn stream_to(&mut self, callable: &Bound<'_, PyAny>) -> PyResult<()> {
        if !callable.is_callable() {
            return Err(PyTypeError::new_err(format!(
                "stream must be a callable that takes bytes, not {}",
                callable.get_type().name()?
            )));
        }
        let state = SinkState { callable: Some(callable.clone().unbind()), last_piece: Instant::now() };
        self.stream = Some(Stream { pieces: Pieces::default(), state: Mutex::new(state) });
        Ok(())
    }

    /// Refuses a wrong file name, a file that the setup reads, and a stream beside the viewer.
    pub fn check(&self, setup: &setup::Setup) -> PyResult<()> {
        if self.is_live && self.stream.is_some() {
            return bail("a recording is shown in the installed viewer or streamed: give live or stream, not both");
        }
        self.path.as_deref().map_or(Ok(()), |path| check_output(path, &["rrd"], setup))
    }

    /// Whether anything is recorded.
    pub fn is_active(&self) -> bool {
        self.path.is_some() || self.is_live || self.stream.is_some()
    }

    /// Where the recording goes, if anything is recorded.
    pub fn target(&self) -> Option<Target<'static>> {
        let path = self.path.clone();
        match &self.stream {
            Some(stream) => Some(Target::Pieces(stream.pieces.clone(), path)),
            None if self.is_live => Some(Target::Viewer(path, self.left_out.clone())),
            None => path.map(Target::File),
        }
    }

    /// Passes on what was recorded since the last piece, unless that was just now.
    pub fn flush(&self, py: Python<'_>) -> PyResult<()> {
        match &self.stream {
            Some(stream) if stream.state().last_piece.elapsed() >= PIECE_INTERVAL => stream.flush(py),
            _ => Ok(()),
        }
    }

    /// Passes on the rest of the recording, and says what a viewer missed.
    pub fn finish(&self, py: Python<'_>) -> PyResult<()> {
        self.stream.as_ref().map_or(Ok(()), |stream| stream.flush(py))?;
        self.left_out.warning("recording={\"every\": N}").map_or(Ok(()), |warning| warn_sentence(py, &warning))
    }
}

impl Stream {
    fn flush(&self, py: Python<'_>) -> PyResult<()> {
        let Some(callable) = self.state().callable.as_ref().map(|it| it.clone_ref(py)) else { return Ok(()) };
        let piece = py.try_detached(|| self.pieces.next_piece())?;
        let sent = piece.map_or(Ok(()), |piece| callable.call1(py, (PyBytes::new(py, &piece),)).map(drop));
        let mut state = self.state();
        state.last_piece = Instant::now();
        if sent.is_err() {
            state.callable = None;
        }
        sent
    }

    fn state(&self) -> MutexGuard<'_, SinkState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
