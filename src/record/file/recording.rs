//! Recordings over the steps of solvers.

use super::background_task::BackgroundTask;
use super::output::Output;
use super::target::Target;
use super::writer::{NOT_BEGUN, Writer};
use crate::error::FileError;
use crate::record::description;
use crate::record::draw::{Ghost, Stage};
use crate::record::layout;
use crate::record::options::Options;
use crate::record::scene::Scene;
use crate::record::sdk;
use rerun::{RecordingStream, RecordingStreamResult};
use std::io;
use std::path::Path;
use std::sync::Arc;

/// A recording that is being written into a file, which can be opened at any time.
pub struct Recording {
    pub(super) stream: RecordingStream,
    output: Output,
    pub(super) stages: Arc<[Stage]>,
    pub(super) options: Options,
    /// The static data, being written.
    statics: Arc<BackgroundTask>,
}

impl Recording {
    /// Opens the file, which grows as a [`Draft`](crate::files::Draft) until it is whole, writes into it the layout of
    /// `scenes`, so that a viewer has it before anything else, and begins to write all that does not change from step to
    /// step, while the caller continues.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        Self::begin(Output::create(path)?, None, scenes, options)
    }

    /// Begins a recording of scenes that goes to a target.
    ///
    /// # Errors
    /// [`FileError::NoViewer`] where a viewer is asked for and there is none, else the errors of [`Recording::create`].
    pub fn to(target: Target<'_>, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        let (output, id) = target.open()?;
        Self::begin(output, id.as_deref(), scenes, options)
    }

    fn begin(output: Output, id: Option<&str>, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        let name = Name::new(description::name(scenes), scenes, id);
        let mut stages = stages(scenes, "", &options);
        layout::fit_steps(&mut stages, options.window);
        let recording = Self::open(output, &name, stages, options)?;
        recording.write(|stream| {
            layout::send_steps(&recording.stages, stream)?;
            let mut stages = recording.stages.iter();
            stages.try_for_each(|stage| stream.log_static(stage.description(), &stage.described(NOT_BEGUN, "")))
        })?;
        let (stream, output, stages) = (recording.stream.clone(), recording.output.clone(), recording.stages.clone());
        let ghost = recording.options.ghost.clone();
        let write = move || {
            if let Err(failure) = log_static(&stream, &stages, ghost.as_deref()) {
                output.fail(io::Error::other(failure));
            }
        };
        Ok(Self { statics: Arc::new(BackgroundTask::start(write)), ..recording })
    }

    /// Begins a recording with no more than its name. One that has an identity comes soon after it is made.
    pub(super) fn open(output: Output, name: &Name, stages: Vec<Stage>, options: Options) -> Result<Self, FileError> {
        let stream = stream(output.clone(), name).map_err(|failure| output.error(io::Error::other(failure)))?;
        Ok(Self { stream, output, stages: stages.into(), options, statics: Arc::default() })
    }

    /// Writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        self.wait_for_statics();
        self.flush()?;
        self.write(|stream| self.output.digest().send(stream))?;
        self.output.finish()
    }

    /// Removes the file, as nothing came of the run.
    pub fn discard(self) {
        self.output.discard();
    }

    /// Records by `log`.
    pub(super) fn log(&self, log: impl FnOnce(&RecordingStream) -> RecordingStreamResult<()>) -> Result<(), FileError> {
        log(&self.stream).map_err(|failure| self.output.error(io::Error::other(failure)))
    }

    /// Records by `log`, and writes everything so far to the last byte.
    pub(super) fn write(
        &self,
        log: impl FnOnce(&RecordingStream) -> RecordingStreamResult<()>,
    ) -> Result<(), FileError> {
        self.log(log)?;
        self.flush()
    }

    /// The writer for the solve of scene number `scene`.
    pub(super) fn writer(&self, scene: usize) -> Writer {
        let (stream, output, statics) = (self.stream.clone(), self.output.clone(), Arc::clone(&self.statics));
        Writer::new(stream, output, Arc::clone(&self.stages), scene, statics, self.options.every)
    }

    /// Waits until the layout and the static data are written.
    pub(super) fn wait_for_statics(&self) {
        self.statics.wait();
    }

    /// Reports an earlier failure to write.
    pub(super) fn check(&self) -> Result<(), FileError> {
        self.output.check()
    }

    /// Writes everything so far to the last byte.
    pub(super) fn flush(&self) -> Result<(), FileError> {
        let flushed = self.stream.flush_blocking();
        self.output.check()?;
        flushed.map_err(|failure| self.output.error(io::Error::other(failure)))
    }
}

/// Writes the static data.
fn log_static(stream: &RecordingStream, stages: &[Stage], ghost: Option<&Ghost>) -> RecordingStreamResult<()> {
    for stage in stages {
        stage.log_static(stream)?;
        if let Some(ghost) = ghost {
            stage.log_ghost(stream, ghost)?;
        }
    }
    Ok(())
}

/// The names of a recording.
pub(crate) struct Name {
    /// The title.
    title: String,
    /// The application to which the viewer keeps a layout: recordings with layouts of their own have each its own.
    application: String,
    /// The identity for programs, if it is not random.
    id: Option<String>,
}

impl Name {
    /// The name of a recording of some scenes.
    pub(super) fn new(title: String, scenes: &[Scene<'_>], id: Option<&str>) -> Self {
        let application = description::application(&title, scenes);
        let application = id.map_or(application.clone(), |id| format!("{application}-{id}"));
        Self { title, application, id: id.map(String::from) }
    }

    /// The name of a recording that is made of others.
    pub(super) fn made_of(title: String, others: &[String]) -> Self {
        Self { title, application: description::application_of(others), id: None }
    }
}

/// A stream into `output`.
pub(super) fn stream(output: Output, name: &Name) -> RecordingStreamResult<RecordingStream> {
    let stream = sdk::recording(&name.application, &name.title, name.id.as_deref())?;
    stream.set_sink(Box::new(output));
    Ok(stream)
}

/// Writes a recording that is known as a whole; if that fails, no file is left.
///
/// # Errors
/// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
pub(super) fn write_whole(
    path: &Path,
    name: &Name,
    log: impl FnOnce(&RecordingStream) -> RecordingStreamResult<()>,
) -> Result<(), FileError> {
    let output = Output::create(path)?;
    let failed = |failure| output.error(io::Error::other(failure));
    let flush =
        |stream: &RecordingStream| stream.flush_blocking().map_err(|failure| output.error(io::Error::other(failure)));
    let written = stream(output.clone(), name)
        .and_then(|stream| log(&stream).map(|()| stream))
        .map_err(failed)
        .and_then(|stream| {
            flush(&stream)?;
            output.digest().send(&stream).map_err(failed)?;
            flush(&stream)
        });
    written.and_then(|()| output.finish()).inspect_err(|_| output.discard())
}

/// The scenes, prepared to be recorded under `above`, each under a root of its own of safe characters only.
pub(super) fn stages(scenes: &[Scene<'_>], above: &str, options: &Options) -> Vec<Stage> {
    let mut stages: Vec<Stage> = Vec::new();
    for (i, scene) in scenes.iter().enumerate() {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
        let root = format!("{above}/{}", scene.name.chars().map(safe).collect::<String>());
        let is_taken = scene.name.is_empty() || stages.iter().any(|stage| stage.root == root);
        let root = if is_taken { format!("{root}_{}", stages.len()) } else { root };
        stages.push(Stage::new(scene, root, options, (scenes.len() > 1).then_some(i)));
    }
    stages
}
