//! One solve, recorded and reported while it runs.

use super::knobs::Knobs;
use super::motion::Motion;
use super::report::{Beside, ExactNumbers, Numbers, ProcessReport, PullOffReport, RunReport, RunWarning, file_stem};
use super::section::Section;
use super::session::Turn;
use super::session_recording::{LastState, SessionRecording};
use super::step_numbers::StepNumbers;
use super::tape::{self, TapeCurves};
use crate::clock::Instant;
use crate::contact::{
    Contact, CutLayers, Failure, Load, Observer, Problem, State, StateField, Status, Step, Wish, Work,
};
use crate::error::{AdhesionError, HistoryError, SetupError, SolveError};
use crate::job::{self, HistoryOutcome, Job, JobRun, Pass, Solved};
use crate::sentence::Sentence;
use crate::setup::{LoadPath, RollingMotion, Setup, command};
use crate::surface::Surface;
use crate::theory::Exact;
use std::ops::ControlFlow;
use std::time::Duration;

/// Time between two reports of a running solve.
const INTERVAL: Duration = Duration::from_millis(60);

/// Solves the setup that the knobs describe, and the one beside it under the same mean pressure, until both are solved
/// or the turn is over.
pub(crate) fn run(turn: Turn<'_>, knobs: Knobs, setup: Setup, beside: Option<Setup>) -> Result<(), Failure> {
    let problem = setup.problem()?;
    let beside = beside.map(|beside| pressed_alike(beside, &problem)).transpose()?;
    let rank = setup.surface.rank(&setup.grid)?;
    let grid = problem.surface().grid();
    let exact = exact_of(&setup, &problem);
    let exact_beside = beside.as_ref().and_then(|(setup, problem)| exact_of(setup, problem));
    let surface = setup.surface.title(grid);
    let [load, load_for_files] = knobs.load_in_words();
    let [motion, motion_for_files] = knobs.motion_in_words();
    let title = format!("{surface}, {load}{motion}");
    let drive = setup.history_drive()?;
    let report = RunReport {
        id: format!("run-{}", turn.number),
        file_stem: file_stem(&surface, &format!("{load_for_files}{motion_for_files}"), setup.solver().name()),
        title: title.clone(),
        command: command(&setup),
        setup: setup.to_toml(),
        prepared: prepared(&setup, problem.surface())?,
        warnings: Vec::new(),
        knobs,
        process: drive.map(ProcessReport::from),
        ended: false,
        numbers: None,
        exact: exact.as_ref().map(ExactNumbers::from),
        pull_off: PullOffReport::new(&setup, &problem),
        beside: beside.as_ref().map(|(setup, problem)| {
            let title = setup.surface.title(problem.surface().grid());
            Beside { title, numbers: None }
        }),
        section: None,
    };
    let (id, file_stem) = (report.id.clone(), report.file_stem.clone());
    let posed = |setup: &Setup, problem| JobRun { problem: Some(problem), ..JobRun::new(setup.clone()) };
    let job = Job::from_run(JobRun { title: Some(title), ..posed(&setup, problem) });
    let job = beside.iter().fold(job, |job, (setup, problem)| {
        job.beside(JobRun { name: "beside".into(), ..posed(setup, problem.clone()) })
    });
    let job = tape::recorded(job, &id, turn.view(), |live| {
        turn.keep(SessionRecording::new(&id, &file_stem, live));
        turn.update_report(|news| news.run = Some(report));
    });
    let mut watch = RunCollector {
        turn,
        reported: Instant::now(),
        curves: tape::curves(&id),
        steps: StepNumbers::new(drive),
        ends: Default::default(),
        motion: Motion::default(),
        work: [Work::default(); 2],
    };
    let solved = job.run(&mut watch)?.solved;
    let doubts = doubts(&solved);
    turn.update_report(|news| news.run.iter_mut().for_each(|run| run.warnings.clone_from(&doubts)));
    let contacts = solved.into_iter().zip(watch.work).map(|(solved, work)| last_contact(solved, work));
    let mut contacts = contacts.collect::<Result<Vec<_>, _>>()?.into_iter();
    let (contact, other) = (contacts.next().expect("a job solves its first run"), contacts.next());
    if let Some(failure) = [Some(&contact), other.as_ref()].into_iter().flatten().find_map(|it| it.failure.clone()) {
        return Err(SolveError::Observer(failure).into());
    }
    let RunCollector { curves, steps, motion, ends: [own, beside], .. } = watch;
    let last = |contact, (fields, layers), exact| LastState { contact, fields, layers, exact };
    let other = other.map(|contact| last(contact, beside, exact_beside));
    turn.finish(rank, last(contact, own, exact), other, curves, (steps, motion));
    Ok(())
}

