//! The numbers of the steps of a run.

use crate::contact::{Contact, Failure, Observer, Quantity, Reading, State, Step, Wish, Work};
use crate::setup::Drive;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use strum::IntoEnumIterator;

/// The most steps whose numbers are kept; of more of them every second one is, of twice as many every fourth, and so on.
const MOST: usize = 2000;
/// Observables that are kept beside those that are traced.
const COUNTED: [Quantity; 2] = [Quantity::Iterations, Quantity::Transforms];

/// The numbers of the steps of a run by their names, a column each, and the final contact as the last row; or those of the states of a history.
/// `step` is the step of a row in the recording: its number of iterations, or the number of the state from 1 on; `level` is 0 on the grid of
/// the run, and more on coarser ones. What is not known at a step is null in JSON.
#[derive(Default, Serialize)]
pub(crate) struct StepNumbers {
    step: Vec<f64>,
    level: Vec<usize>,
    seconds: Vec<f64>,
    #[serde(flatten)]
    columns: BTreeMap<&'static str, Vec<f64>>,
    /// Steps seen so far, and the power of two of which the numbers of kept ones are multiples.
    #[serde(skip)]
    seen: usize,
    #[serde(skip)]
    thinned: u32,
    /// What is kept of states besides.
    #[serde(skip)]
    of_states: Vec<Quantity>,
}

impl StepNumbers {
    /// No numbers yet; those of states of a drive hold all that is shown of them.
    pub(crate) fn new(drive: Option<&Drive>) -> Self {
        let shown = |drive: &Drive| {
            let shown: BTreeSet<Quantity> = drive.shown().collect();
            shown.into_iter().filter(|it| !is_kept(*it)).collect()
        };
        Self { of_states: drive.map(shown).unwrap_or_default(), ..Self::default() }
    }

    /// Adds the next state of a history, with the work so far.
    pub(crate) fn add_state(&mut self, work: Work, state: &State) {
        self.seen += 1;
        let reading = Reading::from(&state.contact).with_work(work);
        self.add([self.seen, 0], work, reading);
        for quantity in &self.of_states {
            self.columns.entry(quantity.name()).or_default().push(state.value(*quantity));
        }
    }

    fn add<'a>(&mut self, [step, level]: [usize; 2], work: Work, state: impl Into<Reading<'a>>) {
        let reading = state.into();
        self.step.push(step as f64);
        self.level.push(level);
        self.seconds.push(work.seconds);
        for quantity in Quantity::iter().filter(|it| is_kept(*it)) {
            self.columns.entry(quantity.name()).or_default().push(reading.value(quantity));
        }
        // of a contact that slides
        if let Some(friction) = reading.get(Quantity::Friction).filter(|_| self.of_states.is_empty()) {
            self.columns.entry(Quantity::Friction.name()).or_default().push(friction);
        }
    }

    /// Drops every second row, from the second one on.
    fn thin(&mut self) {
        self.thinned += 1;
        self.step = self.step.iter().copied().step_by(2).collect();
        self.level = self.level.iter().copied().step_by(2).collect();
        for column in self.columns.values_mut().chain([&mut self.seconds]) {
            let kept = column.iter().copied().step_by(2).collect();
            *column = kept;
        }
    }
}

/// Whether a quantity is kept of each step and of each state.
fn is_kept(quantity: Quantity) -> bool {
    quantity.row().is_traced || COUNTED.contains(&quantity)
}

impl Observer for StepNumbers {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if self.seen.is_multiple_of(1 << self.thinned) {
            self.add([step.index(), step.phase().level], step.work(), step);
        }
        self.seen += 1;
        if self.seconds.len() == MOST {
            self.thin();
        }
        Ok(ControlFlow::Continue(()))
    }

    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.add([contact.work.iterations, 0], contact.work, contact);
        Ok(())
    }
}
