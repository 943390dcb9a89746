//! One solve of a job.

use crate::contact::{Problem, Solver};
use crate::diagnosis::Reference;
use crate::error::SetupError;
#[cfg(feature = "record")]
use crate::record::{Options, Parts, Scene};
use crate::setup::{Extras, Setup};
use std::sync::Arc;

/// One solve of a job: a setup, and how it is shown in a recording.
#[derive(Clone)]
pub struct JobRun<'a> {
    /// Root of its entities in a recording.
    pub name: String,
    /// Title of its tab and pictures in a recording.
    pub title: Option<String>,
    /// What is solved.
    pub setup: Setup,
    /// The problem of the setup, where it is at hand already.
    pub problem: Option<Problem>,
    /// The state that each step is compared with, where it is at hand already.
    pub reference: Option<Arc<Reference>>,
    /// Whether the exact solution is drawn beside the computed one, where there is one.
    pub shows_exact: bool,
    /// The steps of another code, in place of the solver of the setup.
    pub other: Option<&'a dyn Solver>,
}

impl<'a> JobRun<'a> {
    /// The run of a setup under the name `contact`.
    pub fn new(setup: Setup) -> Self {
        Self {
            name: "contact".into(),
            title: None,
            setup,
            problem: None,
            reference: None,
            shows_exact: true,
            other: None,
        }
    }

    /// The run that shows the steps of another code, under a title. Its recording names no setup, since a setup would name a solver
    /// that has not made the steps.
    pub fn from_other(title: &str, setup: Setup, problem: Problem, steps: &'a dyn Solver) -> Self {
        Self { title: Some(title.into()), problem: Some(problem), other: Some(steps), ..Self::new(setup) }
    }

    /// What a progress bar calls it: its title, if it has one, else its solver.
    pub fn label(&self) -> &str {
        self.title.as_deref().unwrap_or_else(|| self.solver().name())
    }

    /// The solver, or what shows the steps of another code.
    pub(super) fn solver(&self) -> &dyn Solver {
        self.other.unwrap_or_else(|| self.setup.solver.solver())
    }

    /// Whether a pass before finds the same final state.
    pub(super) fn is_repeatable(&self) -> bool {
        self.other.is_none()
    }

    /// Makes the problem if it is not at hand.
    pub(super) fn pose(&mut self, extras: &Extras) -> Result<(), SetupError> {
        if self.problem.is_none() {
            self.setup.cost(extras)?.check(self.setup.solver.name())?;
            self.problem = Some(self.setup.problem()?);
        }
        Ok(())
    }

    /// The options of a recording that the setup names; of the steps of another code the density of the error is shown as well,
    /// unless the setup names the parts.
    #[cfg(feature = "record")]
    pub(super) fn options(&self) -> Options {
        let options = Options::from(&self.setup.record);
        match self.other {
            Some(_) if self.setup.record.what.is_empty() => Options { what: Parts::OF_OTHERS, ..options },
            _ => options,
        }
    }

    /// The scene of a recording.
    #[cfg(feature = "record")]
    pub(super) fn scene<'p>(&self, problem: &'p Problem) -> Scene<'p> {
        let scene = match self.other {
            Some(_) => Scene::new(&self.name, problem),
            None => Scene { name: self.name.clone(), ..Scene::of(&self.setup, problem) },
        };
        let title = self.title.clone().unwrap_or(scene.title);
        let exact = scene.exact.filter(|_| self.shows_exact);
        Scene { title, exact, reference: self.reference.clone(), ..scene }
    }
}
