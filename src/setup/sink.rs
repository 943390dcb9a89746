//! What receives the states of a run while it goes on.

use super::posed::Posed;
use crate::contact::State;
use crate::error::FileError;
use std::sync::Arc;

/// What receives the states of the runs of a job, each as soon as it is solved: a recording, a table, an archive.
pub trait StateSink {
    /// Takes a state of a run by its number, from 0 on. The states of a run beside the first one come after those of the first one.
    ///
    /// # Errors
    /// For what cannot be written. The sink gets nothing more then, and the run goes on.
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError>;

    /// Ends with all states of a run, which were taken one by one before: a recording fits its axes to them. It is called once for each run, in their
    /// order, after the last run.
    ///
    /// # Errors
    /// For what cannot be written.
    fn end(&mut self, _posed: &Posed<'_>, _states: &[Arc<State>]) -> Result<(), FileError> {
        Ok(())
    }
}

impl<S: StateSink + ?Sized> StateSink for &mut S {
    fn state(&mut self, posed: &Posed<'_>, number: usize, state: &State) -> Result<(), FileError> {
        (**self).state(posed, number, state)
    }

    fn end(&mut self, posed: &Posed<'_>, states: &[Arc<State>]) -> Result<(), FileError> {
        (**self).end(posed, states)
    }
}
