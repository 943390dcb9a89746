//! The lessons as a static site: everything that they show is solved in advance.

use super::facet::{FACETS, MOTION};
use super::knobs::Knobs;
use super::lesson::{Lesson, LessonStep};
use super::page::Page;
use super::refusal::Refusal;
use super::session::{RunKind, Session, Stock};
use super::session_recording::SessionRecording;
use crate::contact::{Failure, OBSERVABLES};
use crate::files::fill_folder;
use crate::record::Output;
use crate::setup::Theme;
use serde_json::{Value, json};
use std::fs::{File, create_dir, write};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// The most runs of a site.
const MOST_RUNS: usize = 1024;
/// Longest time between two questions whether to go on.
const PATIENCE: Duration = Duration::from_millis(100);
/// Bytes of a recording that are copied at once.
const PIECE: u64 = 1 << 20;

/// Interval of steps at which fields are recorded, which makes the recordings of the lessons half as large.
const EVERY: usize = 4;
/// Significant digits of the numbers in facets, which are drawn, or shown with fewer.
const DIGITS: usize = 7;

/// A run of the site: whether the load is swept, and the state of the knobs. Each is recorded on both grounds, as the page has either.
type SiteRun = (RunKind, Knobs);

/// Lessons that are to become a site.
pub struct SiteExport {
    lessons: Vec<Lesson>,
    start: Knobs,
    wanted: Vec<SiteRun>,
}

impl SiteExport {
    /// Lessons with all states that a class may turn to.
    ///
    /// # Errors
    /// For no lesson, and for too many states.
    pub fn new(lessons: Vec<Lesson>) -> Result<Self, Refusal> {
        let steps = || lessons.iter().flat_map(|lesson| &lesson.steps);
        let Some(first) = steps().next() else {
            return Err(Refusal("there is no lesson to export: give at least one".into()));
        };
        let mut wanted: Vec<SiteRun> = Vec::new();
        for run in steps().flat_map(of_step) {
            if !wanted.contains(&run) {
                wanted.push(run);
            }
        }
        if wanted.len() > MOST_RUNS {
            let count = wanted.len();
            return Err(Refusal(format!(
                "these lessons have {count} states to solve: reduce them to at most {MOST_RUNS}"
            )));
        }
        let themed = |theme| wanted.iter().map(move |(kind, knobs)| (*kind, knobs.clone().with_theme(theme)));
        let wanted = [Theme::Dark, Theme::Light].into_iter().flat_map(themed).collect();
        Ok(Self { start: first.knobs.clone(), wanted, lessons })
    }

    /// Number of its runs, on both grounds.
    pub fn runs(&self) -> usize {
        self.wanted.len()
    }

    /// Solves all states and writes the site into a folder, which is new or empty. If this fails, the folder is as it
    /// was before. `goes_on` is called now and then how many runs are solved.
    ///
    /// # Errors
    /// For a folder that cannot be created, for a run that cannot be solved, and for an interruption.
    pub fn write(&self, folder: &Path, goes_on: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Result<(), Failure> {
        let page = Page::new("explore")?;
        let (session, solver) = Session::start(Stock { every: Some(EVERY), ..Stock::default() }, 0);
        let written = fill_folder(folder, |draft| {
            page.files().try_for_each(|(name, bytes)| write(draft.join(name), bytes))?;
            create_dir(draft.join("run"))?;
            let solved = self.solve(&session, draft, goes_on)?;
            Ok(write(draft.join("solved.js"), format!("\"use strict\";\nconst SOLVED = {solved};\n"))?)
        });
        session.close();
        solver.join().ok(); // a solver that failed has said so
        written
    }

    /// Solves all states, writes their recordings and facets, and returns all else that the page asks for.
    fn solve(
        &self,
        session: &Session,
        folder: &Path,
        goes_on: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Result<Value, Failure> {
        let mut runs = Vec::new();
        for (done, (kind, knobs)) in self.wanted.iter().enumerate() {
            let id = solve(session, *kind, knobs, &mut || goes_on(done))?;
            let recording = session.recording(&id).ok_or("a recording is missing")?;
            copy(&recording.live, &mut File::create(folder.join("run").join(format!("{id}.rrd")))?)?;
            runs.push(serde_json::to_value(recording.report())?);
            let script = format!("SOLVED.facets[\"{id}\"] = {};\n", rounded(facets(&recording)));
            write(folder.join("run").join(format!("{id}.js")), script)?;
        }
        let Self { lessons, start, .. } = self;
        Ok(json!({ "start": start, "lessons": lessons, "observables": OBSERVABLES, "runs": runs, "facets": {} }))
    }
}

/// All facets of a run, or the motion of a sweep.
fn facets(recording: &SessionRecording) -> Value {
    match (recording.solved(), recording.swept()) {
        (Some(solved), _) => FACETS.iter().map(|it| (it.name.to_owned(), (it.of)(&solved))).collect(),
        (None, motion) => json!({ MOTION: motion }),
    }
}

/// The runs of a step: all states that can be turned to, and the sweep if the load is swept.
fn of_step(step: &LessonStep) -> Vec<SiteRun> {
    let states = step.states().iter().map(|knobs| (RunKind::Solve, knobs.clone()));
    states.chain(step.sweep.then(|| (RunKind::Sweep, step.knobs.clone()))).collect()
}

/// Solves one state, and returns the name of its recording.
fn solve(
    session: &Session,
    kind: RunKind,
    knobs: &Knobs,
    goes_on: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<String, Failure> {
    let mut revision = session.order(kind, knobs.clone())?;
    loop {
        let report = session.report(revision, PATIENCE);
        if let Some(fault) = report.fault {
            return Err(fault.into());
        }
        if !report.busy {
            let id = match kind {
                RunKind::Solve => report.run.map(|run| run.id),
                RunKind::Sweep => report.sweep.map(|sweep| sweep.id),
            };
            return id.ok_or_else(|| "a run gave no result".into());
        }
        if goes_on().is_break() {
            return Err("the export was interrupted: nothing was written".into());
        }
        revision = report.revision;
    }
}

/// JSON whose numbers have few digits.
fn rounded(value: Value) -> Value {
    match value {
        Value::Array(values) => values.into_iter().map(rounded).collect(),
        Value::Object(map) => map.into_iter().map(|(key, value)| (key, rounded(value))).collect(),
        Value::Number(number) if number.is_f64() => {
            let digits = format!("{:.*e}", DIGITS - 1, number.as_f64().unwrap_or_default());
            digits.parse::<f64>().map_or(Value::Null, Value::from)
        }
        value => value,
    }
}

/// Copies a recording that is complete.
fn copy(recording: &Output, file: &mut File) -> io::Result<()> {
    let mut from = 0;
    loop {
        let piece = recording.read(from, PIECE)?;
        if piece.is_empty() {
            return Ok(());
        }
        file.write_all(&piece)?;
        from += piece.len() as u64;
    }
}
