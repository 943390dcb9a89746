//! A job whose surfaces are made.

use super::Job;
use super::follow::{StateKeeping, give};
use super::history::HistoryOutcome;
use super::outcome::{Outcome, Solved};
use super::run::JobRun;
use super::watch::{Pass, Watcher};
use crate::contact::{Contact, Observer, PartialSlip, Problem};
use crate::diagnosis::{Diagnosis, Reference};
use crate::error::SetupError;
use crate::history::Sliding;
#[cfg(feature = "record")]
use crate::record::{Recording, StateRecording};
use crate::setup::{Extras, Setup, StateSink};
use crate::study::Settled;
use crate::warning::Warning;
use std::sync::Arc;

/// A job whose surfaces and problems exist, so that its warnings are known before the solve.
pub struct Ready<'a> {
    pub(super) job: Job<'a>,
}

impl<'a> Job<'a> {
    /// Makes the surfaces and the problems of all runs.
    ///
    /// # Errors
    /// The errors of [`Setup::problem`], and [`SetupError::Memory`] for a run that does not fit in memory.
    pub fn prepare(mut self) -> Result<Ready<'a>, SetupError> {
        let extras = self.extras();
        self.runs.iter_mut().try_for_each(|run| run.pose(&extras))?;
        Ok(Ready { job: self })
    }

    /// Prepares and runs the job: see [`Job::prepare`] and [`Ready::run`].
    ///
    /// # Errors
    /// The errors of both.
    pub fn run(self, watch: &mut dyn Watcher) -> Result<Outcome, SetupError> {
        self.prepare()?.run(watch)
    }
}

