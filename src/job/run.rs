//! One solve of a job.

use crate::contact::{Problem, Solver};
use crate::diagnosis::Reference;
use crate::error::SetupError;
#[cfg(feature = "record")]
use crate::record::{Options, Parts, Scene};
use crate::setup::{Cost, Drive, Extras, Setup};
use crate::surface::Surface;
use std::sync::Arc;

/// Fields of a result.
const RESULT_FIELDS: f64 = 3.0;
/// Fields of heights and observers, in addition to those of a solver.
const OTHER_FIELDS: f64 = 4.0;

/// One solve of a job: a setup, and its place in a recording.
#[derive(Clone)]
pub struct JobRun<'a> {
    /// Root of its entities in a recording.
    pub name: String,
    /// Title of its tab and pictures in a recording.
    pub title: Option<String>,
    /// What is solved.
    pub setup: Setup,
    /// Heights in memory, which replace those that the setup names. Finer grids interpolate them.
    pub heights: Option<Arc<Surface>>,
    /// The problem of the setup, where it already exists.
    pub problem: Option<Problem>,
    /// The state that each step is compared with, where it already exists.
    pub reference: Option<Arc<Reference>>,
    /// Whether the exact solution, if there is one, is drawn beside the computed one.
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
            heights: None,
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

    /// The drive that leads from one state to the next; none for one contact.
    ///
    /// # Errors
    /// The errors of [`Setup::drive`].
    pub fn drive(&self) -> Result<Option<&'static Drive>, SetupError> {
        if self.other.is_some() { Ok(None) } else { self.setup.drive_of_states() }
    }

    /// Its name in a progress bar: its title, if it has one, else its solver.
    pub fn label(&self) -> &str {
        self.title.as_deref().unwrap_or_else(|| self.solver().name())
    }

    /// The solver, or the replay of the steps of another code.
    pub(super) fn solver(&self) -> &dyn Solver {
        self.other.unwrap_or_else(|| self.setup.solver())
    }

    /// Whether a first pass finds the same final state.
    pub(super) fn is_repeatable(&self) -> bool {
        self.other.is_none()
    }

    /// Makes the problem, unless it exists, if there is memory for the solve.
    pub(super) fn pose(&mut self, extras: &Extras) -> Result<(), SetupError> {
        if self.problem.is_none() {
            self.check_memory(&self.setup, extras)?;
            self.problem = Some(self.problem_of(&self.setup)?);
        }
        Ok(())
    }

    /// The problem of the setup, or of the same one on a finer grid.
    pub(super) fn problem_of(&self, setup: &Setup) -> Result<Problem, SetupError> {
        match &self.heights {
            Some(heights) => setup.problem_of(heights.refined(self.refinement_to(setup))?),
            None => setup.problem(),
        }
    }

    /// Refuses a solve of the setup, or of the same one on a finer grid, that does not fit in memory.
    pub(super) fn check_memory(&self, setup: &Setup, extras: &Extras) -> Result<(), SetupError> {
        let cost = match &self.heights {
            Some(heights) => {
                let grid = heights.grid().refined(self.refinement_to(setup))?;
                Cost::from_fields(&grid, setup.solver.fields(&grid, 0.0).max(RESULT_FIELDS) + OTHER_FIELDS)
            }
            None => setup.cost(extras)?,
        };
        cost.check(setup.solver.name())
    }

    /// Refinement of the grid of the heights in memory, along each axis.
    fn refinement_to(&self, finer: &Setup) -> usize {
        (finer.grid.refine() / self.setup.grid.refine()).max(1)
    }

    /// The options of a recording in the setup. For the steps of another code, the density of the error is also shown,
    /// unless the setup names the parts.
    #[cfg(feature = "record")]
    pub(super) fn options(&self) -> Options {
        let options = Options::from(&self.setup);
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
            None => Scene { name: self.name.clone(), ..Scene::from_setup(&self.setup, problem) },
        };
        let title = self.title.clone().unwrap_or(scene.title);
        let exact = scene.exact.filter(|_| self.shows_exact);
        Scene { title, exact, reference: self.reference.clone(), ..scene }
    }
}
