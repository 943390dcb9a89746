//! One solve, recorded and reported as it goes.

use super::knobs::Knobs;
use super::report::{Numbers, RunReport};
use super::session::{Solution, Turn};
use crate::contact::{Failure, Observer, Step, Wish};
use crate::error::SolveError;
use crate::record::{Ghost, Options, Recording, Scene, describe};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// How often a running solve reports.
const INTERVAL: Duration = Duration::from_millis(60);

/// Solves what the knobs stand for, until it is done or the turn over.
pub fn run(turn: Turn<'_>, knobs: Knobs) -> Result<(), Failure> {
    let setup = knobs.setup()?;
    let problem = setup.problem()?;
    let (solver, stop) = (setup.solver.solver(), &setup.stop);
    let exact = setup.exact(problem.surface().grid(), problem.expected_mean_pressure());
    let report = RunReport::new(format!("run-{}", turn.number()), knobs, &setup, exact.as_ref());
    let id = report.id.clone();
    let scene = Scene {
        name: "contact".into(),
        title: report.title.clone(),
        problem: &problem,
        description: describe(&setup.surface.description(), &problem, "m", solver, stop, exact.as_ref()),
        exact,
    };
    let what = setup.record.what.iter().copied().collect();
    let options = Options { what, ghost: turn.ghost(), ..Options::default() };
    let (recording, live) = Recording::live(&id, &[scene], options)?;
    turn.keep(&id, live);
    turn.tell(|news| news.run = Some(report));
    let mut curves = Ghost::new(&format!("pinned {id}"));
    let watch = Watch { turn, reported: Instant::now() };
    let contact = solver.solve(&problem, stop, &mut (recording.recorder(0), &mut curves, watch))?;
    recording.finish()?;
    if let Some(failure) = contact.failure {
        return Err(SolveError::Observer(failure).into());
    }
    turn.finish(Solution { id, setup, contact }, curves);
    Ok(())
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
