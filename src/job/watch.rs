//! The observers of the solves of a job.

use super::run::JobRun;
use crate::contact::{Observer, State};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A solve of a job that is about to begin.
#[derive(Clone, Copy)]
pub enum Pass<'a> {
    /// A solve on one of the grids that are tried until area and `kappa_r` are accurate enough.
    Grid(&'a JobRun<'a>),
    /// The first pass, which finds the final state that steps are compared with.
    Reference(&'a JobRun<'a>),
    /// A main solve of the job, and its number, from 0.
    Solve(&'a JobRun<'a>, usize),
    /// The solves for a state of a run with several, by the number of the run and that of the state, from 0.
    State(&'a JobRun<'a>, usize, usize),
    /// The solve under the smaller load, which gives the stick area under a tangential load.
    Stick(&'a JobRun<'a>),
}

/// Makes the observer of each solve of a job.
///
/// `()` makes no observers.
pub trait Watcher {
    /// The observer of a solve.
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_>;

    /// What becomes true when the run should end, for work that shows no steps on other threads, such as that of flows; none if nothing ends it.
    fn ended(&self) -> Option<Arc<AtomicBool>> {
        None
    }

    /// Gets each state of a run with several, by the number of the run.
    fn state(&mut self, _run: usize, _state: &State) {}
}

/// Shows every step of the main solves to one observer, but not those of the first pass and of the solves for slip.
pub struct ShowSteps<'o>(pub &'o mut dyn Observer);

impl Watcher for ShowSteps<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        match pass {
            Pass::Solve(..) | Pass::State(..) => Box::new(&mut *self.0),
            Pass::Grid(_) | Pass::Reference(_) | Pass::Stick(_) => Box::new(()),
        }
    }
}

impl Watcher for () {
    fn observer(&mut self, _: Pass<'_>) -> Box<dyn Observer + '_> {
        Box::new(())
    }
}
