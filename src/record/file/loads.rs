//! Recordings over loads: curves and a figure, and for each load the contact under it.
//!
//! The one timeline is `load`, the number of the load from 1 on. A time picked in a curve or on the time line shows the
//! contacts under that load. The pictures are those of [`Recording`], on axes that all loads share.

use super::output::Output;
use super::recording::{Name, Recording, stages, target_error};
use crate::contact::Contact;
use crate::error::FileError;
use crate::files::check_target;
use crate::plot;
use crate::record::draw::{Curve, Curves, Extent, Fields, FigurePicture, PatchMap, Stage};
use crate::record::layout::{Panes, send_loads};
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult, TextDocument};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Timeline of loads.
const LOAD: &str = "load";
/// Root of the scenes.
const CONTACT: &str = "/contact";
/// Entity of the text about the current load.
const TEXT: &str = "/load";

/// The content of a recording over loads.
pub struct Loads<'a> {
    /// Title of the recording.
    pub title: String,
    /// Subject of the recording, in Markdown.
    pub description: String,
    /// Meaning of each value of the timeline `load`, such as `p* = 1.0e-3`; lightest first.
    pub captions: Vec<String>,
    /// Curves over the loads.
    pub curves: Vec<Curve>,
    /// A figure, and where in its panels each load stands along x.
    pub figure: Option<(&'a plot::Figure, Vec<f64>)>,
    /// Contacts that grow; each problem is the one under the heaviest load, as is its exact solution.
    pub scenes: &'a [Scene<'a>],
}

/// A recording over loads on its way into a file, which can be opened at any moment.
///
/// Loads can come in any order and from several threads. Loads that never come are not shown.
pub struct LoadRecording {
    recording: Recording,
    description: String,
    captions: Vec<String>,
    curves: Option<Curves>,
    figure: Option<FigurePicture>,
    /// One per scene; surfaces have none.
    patches: Vec<Option<PatchMap>>,
    progress: Mutex<Progress>,
}

/// Everything recorded so far.
struct Progress {
    loads: BTreeSet<usize>,
    /// Extents of the contacts of each scene.
    extents: Vec<Extent>,
}

