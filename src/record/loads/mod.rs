//! Recordings over loads: curves and a figure, and for each load the contact under it.
//!
//! The one timeline is `load`, the number of the load from 1 on. A time picked in a curve or on the time line shows the
//! contacts under that load. The pictures are those of [`Recording`], on axes that all loads share.

mod curves;
mod figure;
mod layout;
mod patches;

use super::part::Part;
use super::scene::{Extent, Fields, Scene, with_fields};
use super::stage::{Picture, Stage};
use super::{Options, Recording, stages};
use crate::contact::Contact;
use crate::error::FileError;
use crate::plot;
use crate::surface::check_target;
use curves::Curves;
use figure::FigurePicture;
use patches::PatchMap;
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

/// What a recording over loads shows.
pub struct Loads<'a> {
    /// Title of the recording.
    pub title: String,
    /// What it is about, in Markdown.
    pub description: String,
    /// What each value of the timeline `load` stands for, such as `p* = 1.0e-3`; lightest first.
    pub captions: Vec<String>,
    /// Curves over the loads.
    pub curves: Vec<Curve>,
    /// A figure, and where in its panels each load stands along x.
    pub figure: Option<(&'a plot::Figure, Vec<f64>)>,
    /// Contacts that grow; each problem is the one under the heaviest load, as is what is exact.
    pub scenes: &'a [Scene<'a>],
}

/// A curve over the loads.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Title of the view that it shares with others.
    pub view: String,
    /// Name in the legend.
    pub name: String,
    /// Red, green and blue, as on paper: black is drawn white.
    pub colour: [u8; 3],
}

/// A recording over loads on its way into a file, which can be opened at any moment.
///
/// Loads can come in any order and from several threads. Those that never come are not shown.
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

/// What was recorded so far.
struct Progress {
    loads: BTreeSet<usize>,
    /// How far the contacts of each scene reach.
    extents: Vec<Extent>,
}

impl LoadRecording {
    /// Opens the file, and writes into it the layout and what does not change from load to load.
    ///
    /// Of `options`, the part [`Part::Traces`] stands for the curves, and `every` does not count.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, loads: &Loads<'_>, options: Options) -> Result<Self, FileError> {
        check_target(path)?;
        let curves = options.what.has(Part::Traces).then(|| Curves::new(&loads.curves));
        let options = Options { what: options.what.pictures(), ..options };
        let stages = stages(loads.scenes, CONTACT, &options);
        let map = |stage: &Stage| PatchMap::new(stage, loads.captions.len());
        let extents = vec![Extent::NONE; stages.len()];
        let recording = Self {
            patches: stages.iter().map(map).collect(),
            recording: Recording::open(path, &loads.title, stages, options)?,
            description: loads.description.clone(),
            captions: loads.captions.clone(),
            curves,
            figure: loads.figure.as_ref().map(|(figure, cursor)| FigurePicture::new(figure, cursor.clone())),
            progress: Mutex::new(Progress { loads: BTreeSet::new(), extents }),
        };
        recording.recording.write(|stream| recording.log_static(stream, loads.scenes))?;
        Ok(recording)
    }

    /// Records the values of all curves, in their order, under load number `load`, from 0 on. Those that are not finite
    /// are left out.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    ///
    /// # Panics
    /// If there is no such load.
    pub fn values(&self, load: usize, values: &[f64]) -> Result<(), FileError> {
        self.recording.write(|stream| {
            self.begin(stream, load)?;
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
            self.begin(stream, load)?;
            stream.log(stage.description(), &stage.result(contact))?;
            if stage.what.has_planes() {
                stage.log_caption(stream, self.captions[load].clone())?;
            }
            with_fields(contact, |fields| self.log_frame(stream, scene, load, fields))
        })
    }

    /// Fits axes and colours to the contacts, writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        let extents = std::mem::take(&mut self.progress().extents);
        let mut stages = self.recording.stages.iter().zip(extents).filter(|(_, extent)| *extent != Extent::NONE);
        self.recording.write(|stream| stages.try_for_each(|(stage, extent)| stage.settle(stream, extent)))?;
        self.recording.finish()
    }

    fn log_static(&self, stream: &RecordingStream, scenes: &[Scene<'_>]) -> RecordingStreamResult<()> {
        layout::send(self, stream)?;
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

    /// Sets the time to a load; at its first use what goes with it is recorded.
    fn begin(&self, stream: &RecordingStream, load: usize) -> RecordingStreamResult<()> {
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
        *extent = extent.and(stage.extent(fields));
        stage.log_frame(stream, fields)?;
        match (&self.patches[scene], &stage.picture) {
            (Some(patches), Picture::Line(line)) => patches.log(stream, load, &line.contact(fields)),
            _ => Ok(()),
        }
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
