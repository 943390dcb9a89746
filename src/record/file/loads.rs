//! Recordings over loads: curves and a figure, and for each load the contact under it.
//!
//! The only timeline is `load`, the number of the load from 1 on; the value of each is under `/load/value`. The states of a history have
//! `step` in its place and, where they have times, a time line of those. A time picked in a curve or on the time line shows the contacts
//! under that load. The pictures are those of [`Recording`], on axes that all loads share.
//!
//! Loads and curves are known before the first contact. The states of a history are not: each of them brings its place on the axis
//! ([`LoadRecording::add_state`]) and perhaps a new curve, and axes, scales and layout are fitted to all of them at the end.

use super::output::Output;
use super::recording::{Name, Recording, stages};
use super::state_times::StateTimes;
use super::target::Target;
use crate::contact::{Contact, PatchHistory, Reading};
use crate::error::FileError;
use crate::plot;
use crate::record::draw::{
    Chart, Curves, FieldExtent, FigurePicture, FrameFields, LOAD, LoadAxis, Palette, RecordedCurve, Stage,
};
use crate::record::layout::{TEXT, fit_charts, fit_loads, send_loads};
use crate::record::options::Options;
use crate::record::parts::Parts;
use crate::record::scene::Scene;
use crate::record::units::with_unit;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult, Scalars, SeriesLines, TextDocument};
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Entity of the value of each load on their axis.
pub(crate) const VALUE: &str = "/load/value";

/// Timeline of the states of a history.
const STEP: &str = "step";

/// The content of a recording over loads.
pub struct Loads<'a> {
    /// Title of the recording.
    pub title: String,
    /// Subject of the recording, in Markdown.
    pub description: String,
    /// Meaning of each value of the timeline `load`, such as `p* = 1.0e-3`; lightest first.
    pub captions: Vec<String>,
    /// The quantity that grows from load to load: the axis of curves and patches, and of the panels of the figure.
    pub axis: LoadAxis,
    /// Curves over the loads.
    pub curves: Vec<RecordedCurve>,
    /// A figure with the loads along x.
    pub figure: Option<&'a plot::Figure>,
    /// The timeline of the recording.
    pub timeline: Timeline,
    /// Rows and columns from the first node on whose contact patches are followed from load to load in the first scene; none if they are not.
    pub followed: Option<[usize; 2]>,
    /// Contacts that grow; each problem is the one under the heaviest load, as is its exact solution.
    pub scenes: &'a [Scene<'a>],
}

/// The timeline of a recording over loads or over the states of a history.
#[derive(Debug, Clone, PartialEq)]
pub enum Timeline {
    /// `load`: the number of the load, from 1 on.
    Loads,
    /// `step`: the number of the state, from 1 on. Where the states have times, also `time`, a duration in seconds; or, where its
    /// nanoseconds do not resolve the times or end before them, a sequence whose name says what it counts, such as `time in 1e-18 s`. No
    /// two states are at the same time of it. The times are those of the path, between which the states come.
    States(Vec<f64>),
}

impl Timeline {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Loads => LOAD,
            Self::States(_) => STEP,
        }
    }
}

/// A recording over loads that is being written into a file, which can be opened at any time.
///
/// Loads can come in any order and from several threads. Missing loads are not shown. The states of a history come in their order. The file
/// is written within 0.2 s after a call, so that an error of writing may be returned by a later call.
pub struct LoadRecording {
    recording: Recording,
    description: String,
    captions: Vec<String>,
    axis: LoadAxis,
    timeline: Timeline,
    times: StateTimes,
    curves: Curves,
    /// Whether curves are recorded.
    has_curves: bool,
    figure: Option<FigurePicture>,
    progress: Mutex<LoadsSoFar>,
}

/// The loads so far, the extents of the contacts of each scene, and the charts of the curves.
struct LoadsSoFar {
    loads: BTreeSet<usize>,
    extents: Vec<FieldExtent>,
    charts: Vec<Chart>,
    /// The contact patches, as long as loads come in their order.
    patches: Option<PatchHistory>,
}

