//! A sweep of the load from first touch to full contact: a list of loads that ends where the contact is full.

use super::hand::fast_solver;
use super::knobs::Knobs;
use super::motion::Motion;
use super::report::{ExactNumbers, SweepPoint, SweepReport, file_stem};
use super::section::Section;
use super::session::Turn;
use super::session_recording::SessionRecording;
use super::tape;
use super::theories::{exact, is_rough_flat, persson};
use crate::contact::{Each, Failure, Load, Observables, Observer, Problem, State, Step};
use crate::error::{HistoryError, ProblemError};
use crate::job::{HistoryOutcome, Job, JobRun, Pass, Watcher};
use crate::setup::{Flow, Method, Setup};
use crate::theory;
use std::ops::ControlFlow;

/// Loads of a sweep: first value of `p*`, loads per decade, and last value, unless contact is full before.
const FIRST: f64 = 1e-4;
const LAST: f64 = 1e2;
const PER_DECADE: f64 = 12.0;
/// Relative area from which the contact counts as full.
const FULL: f64 = 0.9999;
/// With fewer nodes in contact than this, the numbers are not accurate.
const FEWEST_NODES: usize = 4;

/// Solves one load after the other, each from the previous contact, until the contact is full or the turn is over.
pub(crate) fn run(turn: Turn<'_>, knobs: Knobs, setup: Setup) -> Result<(), Failure> {
    let loads: Vec<f64> = loads().collect();
    let solver = fast_solver(&setup).name();
    let problem = setup.problem()?;
    let surface = setup.surface.title(problem.surface().grid());
    let [motion, for_files] = knobs.motion_in_words();
    let report = SweepReport {
        id: format!("sweep-{}", turn.number),
        file_stem: file_stem(&surface, &format!("sweep{for_files}"), solver),
        title: format!("{surface}, load sweep{motion}"),
        knobs,
        ended: false,
        points: Vec::new(),
    };
    let first = exact(&setup, &at_load(&problem, FIRST)?);
    let setup = under_loads(setup, &loads);
    // pictures have room for this load
    let heaviest = at_load(&problem, heaviest(&loads))?;
    let run = JobRun { title: Some(report.title.clone()), problem: Some(heaviest), ..JobRun::new(setup.clone()) };
    let (id, file_stem) = (report.id.clone(), report.file_stem.clone());
    let job = Job::from_run(run).keeping_last(true);
    let job = tape::swept(job, (&id, &report.title), first, turn.view(), |live| {
        turn.keep(SessionRecording::new(&id, &file_stem, live));
    })?;
    let mut collector =
        SweepCollector { turn, setup: &setup, report, loads: &loads, seen: 0, row: None, motion: Motion::default() };
    collector.publish();
    let solved = job.run(&mut collector);
    collector.report.ended = true;
    let SweepCollector { report, motion, .. } = collector;
    turn.finish_sweep(report, motion);
    match solved?.solved.into_iter().find_map(|it| it.history) {
        Some(HistoryOutcome { failure: Some(failure), .. }) => Err(failure.into()),
        Some(HistoryOutcome { ended: Some(error), .. }) if !matches!(error, HistoryError::Stopped) => Err(error.into()),
        _ => Ok(()),
    }
}

/// The setup under the loads of a sweep, solved by the fastest solver. What flows and what would slip is not asked for.
fn under_loads(setup: Setup, loads: &[f64]) -> Setup {
    let solver = if setup.sliding.is_some() { setup.solver } else { Method::Multilevel {} };
    let setup = Setup { solver, flow: Flow::default(), friction: None, ..setup };
    setup.under_loads(loads.iter().map(|load| Load::ReducedPressure(*load)).collect())
}

fn loads() -> impl Iterator<Item = f64> {
    let steps = (PER_DECADE * (LAST / FIRST).log10()).round() as i32;
    (0..=steps).map(|i| FIRST * 10f64.powf(f64::from(i) / PER_DECADE))
}

/// The load that the pictures have room for: contact is full there, if the surface is rough.
fn heaviest(loads: &[f64]) -> f64 {
    let is_full = |load: &f64| theory::persson::relative_area(*load) >= FULL;
    loads.iter().copied().find(is_full).unwrap_or(LAST)
}

fn at_load(problem: &Problem, load: f64) -> Result<Problem, ProblemError> {
    problem.clone().with_load(Load::ReducedPressure(load))
}

/// Collects what the page shows of a running sweep, and ends it when the contact is full.
struct SweepCollector<'a> {
    turn: Turn<'a>,
    setup: &'a Setup,
    report: SweepReport,
    loads: &'a [f64],
    /// The number of contacts so far.
    seen: usize,
    /// The row of the sections, in which contact began.
    row: Option<usize>,
    motion: Motion,
}

impl Watcher for SweepCollector<'_> {
    fn observer(&mut self, _: Pass<'_>) -> Box<dyn Observer + '_> {
        let (turn, is_full) = (self.turn, self.is_full());
        let goes_on = move || turn.goes_on() && !is_full;
        Box::new(Each(move |_: &Step<'_>| if goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }))
    }

    /// Reports a contact if it is more than a few nodes.
    fn state(&mut self, _: usize, state: &State) {
        let (number, contact) = (self.seen, &state.contact);
        self.seen += 1;
        let Some(&load) = self.loads.get(number).filter(|_| contact.counted().contact_nodes >= FEWEST_NODES) else {
            return;
        };
        self.report.points.push(SweepPoint {
            number: number + 1,
            load,
            observables: Observables::new(contact),
            persson: is_rough_flat(self.setup).then(|| persson(contact)),
            exact: exact(self.setup, &contact.problem).as_ref().map(ExactNumbers::from),
        });
        let row = *self.row.get_or_insert_with(|| contact.highest_row());
        self.motion.add_load(number + 1, Section::from_load(contact, row));
        self.publish();
    }
}

impl SweepCollector<'_> {
    /// Whether the last contact is full.
    fn is_full(&self) -> bool {
        self.report.points.last().is_some_and(|point| point.observables.relative_area >= FULL)
    }

    fn publish(&self) {
        self.turn.update_report(|news| news.sweep = Some(self.report.clone()));
    }
}
