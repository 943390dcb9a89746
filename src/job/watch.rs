//! What watches the solves of a job.

use super::run::Run;
use crate::contact::Observer;

/// A solve of a job that is about to begin.
#[derive(Clone, Copy)]
pub enum Stage<'a> {
    /// A solve on one of the grids that are tried until the contact has settled.
    Grid(&'a Run<'a>),
    /// The first pass, which finds the final state that steps are compared with.
    Reference(&'a Run<'a>),
    /// The solve that is asked for, and its number in the job, from 0.
    Solve(&'a Run<'a>, usize),
    /// The solve under the smaller load that finds what sticks under a tangential load.
    Stick(&'a Run<'a>),
}

/// Makes the observer of each solve of a job.
///
/// Nobody watches by `()`.
pub trait Watch {
    /// The observer of a solve.
    fn observer(&mut self, stage: Stage<'_>) -> Box<dyn Observer + '_>;
}

/// Shows every step of the solves that are asked for to one observer, and none of the passes before and after them.
pub struct Shown<'o>(pub &'o mut dyn Observer);

impl Watch for Shown<'_> {
    fn observer(&mut self, stage: Stage<'_>) -> Box<dyn Observer + '_> {
        match stage {
            Stage::Solve(..) => Box::new(&mut *self.0),
            Stage::Grid(_) | Stage::Reference(_) | Stage::Stick(_) => Box::new(()),
        }
    }
}

impl Watch for () {
    fn observer(&mut self, _: Stage<'_>) -> Box<dyn Observer + '_> {
        Box::new(())
    }
}