impl LoadRecording {
    /// Opens the file, and writes the layout and the static data.
    ///
    /// The part [`Part::Traces`] of the `options` means the curves, and `every` is ignored.
    ///
    /// # Errors
    /// [`FileError::Target`] if no file can be made at `path`, [`FileError::Write`] if writing to it fails.
    pub fn create(path: &Path, loads: &Loads<'_>, options: Options) -> Result<Self, FileError> {
        Self::begin(Output::create(path)?, None, loads, options)
    }

    /// Begins a recording that goes to a target.
    ///
    /// # Errors
    /// [`FileError::NoViewer`] where a viewer is asked for and there is none, else the errors of [`LoadRecording::create`].
    pub fn to(target: Target<'_>, loads: &Loads<'_>, options: Options) -> Result<Self, FileError> {
        let (output, id) = target.open()?;
        Self::begin(output, id.as_deref(), loads, options)
    }

    /// How many loads or states it has words for.
    pub fn count(&self) -> usize {
        self.captions.len()
    }

    /// Adds a state of a history behind the others, in words and with its place on the axis; also its time, if it has one. Its values and its
    /// contact can be recorded then.
    pub fn add_state(&mut self, words: String, place: f64, time: Option<f64>) {
        let number = self.captions.len();
        self.captions.push(words);
        self.axis.place(number, place);
        if let Some(time) = time {
            self.times.add(number, time);
        }
        self.progress().charts.iter_mut().for_each(|chart| chart.place(number, place));
    }

