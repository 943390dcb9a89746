//! The page with the module as a static site: the solver runs in the browser, and lessons have recordings that were made beforehand.

use super::packed;
use super::page::Page;
use super::worker;
use crate::contact::{Failure, Quantity};
use crate::digest::fnv1a;
use crate::explore::{Knobs, Lesson, LessonStep, MOST_POINTS_OF_MODULE, Refusal, RunKind, Session, Stock};
use crate::files::fill_folder;
use crate::record::Output;
use crate::setup::Theme;
use serde_json::{Value, json};
use std::fs::{File, create_dir, write};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// The texts that the licences of all libraries and fonts in the program ask to hand on with it. `.ci/licences` makes the file.
pub const LICENCES: &str = include_str!("../../assets/licences.txt");

/// The most recordings of a site.
const MOST_RUNS: usize = 1024;
/// Longest time between two questions whether to go on.
const PATIENCE: Duration = Duration::from_millis(100);
/// Bytes of a recording that are copied at once.
const PIECE: u64 = 1 << 20;

/// Interval of steps at which fields are recorded, which makes the recordings of the lessons half as large.
const EVERY: usize = 4;

/// A run with a recording: whether the load is swept, and the state of the knobs. Each is recorded on both grounds, as the page has
/// either.
type SiteRun = (RunKind, Knobs);

/// A page that is to become a site.
pub struct SiteExport {
    lessons: Vec<Lesson>,
    start: Knobs,
    recorded: Vec<SiteRun>,
}

impl SiteExport {
    /// The page that begins with a state, and its lessons, with recordings of all states that they offer if these are wanted.
    ///
    /// # Errors
    /// For no lesson, for a state that is too large for the module, and for too many recordings.
    pub fn new(start: Knobs, lessons: Vec<Lesson>, is_recorded: bool) -> Result<Self, Refusal> {
        if lessons.is_empty() {
            return Err("there is no lesson to export: give at least one".into());
        }
        let mut runs: Vec<SiteRun> = Vec::new();
        for lesson in &lessons {
            for run in lesson.steps.iter().flat_map(of_step) {
                check_size(&run.1, &lesson.name)?;
                if !runs.contains(&run) {
                    runs.push(run);
                }
            }
        }
        if is_recorded && runs.len() > MOST_RUNS {
            let count = runs.len();
            return Err(Refusal::from(format!(
                "these lessons have {count} states to record: reduce them to at most {MOST_RUNS}"
            )));
        }
        let themed = |theme| runs.iter().map(move |(kind, knobs)| (*kind, knobs.clone().with_theme(theme)));
        let recorded = [Theme::Dark, Theme::Light].into_iter().filter(|_| is_recorded).flat_map(themed).collect();
        Ok(Self { start, recorded, lessons })
    }

    /// Number of its recordings, on both grounds.
    pub fn recordings(&self) -> usize {
        self.recorded.len()
    }

    /// Writes the site into a folder, which is new or empty. If this fails, the folder is as it was before. `goes_on`
    /// is called now and then with the number of recordings that are complete.
    ///
    /// # Errors
    /// For a folder that cannot be created, for a run that cannot be solved, and for an interruption.
    pub fn write(&self, folder: &Path, goes_on: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Result<(), Failure> {
        let page = Page::new("explore", String::new())?;
        let (session, solver) = worker::start(Stock { every: Some(EVERY), ..Stock::default() }, 0);
        let written = fill_folder(folder, |draft| {
            let (site, section) = self.site(&session, draft, goes_on)?;
            let site = format!("\"use strict\";\nconst SITE = {site};\n");
            let section = packed::script_of("FIRST_SECTION", &section)?;
            let lessons = packed::script_of("LESSONS", &json!(self.lessons))?;
            let files = page.files(!self.recorded.is_empty());
            let own = [("site.js", site.into()), ("section.js", section.into()), ("lessons.js", lessons.into())];
            let files: Vec<_> = files.chain(own).collect();
            files.iter().try_for_each(|(name, bytes)| write(draft.join(name), bytes))?;
            write(draft.join("licences.txt"), LICENCES)?;
            let mark = format!("{:016x}", fnv1a(files.iter().map(|(_, bytes)| bytes.as_ref())));
            Ok(write(draft.join("offline.js"), page.offline(&mark, files.iter().map(|(name, _)| *name)))?)
        });
        session.close();
        solver.join().ok(); // a solver that failed has said so
        written
    }

    /// All that the page would ask a server for before its first picture, and the section of that; and the recordings, which are written.
    fn site(
        &self,
        session: &Session,
        folder: &Path,
        goes_on: &mut dyn FnMut(usize) -> ControlFlow<()>,
    ) -> Result<(Value, Value), Failure> {
        let Self { start, recorded, .. } = self;
        let first = solve(session, RunKind::Solve, start, &mut || goes_on(0))?;
        let first = session.recording(&first).and_then(|recording| recording.solved()).ok_or("a run is missing")?;
        let (first, section) = (json!({ "run": first.report }), rounded(json!(first.last.section())));
        if !recorded.is_empty() {
            create_dir(folder.join("run"))?;
        }
        let mut runs = Vec::new();
        for (done, (kind, knobs)) in recorded.iter().enumerate() {
            let id = solve(session, *kind, knobs, &mut || goes_on(done))?;
            let recording = session.recording(&id).ok_or("a recording is missing")?;
            copy(&recording.live, &mut File::create(folder.join("run").join(format!("{id}.rrd")))?)?;
            runs.push(json!({ "id": id, "is_sweep": *kind == RunKind::Sweep, "knobs": knobs }));
        }
        let observables: Vec<Value> = Quantity::all().map(observable).collect();
        Ok((json!({ "start": start, "observables": observables, "first": first, "recorded": runs }), section))
    }
}

/// The numbers of a picture to five digits, which are more than a screen shows.
fn rounded(value: Value) -> Value {
    match value {
        Value::Array(values) => values.into_iter().map(rounded).collect(),
        Value::Object(fields) => fields.into_iter().map(|(name, value)| (name, rounded(value))).collect(),
        Value::Number(number) if number.is_f64() => {
            number.as_f64().and_then(|it| format!("{it:.4e}").parse::<f64>().ok()).into()
        }
        other => other,
    }
}

/// The row of a quantity without its sentence, of which the page has one of its own.
fn observable(quantity: Quantity) -> Value {
    let mut row = json!(quantity.row());
    if let Some(row) = row.as_object_mut() {
        row.remove("sentence");
    }
    row
}

/// The runs of a step: all states that can be turned to, and the sweep if the load is swept.
fn of_step(step: &LessonStep) -> Vec<SiteRun> {
    let states = step.states().iter().map(|knobs| (RunKind::Solve, knobs.clone()));
    states.chain(step.sweep.then(|| (RunKind::Sweep, step.knobs.clone()))).collect()
}

/// Refuses a state that is too large for the module.
fn check_size(knobs: &Knobs, lesson: &str) -> Result<(), Refusal> {
    let grid = knobs.setup()?.check()?;
    let most = MOST_POINTS_OF_MODULE[usize::from(!grid.is_line())];
    if grid.len() <= most {
        return Ok(());
    }
    let points = grid.len();
    Err(Refusal::from(format!(
        "a step of the lesson {lesson} has {points} points, but the solver in a browser takes at most {most}: give fewer `points`"
    )))
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
        let report = session.report_after(revision, PATIENCE);
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
