//! The watcher by which the command line follows the states of a run, one after the other.

use super::exit_status::{ExitStatus, shortfall, status_of};
use super::finding::Finding;
use super::flow::FlowFinding;
use super::interrupt::interrupted;
use super::outputs::Outputs;
use super::progress::Bars;
use anyhow::Result;
use asperity::contact::{Observer, State, warnings_of_contact};
use asperity::job::{Pass, Watcher};
use asperity::setup::{Drive, Setup};
use asperity::warning::Warning;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Bars for the solves of each state, and the findings under each of a list of loads.
pub(crate) struct StateWatch<'a> {
    bars: Bars,
    setup: &'a Setup,
    outputs: &'a Outputs,
    drive: &'static Drive,
    /// The findings, of a list of loads.
    pub findings: Vec<Finding>,
    /// Warnings about the first contact of a list of loads that has some which do not follow from its findings.
    pub of_contact: Vec<Warning>,
    /// How the solves ended, of a list of loads.
    pub status: ExitStatus,
    /// The warnings of those that did not converge.
    pub shortfalls: Vec<String>,
}

impl<'a> StateWatch<'a> {
    /// A watch of the states of a setup, which Ctrl-C ends.
    pub(crate) fn new(setup: &'a Setup, outputs: &'a Outputs, drive: &'static Drive) -> Result<Self> {
        let bars = Bars::until(interrupted()?);
        Ok(Self {
            bars,
            setup,
            outputs,
            drive,
            findings: Vec::new(),
            of_contact: Vec::new(),
            status: ExitStatus::Done,
            shortfalls: Vec::new(),
        })
    }
}

impl Watcher for StateWatch<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        self.bars.observer(pass)
    }

    fn ended(&self) -> Option<Arc<AtomicBool>> {
        self.bars.ended()
    }

    fn state(&mut self, _: usize, state: &State) {
        if !self.drive.is_list {
            return;
        }
        self.outputs.complete(&state.contact);
        let flow = FlowFinding::from_numbers(state.contact.values().numbers());
        self.findings.push(Finding { flow, ..Finding::new(self.setup, &state.contact) });
        if self.of_contact.is_empty() {
            self.of_contact = warnings_of_contact(&state.contact);
        }
        self.shortfalls.extend(shortfall(&state.contact));
        self.status = self.status.max(status_of(&state.contact).unwrap_or(ExitStatus::NotConverged));
    }
}
