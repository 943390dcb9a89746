//! What watches the solves of a job.

use super::run::JobRun;
use crate::contact::Observer;

/// A solve of a job that is about to begin.
#[derive(Clone, Copy)]
pub enum Pass<'a> {
    /// A solve on one of the grids that are tried until the contact has settled.
    Grid(&'a JobRun<'a>),
    /// The first pass, which finds the final state that steps are compared with.
    Reference(&'a JobRun<'a>),
    /// The solve that is asked for, and its number in the job, from 0.
    Solve(&'a JobRun<'a>, usize),
    /// The solve under the smaller load that finds what sticks under a tangential load.
    Stick(&'a JobRun<'a>),
}

/// Makes the observer of each solve of a job.
///
/// Nobody watches by `()`.
pub trait Watcher {
    /// The observer of a solve.
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_>;
}

/// Shows every step of the solves that are asked for to one observer, and none of the passes before and after them.
pub struct ShowSteps<'o>(pub &'o mut dyn Observer);

impl Watcher for ShowSteps<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        match pass {
            Pass::Solve(..) => Box::new(&mut *self.0),
            Pass::Grid(_) | Pass::Reference(_) | Pass::Stick(_) => Box::new(()),
        }
    }
}

impl Watcher for () {
    fn observer(&mut self, _: Pass<'_>) -> Box<dyn Observer + '_> {
        Box::new(())
    }
}
