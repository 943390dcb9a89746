//! Recordings over loads: curves and a figure, and for each load the contact under it.
//!
//! The one timeline is `load`, the number of the load from 1 on. A time picked in a curve or on the time line shows the
//! contacts under that load. The pictures are those of [`Recording`], on axes that all loads share.

mod curves;
mod figure;
mod layout;
mod patches;

use super::output::Output;
use super::part::Part;
use super::scene::{Extent, Fields, Scene, with_fields};
use super::stage::{Picture, Stage};
use super::{Name, Options, Recording, stages, target_error};
use crate::contact::Contact;
use crate::error::FileError;
use crate::files::check_target;
use crate::plot;
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
        let output = Output::create(path).map_err(|failure| target_error(path, &failure))?;
        Self::begin(output, path, None, loads, options)
    }

    /// Writes into `output`, the file at `path`, the layout and what does not change from load to load.
    pub(super) fn begin(
        output: Output,
        path: &Path,
        id: Option<&str>,
        loads: &Loads<'_>,
        options: Options,
    ) -> Result<Self, FileError> {
        let curves = options.what.has(Part::Traces).then(|| Curves::new(&loads.curves));
        let options = Options { what: options.what.pictures(), ..options };
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

    /// Records the values of all curves, in their order, under load number `load`, from 0 on. Those that are not finite
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

#[cfg(test)]
mod tests {
    use super::super::Parts;
    use super::super::tests::{chunks, cylinder, rows, scene};
    use super::*;
    use crate::contact::{PolonskyKeer, Solver, Stop};
    use crate::plot::{Axis, Corner, Figure, Panel};
    use crate::{Grid, Indenter, Problem};

    const CAPTIONS: [&str; 3] = ["light", "middling", "heavy"];

    fn sphere() -> Problem {
        let grid = Grid::surface([16, 16], [4.0, 4.0]).unwrap();
        Problem::new(Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap(), 1.0, 1e-2).unwrap()
    }

    fn figure() -> Figure {
        let panel = Panel::new("p", Axis::log("x", [1e-3, 1.0]), Axis::linear("y", [0.0, 1.0]), Corner::TopLeft);
        Figure { title: "figure".into(), panels: vec![panel] }
    }

    fn curve(view: &str, name: &str) -> Curve {
        Curve { view: view.into(), name: name.into(), colour: [0, 0, 0] }
    }

    fn loads<'a>(scenes: &'a [Scene<'a>], figure: Option<&'a Figure>) -> Loads<'a> {
        Loads {
            title: "loads".into(),
            description: "about".into(),
            captions: CAPTIONS.map(String::from).to_vec(),
            curves: vec![curve("kappa", "kappa_r"), curve("kappa", "kappa"), curve("area", "area")],
            figure: figure.map(|figure| (figure, vec![1e-3, 1e-2, 2.0])),
            scenes,
        }
    }

    /// Two scenes under three loads, the heaviest first.
    fn record(path: &Path, what: Parts) {
        let (problems, figure) = ([cylinder(), sphere()], figure());
        let scenes = [scene("cylinder", &problems[0]), scene("sphere", &problems[1])];
        let options = Options { what, ..Options::default() };
        let recording = LoadRecording::create(path, &loads(&scenes, Some(&figure)), options).unwrap();
        for load in (0..CAPTIONS.len()).rev() {
            recording.values(load, &[1.0, if load == 1 { f64::NAN } else { 2.0 }, f64::INFINITY]).unwrap();
            for (number, problem) in problems.iter().enumerate() {
                let contact = PolonskyKeer.solve(problem, &Stop::default(), &mut ()).unwrap();
                recording.contact(number, load, &contact).unwrap();
            }
        }
        recording.finish().unwrap();
    }

    fn recorded(what: Parts) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("loads.rrd");
        record(&path, what);
        (folder, path)
    }

    #[test]
    fn each_load_is_drawn_once_and_values_that_are_not_finite_are_left_out() {
        let (_folder, path) = recorded(Parts::USUAL);
        let rows = rows(&path);
        for entity in ["cylinder/profile/solid", "cylinder/gap/curves/gap", "sphere/pressure/image", "sphere/caption"] {
            assert_eq!(rows[&format!("/contact/{entity}")], 3, "{entity}");
        }
        for entity in ["/contact/cylinder/patches/cursor", "/figure/0/cursor", "/curve/0"] {
            assert_eq!(rows[entity], 3, "{entity}");
        }
        assert_eq!(rows["/curve/1"], 2);
        assert!(!rows.contains_key("/curve/2"));
        assert!((1..=3).all(|load| rows[&format!("/contact/cylinder/patches/row/{load}")] == 1));
    }

    #[test]
    fn the_one_timeline_counts_loads_from_one_and_captions_follow() {
        let (_folder, path) = recorded(Parts::USUAL);
        let component = rerun::TextDocument::descriptor_text().component;
        let mut texts = std::collections::BTreeMap::new();
        for chunk in chunks(&path) {
            let timelines: Vec<String> = chunk.timelines().keys().map(|name| name.to_string()).collect();
            assert_eq!(timelines, [LOAD], "{}", chunk.entity_path());
            if chunk.entity_path().to_string() == TEXT {
                let times = chunk.iter_component_indices(LOAD.into(), component).map(|(time, _)| time.as_i64());
                let documents = chunk.iter_slices::<String>(component).map(|text| text[0].to_string());
                texts.extend(times.zip(documents));
            }
        }
        assert_eq!(texts.keys().copied().collect::<Vec<_>>(), [1, 2, 3]);
        for (text, caption) in texts.values().zip(CAPTIONS) {
            assert!(text.starts_with(&format!("# {caption}\n")) && text.ends_with("about"), "{text}");
        }
        assert!(texts[&1].contains("| kappa | 2.0000 |") && !texts[&2].contains("| kappa |"));
    }

    #[test]
    fn parts_that_are_not_asked_for_are_not_recorded() {
        let (_folder, path) = recorded([Part::Mask].into_iter().collect());
        let entities: Vec<String> = rows(&path).into_keys().collect();
        assert!(!entities.iter().any(|entity| entity.starts_with("/curve") || entity.contains("pressure")));
        assert!(entities.iter().any(|entity| entity == "/contact/cylinder/patches/row/3"));
        assert!(entities.iter().any(|entity| entity == "/contact/sphere/contact"));
        let (_folder, path) = recorded([Part::Traces].into_iter().collect());
        let entities: Vec<String> = rows(&path).into_keys().collect();
        assert!(entities.iter().any(|entity| entity == "/curve/0"));
        let drawn = |entity: &&String| entity.starts_with("/contact") && !entity.ends_with("/description");
        assert_eq!(entities.iter().find(drawn), None);
    }

    #[test]
    fn axes_reach_as_far_as_the_contacts_of_all_loads() {
        let near = Extent { pressure: 1.0, gap: 5.0, relief: [0.0, 1.0] };
        let far = Extent { pressure: 3.0, gap: 2.0, relief: [-1.0, 0.5] };
        assert_eq!(near.and(far), Extent { pressure: 3.0, gap: 5.0, relief: [-1.0, 1.0] });
        assert_eq!(Extent::NONE.and(far), far);
    }

    #[test]
    fn a_recording_of_nothing_can_be_finished_and_bad_places_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("empty.rrd");
        LoadRecording::create(&path, &loads(&[], None), Options::default()).unwrap().finish().unwrap();
        assert!(rows(&path).is_empty());
        for path in [folder.path().to_path_buf(), folder.path().join("missing/a.rrd")] {
            let created = LoadRecording::create(&path, &loads(&[], None), Options::default());
            assert!(matches!(created, Err(FileError::Target { .. })));
        }
    }
}
