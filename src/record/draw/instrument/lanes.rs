//! What a solver did, as lanes over the steps.

use crate::contact::{Contact, Decision, Step, Work};
use crate::diagnosis::{ContactChange, Diagnosis, History};
use crate::plot::{Align, AxesFrame, Colour, Sheet, width};
use crate::record::draw::chart::observable_traces::times;
use crate::record::draw::drawing::{Drawing, Place, RunDrawing, RunStep, Subject};
use crate::record::draw::ink::canvas;
use crate::record::draw::ink::palette::{FAINT, Palette, SERIES, colour, mixed};
use crate::record::draw::ink::pane::{Pane, PaneView};
use crate::record::draw::instrument::raster::COLUMNS;
use crate::record::draw::instrument::step_image::{Passed, StepAxis, StepImage};
use crate::record::sdk::{ChannelDatatype, ImageFormat};
use rerun::archetypes::{StateChange, StateConfiguration};
use rerun::{
    AnnotationContext, AnnotationInfo, Radius, RecordingStream, RecordingStreamResult, Rgba32, SegmentationImage,
};
use strum::{EnumCount, EnumMessage, IntoEnumIterator};

/// Names of the lanes, from above.
const LANES: [&str; 3] = ["grid level", "step", "contact set"];
/// Entities of the same lanes as states, and of the end.
const STATES: [&str; 4] = ["1_grid", "2_step", "3_contact", "4_end"];
/// Nodes that enter and leave.
const CHANGES: [&str; 4] = ["same", "in", "out", "in and out"];
/// Levels that have a class of their own.
const LEVELS: u8 = 16;
/// First classes of the lanes.
const FIRST: [u8; 3] = [1, 1 + LEVELS, 1 + LEVELS + Decision::COUNT as u8];
/// Length of a swatch of the legend, and of the room before and after it, over the size of words.
const SWATCH: [f64; 3] = [1.4, 1.4, 0.4];

/// Lanes of the grid, the kind of step, and the nodes that entered or left: as an image beside the others, and as states for the
/// viewer's own lanes, on which one can point at what lasted how long.
#[derive(Clone)]
struct Lanes {
    root: String,
    image: StepImage,
}

/// The colour of a kind of step. Kinds that one solver takes have different colours.
fn colour_of(decision: Decision) -> Colour {
    match decision {
        Decision::Start => FAINT,
        Decision::SplitCompliance => SERIES[0],
        Decision::Conjugate { .. } => SERIES[1],
        Decision::Exchange | Decision::Damped => SERIES[2],
        Decision::Descend | Decision::Guarded | Decision::Coast => SERIES[3],
        Decision::WholeSet | Decision::Accelerate => SERIES[4],
        Decision::SinglePrecision | Decision::Halt => SERIES[5],
    }
}

/// What the lanes show, of every step.
struct LaneRows {
    /// Classes of the lanes; none where nothing is known.
    classes: History<[u8; LANES.len()]>,
    contact: u8,
    last: [String; STATES.len()],
    changes: [Vec<(Work, String)>; STATES.len()],
}

impl Lanes {
    fn new(root: &str, palette: &'static Palette) -> Self {
        Self { root: format!("{root}/decisions"), image: StepImage::new(format!("{root}/lanes"), palette, None, false) }
    }

    /// All classes with their lane, name and colour.
    fn classes(&self) -> impl Iterator<Item = (u8, usize, String, Colour)> {
        let palette = self.image.palette;
        let share = |level: u8| f64::from(level) / f64::from(LEVELS - 1);
        let levels = (0..LEVELS)
            .map(move |level| (FIRST[0] + level, 0, format!("{level}"), mixed(SERIES[1], FAINT, share(level).sqrt())));
        let kinds = Decision::iter()
            .zip(0..)
            .map(|(decision, kind)| (FIRST[1] + kind, 1, decision.name().to_owned(), colour_of(decision)));
        let colours = [FAINT, palette.contact, SERIES[1], SERIES[0]];
        let changes = CHANGES
            .iter()
            .zip(0..)
            .map(move |(name, kind)| (FIRST[2] + kind, 2, (*name).to_owned(), colours[usize::from(kind)]));
        levels.chain(kinds).chain(changes)
    }

