//! Solves of problems and setups.

use crate::background::{Foreground, StepCallback, StepHandle, StepSender, run_in_background};
use crate::contact::Contact;
use crate::detached::Detached;
use crate::error::{BoxedError, bail, py_error};
use crate::history::History;
use crate::own_solver::OwnSolver;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::solve_options::SolveOptions;
use crate::step::Step;
use crate::warn::warn_sentence;
use crate::warnings::{warn, warning_of_failure, warnings_about};
use asperity::contact::{Observer, Status};
use asperity::error::{HistoryError, StudyError};
use asperity::foreign::{GivenField, Replay};
use asperity::job::{HistoryOutcome, Job, JobRun, Outcome, Pass, Solved, Watcher};
use asperity::setup::Cost;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, PoisonError};

/// Fields of a recording or a result in memory, besides those of a solver.
const FIELDS: f64 = 4.0;
/// Fields of a state of a history: the three of its contact, and further fields such as traction and slip.
const FIELDS_OF_STATE: f64 = 5.0;

/// One solve: a problem, its setup with the keywords laid over it, and the options.
struct Solve<'a> {
    problem: &'a Problem,
    setup: &'a Setup,
    options: &'a SolveOptions,
}

/// Shows the steps of the main solves to the callback, but not those of additional passes.
struct Steps<'s>(&'s StepSender);

impl Watcher for Steps<'_> {
    fn observer(&mut self, pass: Pass<'_>) -> Box<dyn Observer + '_> {
        match pass {
            Pass::Grid(_) | Pass::Solve(..) | Pass::State(..) => Box::new(self.0.clone()),
            Pass::Reference(_) | Pass::Stick(_) => Box::new(self.0.silent()),
        }
    }
}

#[pymethods]
impl Problem {
    /// Solves the problem. The contact is returned whether the solver converged or not, with a warning if it did not; a list of loads, a path,
    /// several speeds or rolling return a History.
    ///
    /// `solver` is "multilevel", "polonsky-keer" or "gfmd", or a dictionary with its method and settings, or a function of the problem that
    /// yields one pressure after the other. It stops at a certificate `eta <= tolerance` (1e-8); with a pressure_tolerance it also waits for this bound of the relative
    /// error of the pressure. With refine="auto" the grid is refined until the estimated errors of area and kappa_r are
    /// below area_tolerance (0.01). callback(step) is called with every step and ends the run by returning False.
    /// `start` is a pressure to start from. `record` is the file of a recording, `live` shows it in the installed
    /// viewer, `stream` is a callable that takes it as bytes, piece by piece. With diagnose=True the problem is solved
    /// twice, and Contact.diagnosis states why the solver is slow.
    #[pyo3(signature = (**options), text_signature = "($self, *, solver='multilevel', tolerance=1e-8, pressure_tolerance=None, max_iterations=100000, refine=None, area_tolerance=None, start=None, callback=None, record=None, recording=None, live=False, stream=None, diagnose=False)")]
    pub fn solve(&self, py: Python<'_>, options: Option<&Bound<'_, PyDict>>) -> PyResult<Py<PyAny>> {
        let (options, setup) = SolveOptions::from_keywords(options, &self.setup, self.problem.surface().grid())?;
        let solve = Solve { problem: self, setup: &setup, options: &options };
        match setup.setup.drive_of_states().map_err(py_error)? {
            Some(_) => Ok(solve.history(py)?.into_any()),
            None => Ok(Py::new(py, solve.contact(py)?)?.into_any()),
        }
    }
}

#[pymethods]
impl Setup {
    /// Solves the setup, with its own solver unless another one is given. The keywords are those of Problem.solve. It
    /// returns a Contact, or a History if the setup has a list of loads, a path, several speeds or rolling.
    #[pyo3(signature = (**options), text_signature = "($self, *, solver=None, tolerance=None, pressure_tolerance=None, max_iterations=None, refine=None, area_tolerance=None, start=None, callback=None, record=None, recording=None, live=False, stream=None, diagnose=False)")]
    fn solve(&self, py: Python<'_>, options: Option<&Bound<'_, PyDict>>) -> PyResult<Py<PyAny>> {
        self.problem(py)?.solve(py, options)
    }
}

