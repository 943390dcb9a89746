//! The numbers of the steps of a run.

use crate::contact::{Contact, Failure, OBSERVABLES, Observer, State, Step, Wish, Work};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// The most steps whose numbers are kept; of more of them every second one is, of twice as many every fourth, and so on.
const MOST: usize = 2000;
/// Observables that are kept beside those that are traced.
const COUNTED: [&str; 2] = ["iterations", "transforms"];
/// One that is kept where it is known: of a contact that slides.
const FRICTION: &str = "friction";

/// The numbers of the steps of a run by their names, a column each, and the final contact as the last row. The step of a row in the
/// recording is its number of `iterations`; what is not known at a step is null in JSON.
#[derive(Default, Serialize)]
pub struct StepNumbers {
    seconds: Vec<f64>,
    #[serde(flatten)]
    columns: BTreeMap<&'static str, Vec<f64>>,
    /// Steps seen so far, and the power of two of which the numbers of kept ones are multiples.
    #[serde(skip)]
    seen: usize,
    #[serde(skip)]
    thinned: u32,
}

impl StepNumbers {
    fn add<'a>(&mut self, work: Work, state: impl Into<State<'a>>) {
        let state = state.into();
        self.seconds.push(work.seconds);
        for observable in OBSERVABLES.iter().filter(|it| it.is_traced || COUNTED.contains(&it.name)) {
            self.columns.entry(observable.name).or_default().push((observable.value)(&state));
        }
        let found = OBSERVABLES.iter().find(|it| it.name == FRICTION);
        let friction = found.map_or(f64::NAN, |it| (it.value)(&state));
        if friction.is_finite() {
            self.columns.entry(FRICTION).or_default().push(friction);
        }
    }

    /// Drops every second row, from the second one on.
    fn thin(&mut self) {
        self.thinned += 1;
        for column in self.columns.values_mut().chain([&mut self.seconds]) {
            let kept = column.iter().copied().step_by(2).collect();
            *column = kept;
        }
    }
}

impl Observer for StepNumbers {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        if self.seen.is_multiple_of(1 << self.thinned) {
            self.add(step.work(), step);
        }
        self.seen += 1;
        if self.seconds.len() == MOST {
            self.thin();
        }
        Ok(ControlFlow::Continue(()))
    }

    fn end(&mut self, contact: &Contact) -> Result<(), Failure> {
        self.add(contact.work, contact);
        Ok(())
    }
}