/// The exact solution of a problem under its mean pressure, where there is one.
fn exact_of(setup: &Setup, problem: &Problem) -> Option<Exact> {
    setup.exact(problem.surface().grid(), problem.mean_pressure()?)
}

/// The contact of a run, or of the last state of a history with the work of all of them.
fn last_contact(solved: Solved, work: Work) -> Result<Contact, Failure> {
    let Solved { contact, history, .. } = solved;
    let Some(HistoryOutcome { ended, failure, .. }) = history else { return Ok(contact) };
    match (failure, ended) {
        (Some(failure), _) => Err(failure.into()),
        (None, None) => Ok(contact.with_work(work)),
        // a history that was given up ends with a state that may have its certificate, but is not the one that was asked for
        (None, Some(HistoryError::Stopped | HistoryError::Adhesion(AdhesionError::Stopped))) => {
            let mut contact = contact.with_work(work);
            contact.status = Status::StoppedByObserver;
            Ok(contact)
        }
        (None, Some(error)) => Err(error.into()),
    }
}

/// A setup under the mean pressure of a problem, along the same path of them, and its problem. Where gaps are prescribed, it is as it was.
fn pressed_alike(setup: Setup, other: &Problem) -> Result<(Setup, Problem), Failure> {
    if !setup.load.is_pressure() {
        let problem = setup.problem()?;
        return Ok((setup, problem));
    }
    let unit = other.rms_gradient() * other.contact_modulus();
    let in_pascals = |loads: Vec<f64>| loads.into_iter().map(|load| load * unit).collect();
    let path = setup.path.map(|it| LoadPath { load: in_pascals(it.load), tangential: in_pascals(it.tangential), ..it });
    let rolling = setup.rolling.map(|it| RollingMotion { tangential: in_pascals(it.tangential), ..it });
    let setup = Setup { load: Load::MeanPressure(other.expected_mean_pressure()), path, rolling, ..setup };
    let problem = setup.problem()?;
    Ok((setup, problem))
}

/// Reasons to doubt the surfaces and contacts, those of the surface beside among them.
fn doubts(solved: &[Solved]) -> Vec<RunWarning> {
    let of_run = |(i, it): (usize, &Solved)| -> Vec<RunWarning> {
        it.warnings().into_iter().map(|warning| RunWarning { is_beside: i > 0, warning }).collect()
    };
    solved.iter().enumerate().flat_map(of_run).collect()
}

/// The effect of each preparation step.
fn prepared(setup: &Setup, surface: &Surface) -> Result<Vec<Sentence>, SetupError> {
    let of = |file| Ok(setup.surface.prepared(file, surface.grid())?.effects);
    setup.surface.height.as_ref().map_or(Ok(Vec::new()), of)
}

/// Collects what the page shows of the steps of a run.
struct RunCollector<'a> {
    turn: Turn<'a>,
    reported: Instant,
    curves: TapeCurves,
    steps: StepNumbers,
    motion: Motion,
    /// Further fields of the last state of each run, and the layers of the cut that some of them lie in.
    ends: [(Vec<StateField>, Option<CutLayers>); 2],
    /// The work of each run so far, of a history with all its states.
    work: [Work; 2],
}

/// Reports where a solve stands, if its numbers are those of the run, and ends it when its turn is over.
struct ProgressReport<'w, 'a> {
    turn: Turn<'a>,
    reported: Option<&'w mut Instant>,
}

impl job::Watcher for RunCollector<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        let turn = self.turn;
        match pass {
            Pass::Solve(_, 0) => {
                let progress = ProgressReport { turn, reported: Some(&mut self.reported) };
                Box::new(((&mut self.curves, &mut self.steps, &mut self.motion), progress))
            }
            _ => Box::new(ProgressReport { turn, reported: None }),
        }
    }

    fn state(&mut self, run: usize, state: &State) {
        self.work[run] += state.contact.work;
        self.ends[run] = (state.fields.clone(), state.layers.clone());
        if run > 0 {
            return;
        }
        let work = self.work[run];
        self.steps.add_state(work, state);
        self.motion.add_state(state);
        if self.reported.elapsed() >= INTERVAL {
            self.reported = Instant::now();
            let (numbers, section) = (Numbers::from_state(state, work), Section::from_state(state));
            self.turn.update_run(numbers, section);
        }
    }
}

impl Observer for ProgressReport<'_, '_> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if !self.turn.goes_on() {
            return Ok(ControlFlow::Break(()));
        }
        if let Some(reported) = self.reported.as_mut().filter(|reported| reported.elapsed() >= INTERVAL) {
            **reported = Instant::now();
            let (numbers, section) = (Numbers::from_step(step), Section::from_step(step));
            self.turn.update_run(numbers, section);
        }
        Ok(ControlFlow::Continue(()))
    }

    fn ask(&mut self) -> Wish {
        Ok(if self.turn.goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) })
    }
}
