//! Recordings for the Rerun viewer: every relaxation step of one or more solves, with the layout in which they open.
//!
//! ```text
//! Scene --> Stage { picture, ranges } --> Recording (blueprint and statics in the file)
//!                                             |
//! Solver --(Step)--> Recorder: traces of every step, frames of the steps that Thinning picks
//! ```
//!
//! A recording over loads instead of steps is a [`LoadRecording`].
//!
//! Timelines: `step`, `seconds` (of the solver, observers left out) and `transforms`; scenes share them. Pressures are
//! recorded over `E*`, gaps over the rms height, both in the power of a thousand that the axes state. Positions are
//! coordinates of the drawing. Steps of coarser grids are drawn on the axes of the scene, each node at its true place.
//!
//! ```no_run
//! use asperity::{Contact, Grid, Indenter, Problem, Stop};
//! use asperity::contact::{PolonskyKeer, Solver};
//! use asperity::record::{Options, Recording, Scene};
//! use std::path::Path;
//!
//! let surface = Indenter::Cylinder { radius: 40e-6 }.surface(Grid::line(4096, 160e-6)?)?;
//! let problem = Problem::new(surface, 1e9, 1e6)?;
//! let scene = Scene {
//!     name: "cylinder".into(),
//!     title: "Cylinder".into(),
//!     problem: &problem,
//!     description: "# Cylinder".into(),
//!     exact: None,
//! };
//! let recording = Recording::create(Path::new("cylinder.rrd"), &[scene], Options::default())?;
//! let mut recorder = recording.recorder(0);
//! let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut recorder)?;
//! recorder.close(&contact)?;
//! recording.finish()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
mod blueprint;
mod description;
mod field;
mod fill;
mod forecast;
mod ghost;
mod layout;
mod line;
#[cfg(feature = "explore")]
mod live;
mod loads;
mod output;
mod palette;
mod part;
mod recorder;
mod reduce;
mod relief;
mod scene;
mod size;
mod snapshot;
mod spectrum;
mod stage;
mod thinning;
mod traces;
mod viewer;
mod window;

pub use description::describe;
pub use ghost::Ghost;
#[cfg(feature = "explore")]
pub use live::Live;
pub use loads::{Curve, LoadRecording, Loads};
pub use part::{Part, Parts};
pub use recorder::Recorder;
pub use scene::Scene;
pub use size::Size;

use crate::error::FileError;
use crate::files::check_target;
use output::Output;
use rerun::external::re_log_types::ApplicationId;
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};
use stage::Stage;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Application under which the viewer keeps layouts apart.
const APPLICATION: &str = "asperity";

/// What is recorded, and how much of it.
#[derive(Debug, Clone)]
pub struct Options {
    /// What is recorded of each scene, as far as it can show that; the rest is neither computed nor laid out.
    pub what: Parts,
    /// Fields of every n-th step; `None` records all of the first steps and then ever sparser ones: of 100 000, some 120 for
    /// lines and 60 for surfaces; of each coarser grid a sixth of that. Numbers are recorded at every step.
    pub every: Option<usize>,
    /// Unit of the lengths of the problems, for the axes. Metres (`m`) are shown as mm, µm or nm.
    pub length_unit: String,
    /// Curves of an earlier solve, drawn beside those of each scene.
    pub ghost: Option<Arc<Ghost>>,
}

impl Default for Options {
    /// Every part, the automatic schedule, lengths in metres, nothing beside.
    fn default() -> Self {
        Self { what: Parts::USUAL, every: None, length_unit: "m".into(), ghost: None }
    }
}

/// A recording on its way into a file, which can be opened at any moment.
pub struct Recording {
    stream: RecordingStream,
    output: Output,
    path: PathBuf,
    stages: Vec<Stage>,
    options: Options,
    flush_interval: Duration,
}

/// How much a killed run may lose.
const FLUSH_INTERVAL: Duration = Duration::from_millis(200);

