//! Recordings over the steps of solvers.

use super::output::Output;
use crate::error::FileError;
use crate::record::description;
use crate::record::draw::Stage;
use crate::record::layout;
use crate::record::options::Options;
use crate::record::scene::Scene;
use rerun::external::re_log_types::ApplicationId;
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};
use std::io;
use std::path::Path;
use std::time::Duration;

/// The result of a run until there is one.
pub(super) const UNFINISHED: &str = "still running, or ended by force";

/// A recording on its way into a file, which can be opened at any moment.
pub struct Recording {
    pub(super) stream: RecordingStream,
    output: Output,
    pub(super) stages: Vec<Stage>,
    pub(super) options: Options,
    /// The last part of a run that is lost if it is killed.
    pub(super) flush_interval: Duration,
}

impl Recording {
    /// Opens the file, and writes into it the layout of `scenes` and all that does not change from step to step.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        Self::begin(Output::create(path)?, None, scenes, options)
    }

    /// Starts the installed viewer, or takes the one that runs, and begins a recording that it shows. A file at `path` gets it
    /// as well, if there is one.
    ///
    /// # Errors
    /// [`FileError::NoViewer`] where there is no viewer, else the errors of [`Recording::create`].
    pub fn shown(path: Option<&Path>, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        Self::begin(Output::shown(path)?, None, scenes, options)
    }

    /// Begins a recording under the name `id` in a temporary file, and returns the means to read it.
    ///
    /// # Errors
    /// [`FileError::Target`] if no temporary file can be made, [`FileError::Write`] if writing to it fails.
    #[cfg(feature = "explore")]
    pub fn live(id: &str, scenes: &[Scene<'_>], options: Options) -> Result<(Self, Output), FileError> {
        let output = Output::temporary()?;
        Ok((Self::begin(output.clone(), Some(id), scenes, options)?, output))
    }

    fn begin(output: Output, id: Option<&str>, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        let name = Name::of(description::name(scenes), scenes, id);
        let recording = Self::open(output, &name, stages(scenes, "", &options), options)?;
        recording.write(|stream| recording.log_static(stream, scenes))?;
        Ok(recording)
    }

    /// Begins a recording with no more than its name. One that has an identity comes soon after it is made.
    pub(super) fn open(output: Output, name: &Name, stages: Vec<Stage>, options: Options) -> Result<Self, FileError> {
        let stream = stream(output.clone(), name).map_err(|failure| output.error(io::Error::other(failure)))?;
        let flush_interval = Duration::from_millis(if name.id.is_some() { 40 } else { 200 });
        Ok(Self { stream, output, stages, options, flush_interval })
    }

    /// Writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        self.flush()?;
        self.output.finish()
    }

    fn log_static(&self, stream: &RecordingStream, scenes: &[Scene<'_>]) -> RecordingStreamResult<()> {
        layout::send_steps(&self.stages, stream)?;
        let several = scenes.len() > 1;
        for (i, (stage, scene)) in self.stages.iter().zip(scenes).enumerate() {
            stream.log_static(stage.description(), &stage.described(UNFINISHED, ""))?;
            stage.log_static(stream, scene, several.then_some(i))?;
            if let Some(ghost) = &self.options.ghost {
                stage.log_ghost(stream, ghost)?;
            }
        }
        Ok(())
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

    /// Has everything so far written soon, and reports an earlier failure to write.
    pub(super) fn flush_soon(&self) -> Result<(), FileError> {
        self.stream.flush_async().ok(); // a failure shows at the next flush
        self.output.check()
    }

    fn flush(&self) -> Result<(), FileError> {
        let flushed = self.stream.flush_blocking();
        self.output.check()?;
        flushed.map_err(|failure| self.output.error(io::Error::other(failure)))
    }
}

/// What a recording is called.
pub struct Name {
    /// The title for people.
    title: String,
    /// The application to which the viewer keeps a layout: recordings with layouts of their own have each its own.
    application: String,
    /// The identity for programs, if it is not left to chance.
    id: Option<String>,
}

impl Name {
    /// The name of a recording of some scenes.
    pub(super) fn of(title: String, scenes: &[Scene<'_>], id: Option<&str>) -> Self {
        let application = description::application(&title, scenes);
        let application = id.map_or(application.clone(), |id| format!("{application}-{id}"));
        Self { title, application, id: id.map(String::from) }
    }

    /// The name of a recording that is made of others.
    pub(super) fn made_of(title: String, others: &[String]) -> Self {
        Self { title, application: description::application_of(others), id: None }
    }
}

/// A stream into `output` whose times are ours alone.
pub(super) fn stream(output: Output, name: &Name) -> RecordingStreamResult<RecordingStream> {
    let application = ApplicationId::new_or_unknown(name.application.as_str());
    let builder = RecordingStreamBuilder::new(application).recording_name(name.title.as_str()).enabled(true);
    let builder = if let Some(id) = &name.id { builder.recording_id(id.as_str()) } else { builder };
    let stream = builder.buffered()?;
    stream.set_sink(Box::new(output));
    stream.set_log_time_enabled(false);
    stream.set_log_tick_enabled(false);
    Ok(stream)
}

/// The scenes, prepared to be recorded under `above`, each under a root of its own of safe characters only.
pub(super) fn stages(scenes: &[Scene<'_>], above: &str, options: &Options) -> Vec<Stage> {
    let mut stages: Vec<Stage> = Vec::new();
    for scene in scenes {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
        let root = format!("{above}/{}", scene.name.chars().map(safe).collect::<String>());
        let is_taken = scene.name.is_empty() || stages.iter().any(|stage| stage.root == root);
        let root = if is_taken { format!("{root}_{}", stages.len()) } else { root };
        stages.push(Stage::new(scene, root, options));
    }
    stages
}
