//! Recordings for the Rerun viewer: every relaxation step of one or more solves, with the layout in which they open.
//!
//! ```text
//! Scene --> Stage { picture, ranges } --> Recording (blueprint and statics in the file)
//!                                             |
//! Solver --(Step)--> Recorder: traces of every step, frames of the steps that Thinning picks
//! ```
//!
//! Timelines: `step`, `seconds` (of the solver, observers left out) and `transforms`; scenes share them. Pressures are
//! recorded over `E*`, gaps over the rms height, both in the power of a thousand that the axes state. Positions are
//! coordinates of the drawing.
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
mod field;
mod layout;
mod line;
mod palette;
mod recorder;
mod reduce;
mod relief;
mod scene;
mod stage;
mod thinning;
mod traces;

pub use recorder::Recorder;
pub use scene::Scene;

use crate::error::FileError;
use crate::surface::check_target;
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamResult};
use stage::Stage;
use std::path::{Path, PathBuf};

/// Application under which the viewer keeps layouts apart.
const APPLICATION: &str = "asperity";

/// How much is recorded.
#[derive(Debug, Clone)]
pub struct Options {
    /// Fields of every n-th step; `None` records all of the first steps and then ever sparser ones: of 100 000, some 120 for
    /// lines and 60 for surfaces. Numbers are recorded at every step.
    pub every: Option<usize>,
    /// Unit of the lengths of the problems, for the axes. Metres (`m`) are shown as mm, µm or nm.
    pub length_unit: String,
}

impl Default for Options {
    /// The automatic schedule, lengths in metres.
    fn default() -> Self {
        Self { every: None, length_unit: "m".into() }
    }
}

/// A recording on its way into a file, which can be opened at any moment.
pub struct Recording {
    stream: RecordingStream,
    path: PathBuf,
    stages: Vec<Stage>,
    options: Options,
}

impl Recording {
    /// Opens the file, and writes into it the layout of `scenes` and what does not change from step to step.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, scenes: &[Scene<'_>], options: Options) -> Result<Self, FileError> {
        check_target(path)?;
        let roots = roots(scenes);
        let stage = |(scene, root)| Stage::new(scene, root, &options.length_unit);
        let stages: Vec<Stage> = scenes.iter().zip(roots).map(stage).collect();
        let recording = Self { stream: open(path, scenes)?, path: path.into(), stages, options };
        recording.log_static(scenes).map_err(|failure| recording.write_error(failure))?;
        recording.flush()?;
        Ok(recording)
    }

    /// The observer that records the solve of scene number `scene`.
    ///
    /// # Panics
    /// If there is no such scene.
    pub fn recorder(&self, scene: usize) -> Recorder<'_> {
        Recorder::new(self, &self.stages[scene], &self.options)
    }

    /// Writes what is left.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        self.flush()
    }

    fn log_static(&self, scenes: &[Scene<'_>]) -> RecordingStreamResult<()> {
        layout::send(APPLICATION, &self.stages, &self.stream)?;
        let several = scenes.len() > 1;
        let mut stages = self.stages.iter().zip(scenes).enumerate();
        stages.try_for_each(|(i, (stage, scene))| stage.log_static(&self.stream, scene, several.then_some(i)))
    }

    fn flush(&self) -> Result<(), FileError> {
        let hint = |failure| self.write_error(format!("{failure} (is the disk full?)"));
        self.stream.flush_blocking().map_err(hint)
    }

    fn write_error(&self, failure: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> FileError {
        FileError::Write { path: self.path.clone(), source: std::io::Error::other(failure) }
    }
}

fn open(path: &Path, scenes: &[Scene<'_>]) -> Result<RecordingStream, FileError> {
    let titles: Vec<&str> = scenes.iter().map(|scene| scene.title.as_str()).collect();
    let builder = RecordingStreamBuilder::new(APPLICATION).recording_name(titles.join(", ")).enabled(true);
    let target_error =
        |failure: rerun::RecordingStreamError| FileError::Target { path: path.into(), reason: failure.to_string() };
    let stream = builder.save(path).map_err(target_error)?;
    stream.set_log_time_enabled(false);
    stream.set_log_tick_enabled(false);
    Ok(stream)
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