impl Recording {
    /// Opens the file, and writes into it the layout of `scenes` and what does not change from step to step.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        check_target(path)?;
        let output = Output::create(path).map_err(|failure| target_error(path, &failure))?;
        Self::begin(output, path, None, scenes, options)
    }

    /// Writes into `output`, the file at `path`, the layout of `scenes` and what does not change from step to step.
    fn begin(
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
    fn open(
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
    fn application(&self) -> ApplicationId {
        self.stream.store_info().map_or(APPLICATION.into(), |info| info.application_id().clone())
    }

    /// The observer that records the solve of scene number `scene`.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn recorder(&self, scene: usize) -> Recorder<'_> {
        Recorder::new(self, &self.stages[scene], &self.options)
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
        layout::send(self.application(), &self.stages, stream)?;
        let several = scenes.len() > 1;
        for (i, (stage, scene)) in self.stages.iter().zip(scenes).enumerate() {
            stream.log_static(stage.description(), &stage.described("still running, or ended by force"))?;
            stage.log_static(stream, scene, several.then_some(i))?;
            if let Some(ghost) = &self.options.ghost {
                stage.log_ghost(stream, ghost)?;
            }
        }
        Ok(())
    }

    /// Writes what `log` records, to the last byte.
    fn write(&self, log: impl FnOnce(&RecordingStream) -> RecordingStreamResult<()>) -> Result<(), FileError> {
        log(&self.stream).map_err(|failure| self.write_error(io::Error::other(failure)))?;
        self.flush()
    }

    fn flush(&self) -> Result<(), FileError> {
        let flushed = self.stream.flush_blocking().map_err(io::Error::other);
        self.output.check().and(flushed).map_err(|failure| self.write_error(failure))
    }

    fn write_error(&self, source: io::Error) -> FileError {
        FileError::Write { path: self.path.clone(), source }
    }
}

fn target_error(path: &Path, failure: &dyn std::error::Error) -> FileError {
    FileError::Target { path: path.into(), reason: failure.to_string() }
}

/// What a recording goes by.
#[derive(Clone, Copy)]
struct Name<'a> {
    /// For people.
    title: &'a str,
    /// For programs. With one, the recording is an application as well, whose layout is its own.
    id: Option<&'a str>,
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
fn stages(scenes: &[Scene<'_>], above: &str, options: &Options) -> Vec<Stage> {
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
    use crate::contact::{PolonskyKeer, Solver, Stop};
    use crate::grid::Grid;
    use crate::surface::Indenter;
    use crate::{Contact, Problem};
    use std::collections::BTreeMap;

    pub fn cylinder() -> Problem {
        let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(64, 4.0).unwrap()).unwrap();
        Problem::new(cylinder, 1.0, 1e-2).unwrap()
    }

    pub fn scene<'a>(name: &str, problem: &'a Problem) -> Scene<'a> {
        Scene { name: name.into(), title: name.into(), problem, description: String::new(), exact: None }
    }

    fn record(path: &Path) -> Contact {
        let problem = cylinder();
        let recording = Recording::create(path, &[scene("cylinder", &problem)], Options::default()).unwrap();
        let mut recorder = recording.recorder(0);
        let contact = PolonskyKeer.solve(&problem, &Stop::default(), &mut recorder).unwrap();
        recorder.close(&contact).unwrap();
        recording.finish().unwrap();
        contact
    }

    /// What does change in a recording.
    pub fn chunks(path: &Path) -> Vec<rerun::log::Chunk> {
        let mut file = std::fs::File::open(path).unwrap();
        let stores = rerun::ChunkStore::from_rrd_reader(&rerun::ChunkStoreConfig::ALL_DISABLED, &mut file).unwrap();
        let recordings = stores.iter().filter(|(id, _)| id.kind() == rerun::StoreKind::Recording);
        let chunks = recordings.flat_map(|(_, store)| store.iter_physical_chunks());
        chunks.filter(|chunk| !chunk.is_static()).map(|chunk| (**chunk).clone()).collect()
    }

    /// Rows of each temporal entity.
    pub fn rows(path: &Path) -> BTreeMap<String, usize> {
        let mut rows = BTreeMap::new();
        for chunk in chunks(path) {
            *rows.entry(chunk.entity_path().to_string()).or_default() += chunk.num_rows();
        }
        rows
    }

    #[test]
    fn every_step_has_numbers_and_the_last_state_is_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cylinder.rrd");
        let steps = record(&path).work.iterations + 1;
        let rows = rows(&path);
        assert_eq!(rows["/cylinder/trace/kappa_r"], steps);
        assert_eq!(rows["/cylinder/profile/solid"], steps.min(32) + 1);
        assert!(!rows.contains_key("/cylinder/trace/exact_kappa_r"));
        assert!(!rows.keys().any(|entity| entity.contains("relief")));
    }

    #[test]
    fn places_that_cannot_be_written_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let problem = cylinder();
        for path in [folder.path().to_path_buf(), folder.path().join("missing/a.rrd")] {
            let created = Recording::create(&path, &[scene("a", &problem)], Options::default());
            assert!(matches!(created, Err(FileError::Target { .. })));
        }
    }

    #[test]
    fn roots_are_safe_and_differ() {
        let problem = cylinder();
        let scenes = ["a", "a", "b/c d", ""].map(|name| scene(name, &problem));
        assert_eq!(roots(&scenes), ["/a", "/a_1", "/b_c_d", "/_3"]);
    }
}
