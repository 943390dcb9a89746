//! A run of several states that can begin.

use super::{Drive, Setup};
use crate::contact::Problem;

/// A run whose setup was checked and whose surface was made.
#[derive(Clone, Copy)]
pub struct Posed<'a> {
    /// Its number in its job, from 0 on: the first one, or one beside it.
    pub run: usize,
    /// What is solved.
    pub setup: &'a Setup,
    /// Its problem; that of a list of loads is under the largest of them.
    pub problem: &'a Problem,
    /// The drive that leads from one state to the next.
    pub drive: &'static Drive,
}

impl Posed<'_> {
    /// The text of the setup that repeats the run.
    pub fn text(&self) -> String {
        self.setup.to_saved_toml()
    }

    /// The number of axes of its arrays.
    pub fn rank(&self) -> usize {
        let of_grid = || if self.problem.surface().grid().is_line() { 1 } else { 2 };
        self.setup.surface.rank(&self.setup.grid).unwrap_or_else(|_| of_grid())
    }
}
