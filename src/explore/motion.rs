//! The sections of a run step by step, and of a sweep load by load, which move in the page's own picture.

use super::section::Section;
use crate::contact::{Observer, State, Step, Wish};
use serde::Serialize;
use std::ops::ControlFlow;

/// How much later the next step is kept than the last one: of 100 000 steps that makes 140, most of them early, where most happens.
const LATER: f64 = 1.08;

/// The sections of a run and the numbers of their steps, without the last one, which is reported separately; or those
/// of a sweep and the numbers of their loads.
#[derive(Clone, Default, Serialize)]
pub(crate) struct Motion {
    steps: Vec<usize>,
    sections: Vec<Section>,
    /// The first step that is kept next.
    #[serde(skip)]
    next: usize,
    /// How many states there were.
    #[serde(skip)]
    seen: usize,
}

impl Motion {
    /// Adds the section of load number `number` of a sweep.
    pub(crate) fn add_load(&mut self, number: usize, section: Section) {
        self.steps.push(number);
        self.sections.push(section);
    }

    /// Adds the section of the next state of a history, whose states are numbered from 1 on.
    pub(crate) fn add_state(&mut self, state: &State) {
        self.seen += 1;
        self.add(self.seen, || Section::from_state(state));
    }

    /// Adds the section of a step, unless it comes too soon after the last one.
    fn add(&mut self, step: usize, section: impl FnOnce() -> Section) {
        if step >= self.next {
            self.steps.push(step);
            self.sections.push(section());
            self.next = (step + 1).max((step as f64 * LATER) as usize);
        }
    }
}

impl Observer for Motion {
    fn step(&mut self, step: &Step<'_>) -> Wish {
        self.add(step.index(), || Section::from_step(step));
        Ok(ControlFlow::Continue(()))
    }
}