    /// Records the names and colours of classes and states.
    fn log_names(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        let class = |(id, lane, name, rgb): (u8, usize, String, Colour)| AnnotationInfo {
            id: u16::from(id),
            label: Some(format!("{}: {name}", LANES[lane]).into()),
            color: Some(colour(rgb).0),
        };
        let clear = AnnotationInfo { id: 0, label: None, color: Some(Rgba32::from_unmultiplied_rgba(0, 0, 0, 0)) };
        let classes = self.classes().map(class).chain([clear]);
        to.log_static(self.image.root.as_str(), &AnnotationContext::new(classes))?;
        for (lane, state) in STATES.iter().enumerate().take(LANES.len()).skip(1) {
            let classes: Vec<_> = self.classes().filter(|(_, of, ..)| *of == lane).collect();
            let labels = classes.iter().map(|(.., name, _)| {
                let decision = Decision::iter().find(|decision| lane == 1 && decision.name() == name);
                decision.and_then(|decision| decision.get_message()).unwrap_or(name)
            });
            let configuration = StateConfiguration::new()
                .with_values(classes.iter().map(|(.., name, _)| name.as_str()))
                .with_labels(labels)
                .with_colors(classes.iter().map(|(.., rgb)| colour(*rgb)));
            to.log_static(format!("{}/{state}", self.root), &configuration)?;
        }
        Ok(())
    }

    fn rows(&self) -> LaneRows {
        let classes = History::new(COLUMNS, |first: &mut [u8; LANES.len()], next: [u8; LANES.len()]| {
            // the rarer kinds of steps come later in their list; nodes that enter and nodes that leave add up
            first[1] = first[1].max(next[1]);
            first[2] = FIRST[2] + ((first[2].max(FIRST[2]) - FIRST[2]) | (next[2].max(FIRST[2]) - FIRST[2]));
        });
        LaneRows { classes, contact: 0, last: Default::default(), changes: Default::default() }
    }

    /// Records the image of the steps so far with its legend.
    fn log(&self, to: &RecordingStream, rows: &LaneRows) -> RecordingStreamResult<()> {
        let columns = rows.classes.columns();
        let steps = StepAxis { columns: columns.len(), per_column: rows.classes.per_column() };
        // each lane has a free row below it, for its legend
        let lane =
            |row: usize| columns.iter().map(move |column| if row.is_multiple_of(2) { column[row / 2] } else { 0 });
        let height = 2 * LANES.len();
        let bytes: Vec<u8> = (0..height).flat_map(lane).collect();
        let format = ImageFormat::depth([steps.columns as u32, height as u32], ChannelDatatype::U8);
        let image = SegmentationImage::update_fields().with_buffer(bytes).with_format(format).with_opacity(1.0);
        self.image.log(to, &image, height, steps)?;
        self.log_legend(to, columns, &self.image.frame(steps))
    }

    /// Records the names of the lanes, and of the classes that were met, each behind a swatch of its colour.
    fn log_legend(
        &self,
        to: &RecordingStream,
        columns: &[[u8; LANES.len()]],
        frame: &AxesFrame,
    ) -> RecordingStreamResult<()> {
        let pitch = frame.size[1] / LANES.len() as f64;
        let middle = |lane: usize| (lane as f64 + 0.75) * pitch;
        let mut words = Sheet::default();
        let mut swatches = Vec::new();
        for (lane, name) in LANES.iter().enumerate() {
            words.words(name, [0.0, middle(lane)], frame.text, Align::Left);
        }
        let mut ends = LANES.map(|name| width(name, frame.text));
        let is_met = |id: u8, lane: usize| columns.iter().any(|column| column[lane] == id);
        let [before, length, after] = SWATCH.map(|length| length * frame.text);
        for (_, lane, name, rgb) in self.classes().filter(|(id, lane, ..)| is_met(*id, *lane)) {
            let from = ends[lane] + before;
            let swatch = [from, from + length].map(|x| [x as f32, middle(lane) as f32]);
            swatches.push((swatch.to_vec(), colour(rgb), Radius::new_ui_points(4.0)));
            let start = from + length + after;
            ends[lane] = start + width(&name, frame.text);
            words.words(&name, [start, middle(lane)], frame.text, Align::Left);
        }
        to.log_static(format!("{}/legend/swatches", self.image.root), &canvas::strips(swatches))?;
        to.log_static(format!("{}/legend/words", self.image.root), &canvas::written(self.image.palette, &words))
    }