impl Solve<'_> {
    /// Solves under one load.
    fn contact(&self, py: Python<'_>) -> PyResult<Contact> {
        let Outcome { mut solved, diagnosis } = match &self.options.own_solver {
            Some(own) => self.by_own_solver(py, own)?,
            None => self.in_background(py, |steps| Ok(self.job().run(&mut Steps(steps))?))?,
        };
        let solved = solved.swap_remove(0);
        let stuck = solved.slip.as_ref().map(|slip| &slip.stuck);
        [Some(&solved.contact), stuck]
            .into_iter()
            .flatten()
            .filter_map(warning_of_failure)
            .try_for_each(|it| warn_sentence(py, &it))?;
        if solved.contact.status != Status::StoppedByObserver {
            warn(py, &py.detached(|| solved.warnings())?)?;
        }
        let Solved { setup, contact, slip, .. } = solved;
        let surface = contact.problem.surface().clone();
        let diagnosis = diagnosis.map(|findings| findings.to_string());
        let preparation = self.problem.preparation.clone();
        Ok(Contact { diagnosis, slip, preparation, ..Contact::new(contact, surface, setup, self.problem.rank) })
    }

    /// Solves by a solver that is written in Python. Its exceptions are raised as they are.
    fn by_own_solver(&self, py: Python<'_>, own: &OwnSolver) -> PyResult<Outcome> {
        let pressures = own.begin(py, self.problem)?;
        let (setup, problem, sink) = (&self.setup.setup, &self.problem.problem, &self.options.sink);
        let title = format!("{}, {}", setup.surface.title(problem.surface().grid()), own.name);
        let outcome = self.in_background(py, |steps| {
            let replay = Replay::new(&own.name, GivenField::Pressure, pressures.iter()).endless();
            let job = Job::from_run(JobRun::from_other(&title, setup.clone(), problem.clone(), &replay));
            let job = match sink.target() {
                Some(target) => job.recorded(target),
                None => job,
            };
            Ok(job.run(&mut Steps(steps))?)
        });
        match pressures.exception() {
            Some(exception) => Err(exception),
            None => outcome,
        }
    }

    /// The job that the keywords ask for.
    fn job(&self) -> Job<'_> {
        let SolveOptions { sink, diagnose, start, .. } = self.options;
        let Problem { problem, surface, .. } = self.problem;
        let run = JobRun {
            heights: self.problem.is_array().then(|| surface.clone()),
            problem: Some(problem.clone()),
            ..JobRun::new(self.setup.setup.clone())
        };
        let job = Job::from_run(run).diagnosed(*diagnose).started_from(start.as_ref());
        let job = match self.setup.refinement {
            Some(auto) => job.refined(auto),
            None => job,
        };
        match sink.target() {
            Some(target) => job.recorded(target),
            None => job,
        }
    }

    /// Follows a list of loads or a history.
    fn history(&self, py: Python<'_>) -> PyResult<Py<History>> {
        let SolveOptions { diagnose, start, .. } = self.options;
        let of_one_contact =
            [(*diagnose, "diagnose"), (start.is_some(), "start"), (self.setup.refinement.is_some(), "refine='auto'")];
        if let Some((_, name)) = of_one_contact.iter().find(|(is_given, _)| *is_given) {
            return bail(format!("{name} is for one contact: leave it out of a history"));
        }
        let states = self.setup.setup.expected_states().map_err(py_error)?;
        self.check_fields(FIELDS_OF_STATE * states as f64)?;
        let mut outcome = self.states(py)?;
        if let Some(failure) = outcome.failure.take() {
            return Err(py_error(failure));
        }
        let is_list = outcome.drive.is_list;
        if let Some(error) = outcome.ended.take_if(|it| !matches!(it, HistoryError::Stopped)) {
            if is_list {
                return Err(py_error(StudyError::from(error)));
            }
            warn_sentence(py, &format!("The history ended after {} states: {error}.", outcome.states.len()))?;
        }
        if !is_list {
            warn(py, &outcome.warnings())?;
        }
        let history = History::new(py, outcome, self.problem, self.setup.clone())?;
        if is_list {
            warn_about_loads(py, &history.get().each(py)?)?;
        }
        Ok(history)
    }

    /// The states of a run with several.
    fn states(&self, py: Python<'_>) -> PyResult<HistoryOutcome> {
        let outcome = self.in_background(py, |steps| Ok(self.job().run(&mut Steps(steps))?))?;
        let history = outcome.solved.into_iter().next().and_then(|solved| solved.history);
        history.ok_or_else(|| py_error("the run has no states"))
    }

    /// Does some work in the background, shows its steps to the callback and passes on its recording.
    fn in_background<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut StepSender) -> Result<T, BoxedError> + Send,
    ) -> PyResult<T> {
        let last_error = Mutex::new(f64::INFINITY);
        let on_step = |py: Python<'_>, step: &StepHandle| self.call_back(py, step, &last_error);
        let on_step: Option<&StepCallback<'_>> = if self.options.callback.is_some() { Some(&on_step) } else { None };
        let on_idle = |py: Python<'_>| self.options.sink.flush(py);
        let done = run_in_background(py, Foreground { on_step, on_idle: &on_idle }, work);
        self.options.sink.finish(py)?;
        done?.map_err(py_error)
    }

    /// Calls the callback with a step, and returns whether the run continues.
    fn call_back(&self, py: Python<'_>, step: &StepHandle, last_error: &Mutex<f64>) -> PyResult<bool> {
        let before = *last_error.lock().unwrap_or_else(PoisonError::into_inner);
        let (Some(callback), Some(step)) = (&self.options.callback, Step::new(step, self.problem.rank, before)) else {
            return Ok(true);
        };
        *last_error.lock().unwrap_or_else(PoisonError::into_inner) = step.error();
        let answer = callback.bind(py).call1((step,))?;
        Ok(answer.is_none() || answer.is_truthy()?)
    }

    /// Refuses a grid that does not fit in memory, with some further fields that are kept.
    fn check_fields(&self, kept: f64) -> PyResult<()> {
        let (grid, solver) = (self.problem.problem.surface().grid(), &self.setup.setup.solver);
        let cost = Cost::from_fields(grid, solver.fields(grid, 0.0).max(3.0) + FIELDS + kept);
        cost.check(solver.name()).map_err(py_error)
    }
}

/// Issues warnings about contacts under a list of loads: how many are not found, and unless the run was stopped, which numbers are doubtful.
fn warn_about_loads(py: Python<'_>, contacts: &[Py<Contact>]) -> PyResult<()> {
    let contacts: Vec<&Contact> = contacts.iter().map(Py::get).collect();
    let unfinished = contacts.iter().filter_map(|it| warning_of_failure(&it.contact)).count();
    if unfinished > 0 {
        let loads = contacts.len();
        warn_sentence(
            py,
            &format!(
                "The solver did not converge under {unfinished} of {loads} loads. See the status of the contacts."
            ),
        )?;
    }
    if contacts.iter().any(|it| it.contact.status == Status::StoppedByObserver) {
        return Ok(());
    }
    let warnings = py.detached(|| warnings_about(&contacts))?;
    warn(py, &warnings)
}
