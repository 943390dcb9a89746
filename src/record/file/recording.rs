//! Recordings over the steps of solvers.

use super::output::Output;
use crate::error::FileError;
use crate::files::check_target;
use crate::record::draw::Stage;
use crate::record::layout;
use crate::record::options::Options;
use crate::record::scene::Scene;
use rerun::external::re_log_types::ApplicationId;
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Application under which the viewer keeps layouts apart.
const APPLICATION: &str = "asperity";

/// The result of a run until there is one.
pub(super) const UNFINISHED: &str = "still running, or ended by force";

/// A recording on its way into a file, which can be opened at any moment.
pub struct Recording {
    pub(super) stream: RecordingStream,
    output: Output,
    path: PathBuf,
    pub(super) stages: Vec<Stage>,
    pub(super) options: Options,
    pub(super) flush_interval: Duration,
}

/// The last part of a run that is lost if it is killed.
const FLUSH_INTERVAL: Duration = Duration::from_millis(200);

impl Recording {
    /// Opens the file, and writes into it the layout of `scenes` and all that does not change from step to step.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        check_target(path)?;
        let output = Output::create(path).map_err(|failure| target_error(path, &failure))?;
        Self::begin(output, path, None, scenes, options)
    }

    /// Writes into `output`, the file at `path`, the layout of `scenes` and all that does not change from step to step.
    pub(super) fn begin(
        output: Output,
        path: &Path,
        id: Option<&str>,
        scenes: &[Scene<'_>],
        options: Options,
    ) -> Result<Self, FileError> {
        let titles: Vec<&str> = scenes.iter().map(|scene| scene.title.as_str()).collect();
        let name = Name { title: &titles.join(", "), id };
        let recording = Self::open(output, path, name, stages(scenes, "", &options), options)?;
        recording.write(|stream| recording.log_static(stream, scenes))?;
        Ok(recording)
    }

    /// Writes into `output`, the file at `path`, nothing but the `name`.
    pub(super) fn open(
        output: Output,
        path: &Path,
        name: Name<'_>,
        stages: Vec<Stage>,
        options: Options,
    ) -> Result<Self, FileError> {
        let stream = open(output.clone(), name).map_err(|failure| target_error(path, &failure))?;
        Ok(Self { stream, output, path: path.into(), stages, options, flush_interval: FLUSH_INTERVAL })
    }

    /// The application under which the viewer keeps its layout.
    pub(super) fn application(&self) -> ApplicationId {
        self.stream.store_info().map_or(APPLICATION.into(), |info| info.application_id().clone())
    }

    /// Writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        self.flush()?;
        self.output.finish().map_err(|failure| self.write_error(failure))
    }

    fn log_static(&self, stream: &RecordingStream, scenes: &[Scene<'_>]) -> RecordingStreamResult<()> {
        layout::send_steps(self.application(), &self.stages, stream)?;
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
        log(&self.stream).map_err(|failure| self.write_error(io::Error::other(failure)))
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
        self.output.check().map_err(|failure| self.write_error(failure))
    }

    fn flush(&self) -> Result<(), FileError> {
        let flushed = self.stream.flush_blocking().map_err(io::Error::other);
        self.output.check().and(flushed).map_err(|failure| self.write_error(failure))
    }

    fn write_error(&self, source: io::Error) -> FileError {
        FileError::Write { path: self.path.clone(), source }
    }
}

/// The error of a place where no file can be.
pub(super) fn target_error(path: &Path, failure: &dyn std::error::Error) -> FileError {
    FileError::Target { path: path.into(), reason: failure.to_string() }
}

/// The names of a recording.
#[derive(Clone, Copy)]
pub(super) struct Name<'a> {
    /// Title for people.
    pub title: &'a str,
    /// Identity for programs. With one, the recording is an application as well, whose layout is its own.
    pub id: Option<&'a str>,
}

/// A stream into `output` whose times are ours alone.
fn open(output: Output, Name { title, id }: Name<'_>) -> RecordingStreamResult<RecordingStream> {
    let own = id.and_then(|id| ApplicationId::try_new(format!("{APPLICATION}-{id}")).ok());
    let builder = RecordingStreamBuilder::new(own.unwrap_or(APPLICATION.into())).recording_name(title).enabled(true);
    let builder = if let Some(id) = id { builder.recording_id(id) } else { builder };
    let stream = builder.buffered()?;
    stream.set_sink(Box::new(output));
    stream.set_log_time_enabled(false);
    stream.set_log_tick_enabled(false);
    Ok(stream)
}

/// The scenes, prepared to be recorded under `above`.
pub(super) fn stages(scenes: &[Scene<'_>], above: &str, options: &Options) -> Vec<Stage> {
    let stage = |(scene, root)| Stage::new(scene, format!("{above}{root}"), options);
    scenes.iter().zip(roots(scenes)).map(stage).collect()
}

/// Roots of the entities, one per scene: safe characters only, and no two the same.
fn roots(scenes: &[Scene<'_>]) -> Vec<String> {
    let mut roots: Vec<String> = Vec::new();
    for scene in scenes {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
        let root = format!("/{}", scene.name.chars().map(safe).collect::<String>());
        let taken = root.len() == 1 || roots.contains(&root);
        roots.push(if taken { format!("{root}_{}", roots.len()) } else { root });
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactModulus, Load, Problem};
    use crate::{Grid, Indenter};

    #[test]
    fn roots_are_safe_and_differ() {
        let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(64, 4.0).unwrap()).unwrap();
        let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-2)).unwrap();
        let scene = |name: &str| Scene::new(name, &problem);
        assert_eq!(roots(&["a", "a", "b/c d", ""].map(scene)), ["/a", "/a_1", "/b_c_d", "/_3"]);
    }
}