    /// Sends the states that changed so far.
    fn flush(&self, to: &RecordingStream, rows: &mut LaneRows) -> RecordingStreamResult<()> {
        for (state, changes) in STATES.iter().zip(&mut rows.changes).filter(|(_, changes)| !changes.is_empty()) {
            let names = changes.iter().map(|(_, name)| name.as_str());
            let states = StateChange::update_fields().with_state(names).columns_of_unit_batches()?;
            to.send_columns(format!("{}/{state}", self.root), times(changes), states)?;
            changes.clear();
        }
        Ok(())
    }
}

impl LaneRows {
    /// Adds a step.
    fn add(&mut self, step: &Step<'_>, level: usize, change: ContactChange) {
        let [ny, nx] = step.problem().surface().grid().shape();
        let grid = if ny == 1 { nx.to_string() } else { format!("{ny} x {nx}") };
        let kind = step.decision().map(Decision::name);
        self.enter(0, step.work(), &grid);
        self.enter(1, step.work(), kind.unwrap_or_default());
        if step.phase().inner == 0 {
            let bits = u8::from(change.entered > 0) + 2 * u8::from(change.left > 0);
            self.contact = FIRST[2] + bits;
            self.enter(2, step.work(), CHANGES[usize::from(bits)]);
        }
        let kind = kind.and_then(|kind| Decision::iter().position(|decision| decision.name() == kind));
        let kind = kind.map_or(0, |kind| FIRST[1] + kind as u8);
        self.classes.add([FIRST[0] + (level as u8).min(LEVELS - 1), kind, self.contact]);
    }

    /// Adds the end of the run.
    fn end(&mut self, contact: &Contact) {
        self.enter(3, contact.work, &contact.status.to_string());
    }

    fn enter(&mut self, lane: usize, work: Work, state: &str) {
        if self.last[lane] != state {
            self.last[lane] = state.into();
            self.changes[lane].push((work, state.into()));
        }
    }
}

/// The drawing of the decisions of a solver.
pub(crate) fn draw(subject: &Subject<'_>) -> Option<Box<dyn Drawing>> {
    Some(Box::new(Lanes::new(subject.root, subject.palette)))
}

impl Drawing for Lanes {
    fn panes(&self) -> Vec<(Place, Pane)> {
        let panes = [self.image.pane("What the solver did"), PaneView::lanes("As states", &self.root)];
        panes.map(|pane| (Place::RunDecisions, pane)).into()
    }

    fn fit(&mut self, size: &dyn Fn(&str) -> Option<[f64; 2]>) {
        self.image.fit(size);
    }

    fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.log_names(to)?;
        self.image.log_cursor_style(to)
    }

    fn run(&self) -> Option<Box<dyn RunDrawing>> {
        Some(Box::new(LanesOfRun { lanes: self.clone(), rows: self.rows(), passed: Passed::default() }))
    }
}

/// The lanes of one run.
struct LanesOfRun {
    lanes: Lanes,
    rows: LaneRows,
    passed: Passed,
}

impl RunDrawing for LanesOfRun {
    fn add(&mut self, step: &RunStep<'_, '_>) {
        let Some(diagnosis) = step.diagnosis else { return };
        self.rows.add(step.step, step.level, diagnosis.change());
        self.passed.add(step.step.work());
    }

    fn show(&mut self, to: &RecordingStream, _: &Diagnosis) -> RecordingStreamResult<()> {
        self.lanes.log(to, &self.rows)
    }

    fn flush(&mut self, to: &RecordingStream) -> RecordingStreamResult<()> {
        self.lanes.image.send_cursor(to, &mut self.passed)?;
        self.lanes.flush(to, &mut self.rows)
    }

    fn end(&mut self, contact: &Contact) {
        self.rows.end(contact);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_of_steps_of_one_solver_have_different_colours() {
        let solvers: [&[&str]; 4] = [
            &["start", "conjugate", "whole-set", "single-precision", "split-compliance", "guarded"],
            &["start", "conjugate", "exchange", "descend"],
            &["start", "damped"],
            &["start", "coast", "accelerate", "halt"],
        ];
        for kinds in solvers {
            let of_solver: Vec<Decision> =
                Decision::iter().filter(|decision| kinds.contains(&decision.name())).collect();
            assert_eq!(of_solver.len(), kinds.len());
            for (number, one) in of_solver.iter().enumerate() {
                assert!(of_solver[..number].iter().all(|other| colour_of(*other) != colour_of(*one)), "{one:?}");
            }
        }
        assert!(Decision::iter().all(|decision| solvers.iter().any(|kinds| kinds.contains(&decision.name()))));
    }
}