impl Ready<'_> {
    /// The problem of the first run.
    pub fn problem(&self) -> &Problem {
        problem(&self.job.runs[0])
    }

    /// The setup of the first run.
    pub fn setup(&self) -> &Setup {
        &self.job.runs[0].setup
    }

    /// Reasons to doubt the surfaces.
    pub fn warnings(&self) -> Vec<Warning> {
        self.job.runs.iter().flat_map(|run| run.setup.surface.warnings(problem(run).surface())).collect()
    }

    /// Finds the grid, solves, records and diagnoses. The contacts are always returned, converged or not; a failure of
    /// the recording is in their [`Contact::failure`].
    ///
    /// # Errors
    /// For a recording that cannot be begun, and the errors of [`Solver::solve`](crate::contact::Solver::solve).
    pub fn run(mut self, watch: &mut dyn Watcher) -> Result<Outcome, SetupError> {
        let settled = self.settle(watch)?;
        let is_settled = settled.as_ref().is_none_or(|settled| settled.is_within);
        if let Some(Settled { setup, contact, .. }) = settled {
            let first = &mut self.job.runs[0];
            (first.setup, first.problem) = (setup, Some(contact.problem.clone()));
            if !(self.job.is_diagnosed || self.job.is_recorded() || self.job.runs.len() > 1) {
                let solved = self.solved(0, contact, is_settled, watch)?;
                return Ok(Outcome { solved: vec![solved], diagnosis: None });
            }
        }
        self.find_references(watch)?;
        let run = &self.job.runs[0];
        let mut diagnosis = self.job.is_diagnosed.then(|| Diagnosis::new(problem(run), run.reference.clone()));
        let found = self.solve(&mut diagnosis, watch)?.into_iter().enumerate();
        let solved = found.map(|(i, found)| match found {
            Found::Contact(contact) => self.solved(i, *contact, i > 0 || is_settled, watch),
            Found::States(states) => Ok(self.followed(i, *states)),
        });
        Ok(Outcome {
            solved: solved.collect::<Result<_, _>>()?,
            diagnosis: diagnosis.map(|diagnosis| diagnosis.findings()),
        })
    }

    /// Solves on successively finer grids, if the grid is automatic.
    fn settle(&self, watch: &mut dyn Watcher) -> Result<Option<Settled>, SetupError> {
        let Some(refinement) = &self.job.refinement else { return Ok(None) };
        let first = &self.job.runs[0];
        let check = |setup: &Setup| first.check_memory(setup, &Extras::default());
        let settled = refinement.settle_if(check, |setup| {
            let (solver, problem) = (first.solver(), first.problem_of(setup)?);
            Ok::<_, SetupError>(solver.solve(&problem, &setup.stop, &mut watch.observer(Pass::Grid(first)))?)
        })?;
        Ok(Some(settled))
    }

    /// Finds the final states, with which steps are compared, each in a separate pass.
    fn find_references(&mut self, watch: &mut dyn Watcher) -> Result<(), SetupError> {
        for i in 0..self.job.runs.len() {
            let run = &self.job.runs[i];
            if self.job.needs_reference(run) {
                let mut observer = watch.observer(Pass::Reference(run));
                let contact = run.solver().solve(problem(run), &run.setup.stop, &mut observer)?;
                drop(observer);
                self.job.runs[i].reference = Some(Arc::new(Reference::from_contact(&contact)));
            }
        }
        Ok(())
    }

    /// Solves all runs one after the other, and records them on request.
    fn solve(&mut self, diagnosis: &mut Option<Diagnosis>, watch: &mut dyn Watcher) -> Result<Vec<Found>, SetupError> {
        let mut sinks = std::mem::take(&mut self.job.sinks);
        #[cfg(feature = "record")]
        if let Some((target, options)) = self.job.recorded.take() {
            if self.job.runs[0].drive()?.is_none() {
                let scenes: Vec<_> = self.job.runs.iter().map(|run| run.scene(problem(run))).collect();
                let recording = Recording::to(target, &scenes, options)?;
                return self.solve_recorded(recording, diagnosis, watch);
            }
            let recording = StateRecording::open(target, options)?;
            let beside = self.job.runs[1..].iter().map(|run| run.scene(problem(run))).collect();
            sinks.push(Box::new(recording.with_scenes(self.job.runs[0].title.clone(), beside)));
        }
        let mut solve = |i: usize| match self.job.runs[i].drive()? {
            None => self.solve_run(i, &mut (), diagnosis, watch),
            Some(_) => self.follow_run(i, &mut sinks, watch),
        };
        let mut found = (0..self.job.runs.len()).map(&mut solve).collect::<Result<Vec<_>, _>>()?;
        for (i, (run, found)) in self.job.runs.iter().zip(&mut found).enumerate() {
            let Found::States(outcome) = found else { continue };
            let (posed, mut failure) = (run.posed(i, problem(run))?, outcome.failure.take());
            give(&mut sinks, &mut failure, |sink| sink.end(&posed, &outcome.states));
            outcome.failure = failure;
        }
        Ok(found)
    }

    #[cfg(feature = "record")]
    fn solve_recorded(
        &self,
        recording: Recording,
        diagnosis: &mut Option<Diagnosis>,
        watch: &mut dyn Watcher,
    ) -> Result<Vec<Found>, SetupError> {
        let solve = |i| self.solve_run(i, &mut recording.recorder(i), diagnosis, watch);
        let found = (0..self.job.runs.len()).map(solve).collect::<Result<Vec<_>, _>>();
        let mut found = match found {
            Ok(found) => found,
            Err(error) => {
                recording.discard();
                return Err(error);
            }
        };
        if let (Err(failure), Some(Found::Contact(last))) = (recording.finish(), found.last_mut()) {
            last.fail(failure);
        }
        Ok(found)
    }

    /// Follows run number `i`, which has several states.
    fn follow_run(
        &self,
        i: usize,
        sinks: &mut Vec<Box<dyn StateSink + '_>>,
        watch: &mut dyn Watcher,
    ) -> Result<Found, SetupError> {
        let run = &self.job.runs[i];
        let keeps = StateKeeping { has_fields: self.job.extras.archived > 0, is_last_only: self.job.keeps_last };
        Ok(Found::States(Box::new(run.follow(i, problem(run), sinks, keeps, watch)?)))
    }

    /// Solves run number `i`, shown to a recorder, to the diagnosis if it is the first, and to its own observer.
    fn solve_run(
        &self,
        i: usize,
        recorder: &mut dyn Observer,
        diagnosis: &mut Option<Diagnosis>,
        watch: &mut dyn Watcher,
    ) -> Result<Found, SetupError> {
        let (run, is_first) = (&self.job.runs[i], i == 0);
        let mut seen = (recorder, is_first.then_some(diagnosis), watch.observer(Pass::Solve(run, i)));
        let start = self.job.start.filter(|_| is_first);
        let contact = run.solver().solve_from(start, problem(run), &run.setup.stop, &mut seen)?;
        Ok(Found::Contact(Box::new(contact)))
    }

    /// The states of a run with several.
    fn followed(&self, i: usize, states: HistoryOutcome) -> Solved {
        let last = states.states.last().expect("a history has a first state");
        let (setup, contact) = (self.job.runs[i].setup.clone(), last.contact.clone());
        Solved { setup, contact, history: Some(states), slip: None, is_settled: true }
    }

    /// A contact with its stick area under the tangential load of its setup.
    fn solved(
        &self,
        i: usize,
        contact: Contact,
        is_settled: bool,
        watch: &mut dyn Watcher,
    ) -> Result<Solved, SetupError> {
        let (run, contact) = (&self.job.runs[i], Sliding::measured(contact));
        let friction = run.setup.friction.filter(|_| run.is_repeatable() && contact.fault().is_none());
        let stick = |friction| {
            let (solver, stop) = (run.solver(), &run.setup.stop);
            PartialSlip::solve(contact.clone(), friction, solver, stop, &mut watch.observer(Pass::Stick(run)))
        };
        let slip = friction.map(stick).transpose()?;
        Ok(Solved { setup: run.setup.clone(), contact, history: None, slip, is_settled })
    }
}

/// What a run has found.
enum Found {
    Contact(Box<Contact>),
    States(Box<HistoryOutcome>),
}

/// The problem of a run, which exists when the job is ready.
fn problem<'r>(run: &'r JobRun<'_>) -> &'r Problem {
    run.problem.as_ref().expect("a job that is ready has posed its problems")
}
