//! One solve, recorded and reported as it goes.

use super::knobs::Knobs;
use super::motion::Motion;
use super::reel::Reel;
use super::report::{Beside, ExactNumbers, Numbers, RunReport, SurfaceWarning, file_stem};
use super::session::Turn;
use super::step_numbers::StepNumbers;
use crate::contact::{Failure, Load, Observer, Problem, Step, Wish};
use crate::error::{SetupError, SolveError};
use crate::record::{Ghost, Options, Recording, Scene};
use crate::setup::{Setup, command};
use crate::surface::Surface;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Time between two reports of a running solve.
const INTERVAL: Duration = Duration::from_millis(60);

/// Solves the setup that the knobs stand for, and the one beside it under the same mean pressure, until all is done or the turn over.
pub fn run(turn: Turn<'_>, knobs: Knobs, setup: Setup, beside: Option<Setup>) -> Result<(), Failure> {
    let problem = setup.problem()?;
    let beside = beside.map(|beside| pressed_alike(beside, &problem)).transpose()?;
    let rank = setup.surface.rank(&setup.grid)?;
    let scene = Scene::of(&setup, &problem);
    let title = format!("{}, p* = {}", scene.title, knobs.load);
    let report = RunReport {
        id: format!("run-{}", turn.number),
        file_stem: file_stem(&scene.title, &format!("p{}", knobs.load), setup.solver.name()),
        title: title.clone(),
        command: command(&setup),
        setup: setup.to_toml(),
        prepared: prepared(&setup, problem.surface())?,
        warnings: warnings(&setup, &problem, beside.as_ref()),
        knobs,
        ended: false,
        numbers: None,
        exact: scene.exact.as_ref().map(ExactNumbers::from),
        beside: beside
            .as_ref()
            .map(|(setup, problem)| Beside { title: Scene::of(setup, problem).title, numbers: None }),
    };
    let (id, exact) = (report.id.clone(), scene.exact.clone());
    let file_stem = report.file_stem.clone();
    let options = Options { ghost: turn.ghost(), ..turn.options(&setup.record) };
    let name = "beside".into();
    let other = beside.as_ref().map(|(setup, problem)| Scene { name, ..Scene::of(setup, problem) });
    let scenes: Vec<Scene<'_>> = [Scene { title, ..scene }].into_iter().chain(other).collect();
    let (recording, live) = Recording::live(&id, &scenes, options)?;
    turn.keep(Reel::new(&id, &file_stem, live));
    turn.tell(|news| news.run = Some(report));
    let mut curves = Ghost::new(&format!("pinned {id}"));
    let (mut steps, mut motion) = (StepNumbers::default(), Motion::default());
    let mut watch = Watch { turn, reported: Instant::now() };
    let solver = setup.solver.solver();
    let mut kept = (&mut curves, &mut steps, &mut motion);
    let contact = solver.solve(&problem, &setup.stop, &mut (recording.recorder(0), &mut kept, &mut watch))?;
    let other = match &beside {
        Some((setup, problem)) => Some(solver.solve(problem, &setup.stop, &mut (recording.recorder(1), watch))?),
        None => None,
    };
    recording.finish()?;
    if let Some(failure) = [Some(&contact), other.as_ref()].into_iter().flatten().find_map(|it| it.failure.clone()) {
        return Err(SolveError::Observer(failure).into());
    }
    turn.finish(rank, contact, exact, other, curves, (steps, motion));
    Ok(())
}

/// A setup under the mean pressure of a problem, and the problem that it stands for.
fn pressed_alike(setup: Setup, other: &Problem) -> Result<(Setup, Problem), Failure> {
    let setup = Setup { load: Load::MeanPressure(other.expected_mean_pressure()), ..setup };
    let problem = setup.problem()?;
    Ok((setup, problem))
}

/// Why the numbers may mean little, those of the surface beside among them.
fn warnings(setup: &Setup, problem: &Problem, beside: Option<&(Setup, Problem)>) -> Vec<SurfaceWarning> {
    let of = |setup: &Setup, problem: &Problem, is_beside| {
        let warnings = setup.surface.warnings(problem.surface()).into_iter();
        warnings.map(move |warning| SurfaceWarning { is_beside, warning })
    };
    let of_beside = beside.into_iter().flat_map(|(setup, problem)| of(setup, problem, true));
    of(setup, problem, false).chain(of_beside).collect()
}

/// What each step of the preparation came to.
fn prepared(setup: &Setup, surface: &Surface) -> Result<Vec<String>, SetupError> {
    let of = |file| Ok(setup.surface.prepared(file, surface.grid())?.told);
    setup.surface.height.as_ref().map_or(Ok(Vec::new()), of)
}

/// Reports where a solve stands, and ends it when its turn is over.
struct Watch<'a> {
    turn: Turn<'a>,
    reported: Instant,
}

impl Observer for Watch<'_> {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if !self.turn.goes_on() {
            return Ok(ControlFlow::Break(()));
        }
        if self.reported.elapsed() >= INTERVAL {
            self.reported = Instant::now();
            let numbers = Numbers::of_step(step);
            self.turn.tell(|news| {
                if let Some(run) = &mut news.run {
                    run.numbers = Some(numbers);
                }
            });
        }
        Ok(ControlFlow::Continue(()))
    }
}
