//! Where a recording goes.

use crate::refusal::{refuse, refused};
use asperity::error::FileError;
use asperity::files::check_named;
use asperity::record::{Options, Pieces, Recording, Scene};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The time between two pieces, by which small ones become one.
const PATIENCE: Duration = Duration::from_millis(50);

/// Where a recording goes: a file, the installed viewer, a callable that takes it in pieces, or nowhere.
#[derive(Default)]
pub struct Target {
    pub path: Option<PathBuf>,
    pub is_live: bool,
    stream: Option<Stream>,
}

/// A callable that takes a recording in pieces.
struct Stream {
    pieces: Pieces,
    state: Mutex<State>,
}

struct State {
    /// The callable, gone once it has raised something.
    to: Option<Py<PyAny>>,
    passed: Instant,
}

impl Target {
    /// A file, if there is one, and the installed viewer, if it is live.
    pub fn new(path: Option<PathBuf>, is_live: bool) -> Self {
        Self { path, is_live, stream: None }
    }

    /// Has the recording passed on to a callable that takes bytes.
    pub fn stream_to(&mut self, to: &Bound<'_, PyAny>) -> PyResult<()> {
        if !to.is_callable() {
            return Err(PyTypeError::new_err(format!(
                "stream must be a callable that takes bytes, not {}",
                to.get_type().name()?
            )));
        }
        let state = State { to: Some(to.clone().unbind()), passed: Instant::now() };
        self.stream = Some(Stream { pieces: Pieces::default(), state: Mutex::new(state) });
        Ok(())
    }

    /// Refuses what cannot be.
    pub fn check(&self) -> PyResult<()> {
        if self.is_live && self.stream.is_some() {
            return refuse("a recording is shown in the installed viewer or streamed: give live or stream, not both");
        }
        self.path.as_deref().map_or(Ok(()), |path| check_named(path, &["rrd"])).map_err(refused)
    }

    /// Whether there is any.
    pub fn is_any(&self) -> bool {
        self.path.is_some() || self.is_live || self.stream.is_some()
    }

    /// The recording that goes there, if it goes anywhere.
    pub fn recording(
        &self,
        scenes: &[Scene<'_>],
        options: impl FnOnce() -> Options,
    ) -> Result<Option<Recording>, FileError> {
        let path = self.path.as_deref();
        match (&self.stream, path) {
            (Some(stream), _) => Recording::streamed(path, stream.pieces.clone(), scenes, options()),
            (None, _) if self.is_live => Recording::shown(path, scenes, options()),
            (None, Some(path)) => Recording::create(path, scenes, options()),
            (None, None) => return Ok(None),
        }
        .map(Some)
    }

    /// Passes on what has come of the recording, unless there was a piece just now.
    pub fn pass_on(&self, py: Python<'_>) -> PyResult<()> {
        match &self.stream {
            Some(stream) if stream.state().passed.elapsed() >= PATIENCE => stream.pass_on(py),
            _ => Ok(()),
        }
    }

    /// Passes on what is left.
    pub fn finish(&self, py: Python<'_>) -> PyResult<()> {
        self.stream.as_ref().map_or(Ok(()), |stream| stream.pass_on(py))
    }
}

impl Stream {
    fn pass_on(&self, py: Python<'_>) -> PyResult<()> {
        let Some(to) = self.state().to.as_ref().map(|to| to.clone_ref(py)) else { return Ok(()) };
        let piece = py.detach(|| self.pieces.next_piece()).map_err(refused)?;
        let passed = piece.map_or(Ok(()), |piece| to.call1(py, (PyBytes::new(py, &piece),)).map(drop));
        let mut state = self.state();
        state.passed = Instant::now();
        if passed.is_err() {
            state.to = None;
        }
        passed
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
