//! A recording that the installed viewer shows while it is written.

use super::output::Output;
use super::recording::{Recording, target_error};
use crate::error::FileError;
use crate::files::check_target;
use crate::record::options::Options;
use crate::record::scene::Scene;
use rerun::SpawnOptions;
use rerun::sink::GrpcSink;
use std::path::Path;

/// The file of a recording that is shown only.
const NOWHERE: &str = if cfg!(windows) { "NUL" } else { "/dev/null" };

impl Recording {
    /// Starts the installed viewer, or takes the one that runs, and begins a recording that it shows. A file at `path` gets it
    /// as well, if there is one.
    ///
    /// # Errors
    /// [`FileError::NoViewer`] where there is no viewer, else the errors of [`Recording::create`].
    pub fn shown(path: Option<&Path>, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        path.map_or(Ok(()), check_target)?;
        let viewer = start()?;
        let path = path.unwrap_or(Path::new(NOWHERE));
        let output = Output::create(path).map_err(|failure| target_error(path, &failure))?;
        output.show(Box::new(viewer));
        Self::begin(output, path, None, scenes, options)
    }
}

/// The installed viewer, bound to its port so that what is sent does not wait for it.
fn start() -> Result<GrpcSink, FileError> {
    let options = SpawnOptions { wait_for_bind: true, ..SpawnOptions::default() };
    let missing = || FileError::NoViewer { version: rerun::build_info().version.to_string() };
    let spawned = rerun::spawn(&options).map_err(|_| missing())?;
    let address = format!("rerun+http://127.0.0.1:{}/proxy", spawned.port);
    address.parse().map(GrpcSink::new).map_err(|_| missing())
}
