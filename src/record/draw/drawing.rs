//! Drawings: the parts of a recording.

use super::fields::{FieldExtent, FrameFields};
use super::ink::palette::Palette;
use super::ink::pane::Pane;
use super::plane::Plane;
use crate::contact::{Contact, Forecast, Phase, Step};
use crate::diagnosis::Diagnosis;
use crate::grid::Grid;
use crate::record::options::Options;
use crate::record::scene::Scene;
use crate::setup::Part;
use rerun::{RecordingStream, RecordingStreamResult};

/// The input of a drawing: a scene, the expected ranges of its values, and the options of the recording.
pub(crate) struct Subject<'a> {
    pub scene: &'a Scene<'a>,
    pub forecast: Forecast,
    /// Root of the entities of the scene, with a leading `/`.
    pub root: &'a str,
    /// Options, whose parts are those that the scene can show.
    pub options: &'a Options,
    pub palette: &'static Palette,
    /// The canvas that the flat pictures of the scene share.
    pub plane: &'a Plane,
    /// The place of the scene among several.
    pub place: Option<usize>,
}

impl Subject<'_> {
    pub(crate) fn grid(&self) -> &Grid {
        self.scene.problem.surface().grid()
    }

    /// Whether a part is recorded.
    pub(crate) fn has(&self, part: Part) -> bool {
        self.options.what.has(part)
    }
}

/// A part of the recording of a scene.
///
/// A drawing is created before the solve, fitted to its panes, and its static parts are recorded. Then it draws the
/// fields of the selected frames. At the end its axes are fitted to the data.
pub(crate) trait Drawing: Send + Sync {
    /// The panes that it needs, and their places.
    fn panes(&self) -> Vec<(Place, Pane)>;

    /// Gives its pictures the proportions of their panes, whose width and height in points `size` finds by the root of a picture.
    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>);

    /// Records the static parts: axes, styles, names.
    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()>;

    /// Records a state at the current time.
    fn log_frame(&self, _to: &RecordingStream, _fields: &FrameFields<'_>) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// Records what is found for a contact and not for the steps before it, at the current time.
    fn log_contact(&self, _to: &RecordingStream, _contact: &Contact) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// Records the pressure of an earlier solve along the same line, on any number of nodes.
    fn log_earlier(&self, _to: &RecordingStream, _pressure: &[f64]) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// The ranges of the axes that are needed to show a state.
    fn extent(&self, _fields: &FrameFields<'_>) -> FieldExtent {
        FieldExtent::NONE
    }

    /// Fits axes and scales to the data, for all times.
    fn settle(&self, _to: &RecordingStream, _extent: &FieldExtent) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// Records a state again at the current time, where its picture cannot be stretched to the reach of all states.
    fn redraw(
        &self,
        _to: &RecordingStream,
        _fields: &FrameFields<'_>,
        _all: &FieldExtent,
    ) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// Its collector of all steps of a run, if it draws more than frames.
    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        None
    }
}

/// The place of a pane in the layout of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// A row or cell of its own.
    Main,
    /// A field: on a surface a cell of its own, on a line beside the other fields.
    Field,
    /// A field that a history has besides pressure and gap: on a surface a cell of its own, on a line a row beside others of its kind.
    OfState,
    /// Behind all other pictures of the state.
    Further,
    /// Behind all other pictures of the state, in a higher row, as its proportions are those in space.
    Deep,
    /// Pictures of the whole run, step by step: the contact, the decisions, the wavelengths.
    RunContact,
    RunDecisions,
    RunWavelengths,
    /// Curves of the whole run beside those of its convergence.
    RunCurves,
}

/// The collector of a drawing for all steps of one run.
pub(crate) trait RunDrawing: Send {
    /// Adds a step.
    fn add(&mut self, step: &RunStep<'_, '_>);

    /// Records images of all steps so far anew.
    fn show(&mut self, _to: &RecordingStream, _diagnosis: &Diagnosis) -> RecordingStreamResult<()> {
        Ok(())
    }

    /// Sends the data that were collected since the last time.
    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()>;

    /// Adds the resulting contact.
    fn end(&mut self, _contact: &Contact) {}
}

/// A step of a run, and what is known of the run so far.
pub(crate) struct RunStep<'a, 's> {
    pub step: &'a Step<'s>,
    /// The position in the scheme of the solver, if it uses coarse grids or inner steps.
    pub phase: Option<Phase>,
    /// The grid level, 0 for the finest.
    pub level: usize,
    /// The diagnosis of the run, if a drawing needs it.
    pub diagnosis: Option<&'a Diagnosis>,
}

/// A row in the table of parts: the part, its drawing, and its size.
pub(crate) struct PartRow {
    pub part: Part,
    /// The drawing of a scene, if the part can show it.
    pub draw: fn(&Subject<'_>) -> Option<Box<dyn Drawing>>,
    pub bytes: fn(&Grid) -> Bytes,
}

/// Approximate size of a part in a recording, in bytes. Compression makes pictures smaller by up to a half, most at
/// small loads.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Bytes {
    /// What does not change, and the images of a whole run, which are recorded anew whenever the run has become twice as long.
    pub still: f64,
    /// The pictures of a frame.
    pub frame: f64,
    /// The numbers of a step.
    pub step: f64,
    /// The pictures of a contact, which steps do not have.
    pub contact: f64,
}

impl Bytes {
    /// Of a part that is drawn in frames only.
    pub(crate) fn per_frame(frame: f64) -> Self {
        Self { frame, ..Self::default() }
    }

    /// Of a part that shows a whole run.
    pub(crate) fn per_run(still: f64) -> Self {
        Self { still, ..Self::default() }
    }
}