impl LoadRecording {
    /// Opens the file, and writes into it the layout and all that does not change from load to load.
    ///
    /// The part [`Part::Traces`] of the `options` stands for the curves, and `every` does not count.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, loads: &Loads<'_>, options: Options) -> Result<Self, FileError> {
        check_target(path)?;
        let output = Output::create(path).map_err(|failure| target_error(path, &failure))?;
        Self::begin(output, path, None, loads, options)
    }

    /// Writes into `output`, the file at `path`, the layout and all that does not change from load to load.
    pub(super) fn begin(
        output: Output,
        path: &Path,
        id: Option<&str>,
        loads: &Loads<'_>,
        options: Options,
    ) -> Result<Self, FileError> {
        let curves = options.what.has(Part::Traces).then(|| Curves::new(&loads.curves));
        let options = Options { what: options.what.and(Parts::PICTURES), ..options };
        let stages = stages(loads.scenes, CONTACT, &options);
        let map = |stage: &Stage| PatchMap::new(stage, loads.captions.len());
        let extents = vec![Extent::NONE; stages.len()];
        let recording = Self {
            patches: stages.iter().map(map).collect(),
            recording: Recording::open(output, path, Name { title: &loads.title, id }, stages, options)?,
            description: loads.description.clone(),
            captions: loads.captions.clone(),
            curves,
            figure: loads.figure.as_ref().map(|(figure, cursor)| FigurePicture::new(figure, cursor.clone())),
            progress: Mutex::new(Progress { loads: BTreeSet::new(), extents }),
        };
        recording.recording.write(|stream| recording.log_static(stream, loads.scenes))?;
        Ok(recording)
    }

    /// Records the values of all curves, in their order, under load number `load`, from 0 on. Values that are not finite
    /// or missing are left out.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    ///
    /// # Panics
    /// If there is no such load.
    pub fn values(&self, load: usize, values: &[f64]) -> Result<(), FileError> {
        self.recording.write(|stream| {
            self.turn_to(stream, load)?;
            let Some(curves) = &self.curves else { return Ok(()) };
            curves.log(stream, values)?;
            stream.log(TEXT, &self.text(load, &curves.table(values)))
        })
    }

    /// Records the contact of scene number `scene` under load number `load`, both from 0 on.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    ///
    /// # Panics
    /// If there is no such scene or load, or if the contact is not on the grid of the scene.
    pub fn contact(&self, scene: usize, load: usize, contact: &Contact) -> Result<(), FileError> {
        let stage = &self.recording.stages[scene];
        self.recording.write(|stream| {
            self.turn_to(stream, load)?;
            stream.log(stage.description(), &stage.described(&Stage::result(contact), ""))?;
            if stage.what.has_planes() {
                stage.log_caption(stream, self.captions[load].clone())?;
            }
            self.log_frame(stream, scene, load, &Fields::of_contact(contact))
        })
    }

    /// Fits axes and colours to the contacts, writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        let extents = std::mem::take(&mut self.progress().extents);
        let mut stages = self.recording.stages.iter().zip(extents).filter(|(_, extent)| *extent != Extent::NONE);
        self.recording.write(|stream| stages.try_for_each(|(stage, extent)| stage.picture.settle(stream, extent)))?;
        self.recording.finish()
    }

    fn log_static(&self, stream: &RecordingStream, scenes: &[Scene<'_>]) -> RecordingStreamResult<()> {
        let panes = Panes {
            timeline: LOAD,
            text: TEXT,
            stages: &self.recording.stages,
            patches: &self.patches,
            figure: self.figure.as_ref(),
            curves: self.curves.as_ref(),
        };
        send_loads(self.recording.application(), &panes, stream)?;
        if let Some(curves) = &self.curves {
            curves.log_static(stream)?;
        }
        if let Some(figure) = &self.figure {
            figure.log_static(stream)?;
        }
        for ((stage, scene), patches) in self.recording.stages.iter().zip(scenes).zip(&self.patches) {
            stage.log_static(stream, scene, None)?;
            patches.as_ref().map_or(Ok(()), |patches| patches.log_static(stream))?;
        }
        Ok(())
    }

    /// Sets the time to a load; at its first use caption and cursor are recorded.
    fn turn_to(&self, stream: &RecordingStream, load: usize) -> RecordingStreamResult<()> {
        stream.set_time_sequence(LOAD, load as i64 + 1);
        if !self.progress().loads.insert(load) {
            return Ok(());
        }
        if let Some(figure) = &self.figure {
            figure.log_cursor(stream, load, &self.captions[load])?;
        }
        stream.log(TEXT, &self.text(load, ""))
    }

    fn log_frame(
        &self,
        stream: &RecordingStream,
        scene: usize,
        load: usize,
        fields: &Fields<'_>,
    ) -> RecordingStreamResult<()> {
        let stage = &self.recording.stages[scene];
        let extent = &mut self.progress().extents[scene];
        *extent = extent.and(stage.picture.extent(fields));
        stage.log_frame(stream, fields)?;
        let patches = self.patches[scene].as_ref();
        patches.map_or(Ok(()), |patches| patches.log(stream, load, &stage.picture.segments(fields)))
    }

    /// The load and its numbers, above what the recording is about.
    fn text(&self, load: usize, table: &str) -> TextDocument {
        let (caption, number, all) = (&self.captions[load], load + 1, self.captions.len());
        let description = &self.description;
        TextDocument::from_markdown(format!("# {caption}\n\nLoad {number} of {all}.\n\n{table}\n\n{description}"))
    }

    fn progress(&self) -> MutexGuard<'_, Progress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
