//! The watcher by which the command line follows the states of a run, one after the other.

use super::interrupt::interrupted;
use super::outputs::Outputs;
use super::progress::Bars;
use anyhow::Result;
use asperity::contact::{Observer, State};
use asperity::job::{Pass, Watcher};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Bars for the solves of each state.
pub(crate) struct StateWatch<'a> {
    bars: Bars,
    outputs: &'a Outputs,
}

impl<'a> StateWatch<'a> {
    /// A watch of the states of a run, which Ctrl-C ends.
    pub(crate) fn new(outputs: &'a Outputs) -> Result<Self> {
        Ok(Self { bars: Bars::until(interrupted()?), outputs })
    }
}

impl Watcher for StateWatch<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        self.bars.observer(pass)
    }

    fn ended(&self) -> Option<Arc<AtomicBool>> {
        self.bars.ended()
    }

    /// Computes what was asked for besides, before the numbers of the state are read.
    fn state(&mut self, _: usize, state: &State) {
        self.outputs.complete(&state.contact);
    }
}