    /// Adds a curve behind the others, with a chart of its own.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    pub fn add_curve(&mut self, curve: RecordedCurve) -> Result<(), FileError> {
        if !self.has_curves {
            return Ok(());
        }
        let number = self.curves.push(curve.clone());
        let palette = Palette::new(self.recording.options.theme);
        let mut progress = self.progress();
        let chart = Chart::new(progress.charts.len(), (number, curve), &self.axis, palette);
        progress.charts.push(chart);
        drop(progress);
        self.write(|stream| self.curves.log_static(stream))
    }

    fn begin(output: Output, id: Option<&str>, loads: &Loads<'_>, options: Options) -> Result<Self, FileError> {
        let has_curves = options.what.has(Part::Traces);
        let curves = if has_curves { loads.curves.clone() } else { Vec::new() };
        let options = Options { what: options.what.and(Parts::PICTURES), ..options };
        let mut stages = stages(loads.scenes, "/contact", &options);
        for stage in &mut stages {
            stage.map_patches(&loads.axis);
        }
        if let (Some(_), Some(first)) = (loads.followed, stages.first_mut()) {
            first.follow_patches(&loads.axis);
        }
        let palette = Palette::new(options.theme);
        let extents = vec![FieldExtent::NONE; stages.len()];
        let mut charts = Chart::all(&curves, &loads.axis, palette);
        let mut figure = loads.figure.map(|figure| FigurePicture::new(figure, loads.axis.values.clone(), palette));
        let curves = Curves::new(curves);
        fit_loads(&mut stages, figure.as_mut(), &mut charts, &curves, options.window);
        let times = match &loads.timeline {
            Timeline::Loads => StateTimes::new(&[]),
            Timeline::States(times) => StateTimes::new(times),
        };
        let recording = Self {
            recording: Recording::open(
                output.for_states(),
                &Name::new(loads.title.clone(), loads.scenes, id),
                stages,
                options,
            )?,
            description: format!("{}\n\n{}", loads.description, times.note()).trim_end().to_owned(),
            captions: loads.captions.clone(),
            axis: loads.axis.clone(),
            timeline: loads.timeline.clone(),
            times,
            progress: Mutex::new(LoadsSoFar {
                loads: BTreeSet::new(),
                extents,
                charts,
                patches: loads.followed.map(PatchHistory::new),
            }),
            curves,
            has_curves,
            figure,
        };
        recording.recording.write(|stream| recording.log_static(stream))?;
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
        self.write(|stream| {
            self.turn_to(stream, load)?;
            self.curves.log(stream, values)?;
            let table = self.curves.table(values);
            if !table.is_empty() {
                stream.log(TEXT, &self.text(load, &table))?;
            }
            let turn = |to: &RecordingStream, load| self.set_time(to, load);
            self.progress().charts.iter_mut().try_for_each(|chart| chart.add(stream, &turn, load, values))
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
        self.state(scene, load, contact, &[])
    }

    /// Records the contact of scene number `scene` in state number `load` of a history, both from 0 on, with its further fields by
    /// their names.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    ///
    /// # Panics
    /// If there is no such scene or state, or if a field is not on the grid of the scene.
    pub fn state(
        &self,
        scene: usize,
        load: usize,
        contact: &Contact,
        further: &[(&'static str, &[f64])],
    ) -> Result<(), FileError> {
        let stage = &self.recording.stages[scene];
        self.write(|stream| {
            self.turn_to(stream, load)?;
            stream.log(stage.description(), &stage.described(&Stage::result(contact, &Reading::from(contact)), ""))?;
            if stage.what.has_planes() {
                stage.log_caption(stream, &self.captions[load])?;
            }
            let fields = FrameFields::from_contact(contact).with_further(further);
            let extent = stage.extent(&fields);
            self.widen(scene, extent);
            stage.log_frame(stream, &fields)?;
            stage.log_contact(stream, contact)?;
            if scene == 0 {
                self.follow_patches(stream, load, contact)?;
            }
            let Some(patches) = &stage.patches else { return Ok(()) };
            patches.log(stream, (load, &self.axis), &fields)
        })
    }

    /// Records a state again, where its pictures cannot be stretched to the reach of all states: after all of them, in their order.
    ///
    /// # Errors
    /// [`FileError::Write`] if writing fails.
    ///
    /// # Panics
    /// If there is no such scene or state.
    pub fn redraw(&self, scene: usize, load: usize, contact: &Contact) -> Result<(), FileError> {
        let all = self.progress().extents[scene].clone();
        if all.apart <= 0.0 {
            return Ok(());
        }
        self.write(|stream| {
            self.set_time(stream, load);
            self.recording.stages[scene].redraw(stream, &FrameFields::from_contact(contact), &all)
        })
    }

    /// Records by `log`; it is written soon, within 0.2 s.
    fn write(&self, log: impl FnOnce(&RecordingStream) -> RecordingStreamResult<()>) -> Result<(), FileError> {
        self.recording.log(log)?;
        self.recording.check()
    }

    fn widen(&self, scene: usize, extent: FieldExtent) {
        let own = &mut self.progress().extents[scene];
        *own = std::mem::replace(own, FieldExtent::NONE).and(extent);
    }

    /// Records what happened to the contact patches since the load before. They are followed no longer if it was not recorded.
    fn follow_patches(&self, stream: &RecordingStream, load: usize, contact: &Contact) -> RecordingStreamResult<()> {
        let Some(tree) = &self.recording.stages[0].tree else { return Ok(()) };
        let patches = &mut self.progress().patches;
        match patches.as_mut().filter(|patches| patches.states.len() == load) {
            Some(patches) => {
                patches.add(contact);
                tree.log(stream, patches)
            }
            None => {
                *patches = None;
                Ok(())
            }
        }
    }

    /// Ends the recording of a history, as [`LoadRecording::finish`] does. Of its curves those have charts that change, in the `order` of
    /// their numbers.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish_states(mut self, order: &[usize]) -> Result<(), FileError> {
        self.axis = self.axis.settled();
        let mut charts = std::mem::take(&mut self.progress().charts);
        charts.retain(|chart| chart.is_shown() && chart.place_among(order).is_some());
        charts.sort_by_key(|chart| chart.place_among(order));
        let is_shown = |number: &usize| charts.iter().any(|chart| chart.place_among(&[*number]).is_some());
        self.curves.show(&order.iter().copied().filter(is_shown).collect::<Vec<_>>());
        let Self { recording: Recording { stages, options, .. }, curves, .. } = &self;
        fit_charts(stages, &mut charts, curves, options.window);
        charts.iter_mut().for_each(Chart::settle_loads);
        self.progress().charts = charts;
        self.recording.write(|stream| self.send_layout(stream))?;
        self.finish()
    }

    /// Fits axes and colours to the contacts, writes what is left, and the index of the file.
    ///
    /// # Errors
    /// [`FileError::Write`] if that fails.
    pub fn finish(self) -> Result<(), FileError> {
        self.recording.write(|stream| self.settle(stream))?;
        self.recording.finish()
    }

    fn settle(&self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        let turn = |to: &RecordingStream, load: usize| self.set_time(to, load);
        let LoadsSoFar { extents, charts, patches, .. } = &mut *self.progress();
        let tree = self.recording.stages.first().and_then(|stage| stage.tree.as_ref());
        if let (Some(tree), Some(patches)) = (tree, patches) {
            tree.settle(stream, &turn, patches)?;
        }
        for (stage, extent) in self.recording.stages.iter().zip(extents).filter(|(_, it)| **it != FieldExtent::NONE) {
            stage.settle(stream, extent)?;
            if let Some(patches) = &stage.patches {
                patches.settle(stream, &turn, &self.axis)?;
            }
        }
        charts.iter_mut().try_for_each(|chart| chart.settle(stream, &turn))
    }

    fn log_static(&self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { recording, figure, curves, .. } = self;
        self.send_layout(stream)?;
        curves.log_static(stream)?;
        self.progress().charts.iter().try_for_each(|chart| chart.log_static(stream))?;
        let value = with_unit(&self.axis.name, &self.axis.unit);
        stream.log_static(VALUE, &SeriesLines::new().with_names([value.as_str()]))?;
        if let Some(figure) = figure {
            figure.log_static(stream)?;
        }
        recording.stages.iter().try_for_each(|stage| stage.log_static(stream))
    }

    fn send_layout(&self, stream: &RecordingStream) -> RecordingStreamResult<()> {
        let Self { recording, figure, curves, .. } = self;
        send_loads(&recording.stages, figure.as_ref(), &self.progress().charts, curves, self.timeline.name(), stream)
    }

    /// Sets the time of a stream to that of a load.
    fn set_time(&self, stream: &RecordingStream, load: usize) {
        stream.set_time_sequence(self.timeline.name(), load as i64 + 1);
        self.times.turn(stream, load);
    }

    /// Sets the time to a load; at its first use caption and cursor are recorded.
    fn turn_to(&self, stream: &RecordingStream, load: usize) -> RecordingStreamResult<()> {
        self.set_time(stream, load);
        if !self.progress().loads.insert(load) {
            return Ok(());
        }
        if let Some(figure) = &self.figure {
            figure.log_cursor(stream, load, &self.captions[load])?;
        }
        if let Some(value) = self.axis.values.get(load).filter(|value| value.is_finite()) {
            stream.log(VALUE, &Scalars::single(*value))?;
        }
        stream.log(TEXT, &self.text(load, ""))
    }

    /// The load and its numbers, above what the recording is about.
    fn text(&self, load: usize, table: &str) -> TextDocument {
        let (caption, number, description) = (&self.captions[load], load + 1, &self.description);
        let place = match &self.timeline {
            Timeline::Loads => format!("Load {number} of {}", self.captions.len()),
            Timeline::States(_) => format!("State {number}"),
        };
        TextDocument::from_markdown(format!("# {caption}\n\n{place}.\n\n{table}\n\n{description}"))
    }

    fn progress(&self) -> MutexGuard<'_, LoadsSoFar> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
