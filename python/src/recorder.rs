//! The recorder for solvers of other codes.

use crate::arrays::{ArrayLike, field_on, vector};
use crate::background::{Foreground, StepSender, run_in_background};
use crate::contact::Contact;
use crate::conversion::{table_from_sections, value_from_py};
use crate::detached::{Detached, fault};
use crate::error::{BoxedError, bail, error_in_solve, py_error, wrong_type};
use crate::fork;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::sink::{NOTHING_RECORDED, RecordingSink};
use asperity::contact::{Multilevel, Solver, Stop};
use asperity::diagnosis::{Diagnosis, Findings, Reference};
use asperity::error::Failure;
use asperity::foreign::{Distance, Distances, Frame, GivenField, Replay};
use asperity::job::{Job, JobRun, ShowSteps};
use asperity::setup;
use asperity::surface::Field;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};
use std::path::PathBuf;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The tolerance of the reference solution.
const REFERENCE_TOLERANCE: f64 = 1e-12;
/// Steps that wait for the thread that records them.
const QUEUE_LENGTH: usize = 2;

/// Records the steps of any solver: each pressure (or gap, or displacement) is certified, compared with the solution and written like a step of
/// the solvers of this package.
///
/// Use it as `with Recorder(problem, "mine.rrd") as r:` and call r.step(pressure) in every step of your loop. `name` is the name of your solver.
/// `quantity` is "pressure", "gap" or "displacement". Seconds are measured between the steps, without the time of the recorder, unless they are
/// given. Without a path nothing is written, and the numbers remain. `live` shows the steps in the installed viewer. `stream` is a callable that
/// takes the recording as bytes, piece by piece, such as asperity.notebook.Viewer(). The solution to compare with is solved first, by multilevel
/// to 1e-12, unless `reference` is False, or a pressure to compare with.
#[pyclass(frozen, module = "asperity")]
pub struct Recorder {
    plan: Arc<Plan>,
    state: Mutex<RecorderState>,
}

/// A number of each step.
type DistanceColumn = fn(&Distance) -> f64;

/// What is recorded, and how.
struct Plan {
    problem: asperity::Problem,
    surface: Arc<asperity::Surface>,
    setup: setup::Setup,
    rank: usize,
    name: String,
    quantity: GivenField,
    sink: RecordingSink,
    reference: Target,
}

/// What the steps are compared with.
enum Target {
    Nothing,
    Solution,
    Pressure(Field),
}

/// The state of a recorder: before, in and after its `with` block.
#[derive(Default)]
struct RecorderState {
    running: Option<Running>,
    finished: Option<Finished>,
}

/// A recorder that takes steps.
struct Running {
    frames: SyncSender<Frame>,
    thread: JoinHandle<Result<Output, BoxedError>>,
    start: Instant,
    /// Time that the recorder itself took.
    own_time: Duration,
    /// Seconds of the last step, if there is one.
    last: Option<f64>,
}

impl Running {
    /// The seconds of the next step, which do not go back.
    fn next_time(&mut self, seconds: f64) -> PyResult<f64> {
        let least = self.last.unwrap_or(0.0);
        if !(seconds.is_finite() && seconds >= least) {
            let seconds = seconds.to_string().to_lowercase();
            return bail(format!("seconds is {seconds}: give the seconds since the start, {least} or more"));
        }
        self.last = Some(seconds);
        Ok(seconds)
    }
}

/// The results of the thread that records.
struct Output {
    contact: asperity::Contact,
    distances: Vec<Distance>,
    findings: Findings,
}

/// The results for Python.
struct Finished {
    contact: Py<Contact>,
    distances: Vec<Distance>,
    /// Why the solver is slow; none without a reference.
    findings: Option<String>,
}

impl Plan {
    /// Certifies and records all frames.
    fn run(
        &self,
        reference: Option<asperity::Contact>,
        frames: impl Iterator<Item = Frame>,
    ) -> Result<Output, BoxedError> {
        let problem = &self.problem;
        let end = reference.as_ref().map(|contact| Arc::new(Reference::from_contact(contact)));
        let mut diagnosis = Diagnosis::new(problem, end.clone());
        let mut distances = reference.as_ref().map(Distances::new);
        let replay = Replay::new(&self.name, self.quantity, frames.map(Ok::<_, Failure>));
        let title = format!("{}, {}", self.setup.surface.title(problem.surface().grid()), self.name);
        let steps = JobRun::from_other(&title, self.setup.clone(), problem.clone(), &replay);
        let job = Job::from_run(JobRun { reference: end, ..steps });
        let job = match self.sink.target() {
            Some(target) => job.recorded(target),
            None => job,
        };
        let outcome = job.run(&mut ShowSteps(&mut (&mut diagnosis, &mut distances)))?;
        let contact = outcome.solved.into_iter().next().expect("a job solves its run").contact;
        if let Some(fault) = contact.fault().filter(|_| contact.failure.is_some()) {
            return Err(fault.into());
        }
        let distances = distances.map(|distances| distances.steps).unwrap_or_default();
        Ok(Output { contact, distances, findings: diagnosis.findings() })
    }
}

impl Recorder {
    fn state(&self) -> MutexGuard<'_, RecorderState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until all steps are recorded, and keeps the results.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        let Some(Running { frames, thread, last, .. }) = self.state().running.take() else { return Ok(()) };
        drop(frames);
        let output = py.detach(|| thread.join());
        let streamed = self.plan.sink.finish(py);
        let Output { contact, distances, findings } = output.map_err(|panic| fault(&*panic))?.map_err(py_error)?;
        let Plan { surface, setup, rank, .. } = &*self.plan;
        if last.is_none() {
            return streamed;
        }
        let (surface, setup) = (surface.clone(), setup.clone());
        let diagnosis = (!matches!(self.plan.reference, Target::Nothing)).then(|| findings.to_string());
        let findings = diagnosis.clone();
        let contact = Contact { diagnosis, ..Contact::new(contact, surface, setup, *rank) };
        self.state().finished = Some(Finished { contact: Py::new(py, contact)?, distances, findings });
        streamed
    }

    /// A part of the results.
    fn result<T>(&self, of: impl FnOnce(&Finished) -> PyResult<T>) -> PyResult<T> {
        match &self.state().finished {
            Some(finished) => of(finished),
            None => {
                bail("the recorder has no results: record steps in its `with` block, and read the results after it")
            }
        }
    }
}

#[pymethods]
impl Recorder {
    #[new]
    #[pyo3(signature = (problem, path=None, *, name="mine", quantity="pressure", reference=None, live=false, stream=None, recording=None), text_signature = "(problem, path=None, *, name='mine', quantity='pressure', reference=True, live=False, stream=None, recording=None)")]
    #[allow(clippy::too_many_arguments, reason = "these are keywords")]
    fn new(
        problem: Bound<'_, PyAny>,
        path: Option<PathBuf>,
        name: &str,
        quantity: &str,
        reference: Option<&Bound<'_, PyAny>>,
        live: bool,
        stream: Option<&Bound<'_, PyAny>>,
        recording: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let problem = problem.cast::<Problem>().map_err(|_| wrong_type("problem", "a Problem", &problem))?.get();
        let mut sink = RecordingSink::new(path, live);
        stream.map_or(Ok(()), |stream| sink.stream_to(stream))?;
        sink.check(&problem.setup.setup)?;
        let Ok(quantity) = quantity.parse::<GivenField>() else {
            return bail(format!("there is no quantity {quantity:?}: give pressure, gap or displacement"));
        };
        if problem.setup.has_loads() {
            return bail("a recording shows the steps under one load, but a list of loads is given: give one load");
        }
        let mut sections = problem.setup.sections();
        if let Some(recording) = recording {
            if !sink.is_active() {
                return bail(NOTHING_RECORDED);
            }
            sections.insert("record".into(), value_from_py(recording, "recording")?);
        }
        let reference = match reference {
            None => Target::Solution,
            Some(it) if it.is_instance_of::<PyBool>() => {
                if it.extract()? {
                    Target::Solution
                } else {
                    Target::Nothing
                }
            }
            Some(pressure) => {
                let shape = problem.problem.surface().grid().shape();
                Target::Pressure(field_on(&pressure.extract()?, shape, "pressure of the reference")?)
            }
        };
        let plan = Plan {
            problem: problem.problem.clone(),
            surface: problem.surface.clone(),
            setup: Setup::from_table(table_from_sections(&sections)?).map_err(error_in_solve)?.setup,
            rank: problem.rank,
            name: name.into(),
            quantity,
            sink,
            reference,
        };
        Ok(Self { plan: plan.into(), state: Mutex::default() })
    }

    fn __enter__(slf: Bound<'_, Self>) -> PyResult<Bound<'_, Self>> {
        fork::check_not_forked()?;
        let (py, plan) = (slf.py(), slf.get().plan.clone());
        let stop = Stop::new(REFERENCE_TOLERANCE, Stop::default().max_iterations()).map_err(py_error)?;
        let reference = match &plan.reference {
            Target::Pressure(given) => {
                let of_given = || of_pressure(&plan.problem, given.clone(), &stop, "the reference");
                Some(py.try_detached(of_given)?)
            }
            Target::Solution => {
                let solve = |steps: &mut StepSender| Multilevel.solve(&plan.problem, &stop, steps);
                Some(run_in_background(py, Foreground::IDLE, solve)?.map_err(py_error)?)
            }
            Target::Nothing => None,
        };
        let (frames, given) = sync_channel(QUEUE_LENGTH);
        let thread = thread::spawn(move || plan.run(reference, given.into_iter()));
        let running = Running { frames, thread, start: Instant::now(), own_time: Duration::ZERO, last: None };
        *slf.get().state() = RecorderState { running: Some(running), finished: None };
        Ok(slf)
    }

    /// Records a step: values of the quantity, of the shape of the heights, and the seconds since the start if you measure them yourself.
    #[pyo3(signature = (values, seconds=None))]
    fn step(&self, py: Python<'_>, values: Bound<'_, PyAny>, seconds: Option<f64>) -> PyResult<()> {
        let began = Instant::now();
        let Plan { problem, quantity, .. } = &*self.plan;
        let values = ArrayLike::new(&values, "values")?;
        let field = field_on(&values, problem.surface().grid().shape(), quantity.name())?;
        let (frames, seconds) = match &mut self.state().running {
            Some(it) => {
                let clock = (began - it.start).saturating_sub(it.own_time).as_secs_f64();
                (it.frames.clone(), it.next_time(seconds.unwrap_or(clock))?)
            }
            None => {
                return bail("the recorder is not running: use it as `with Recorder(problem, path) as r: r.step(...)`");
            }
        };
        let frame = Frame { values: field.into_raw_vec_and_offset().0, seconds: Some(seconds) };
        let sent = py.detach(|| frames.send(frame));
        drop(frames);
        match sent {
            Ok(()) => self.plan.sink.flush(py)?,
            // the thread has ended early, and its error says why
            Err(_) => self.finish(py)?,
        }
        if let Some(running) = &mut self.state().running {
            running.own_time += began.elapsed();
        }
        Ok(())
    }

    #[pyo3(signature = (*_exception))]
    fn __exit__(&self, py: Python<'_>, _exception: &Bound<'_, pyo3::types::PyTuple>) -> PyResult<bool> {
        self.finish(py)?;
        Ok(false)
    }

    /// The contact of the last step, with tension set to zero and the load restored.
    #[getter]
    fn contact(&self, py: Python<'_>) -> PyResult<Py<Contact>> {
        self.result(|it| Ok(it.contact.clone_ref(py)))
    }

    /// The distance of each step from the solution, as arrays by name: step, seconds, certificate (eta), pressure_error (relative, root mean
    /// square) and energy_error (relative, in the energy norm). The arrays are empty without a reference.
    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns: [(&str, DistanceColumn); 5] = [
            ("step", |it| it.step as f64),
            ("seconds", |it| it.seconds),
            ("certificate", |it| it.certificate),
            ("pressure_error", |it| it.pressure_error),
            ("energy_error", |it| it.energy_error),
        ];
        self.result(|it| {
            let table = PyDict::new(py);
            let column = |of: DistanceColumn| vector(py, it.distances.iter().map(of).collect());
            columns.into_iter().try_for_each(|(name, of)| table.set_item(name, column(of)))?;
            Ok(table)
        })
    }

    /// Why the solver is slow, in words: slow wavelengths, nodes that change their state often, plateaus, contact sets
    /// that recur. None without a reference.
    #[getter]
    fn diagnosis(&self) -> PyResult<Option<String>> {
        self.result(|it| Ok(it.findings.clone()))
    }
}

/// The contact of a problem that has a pressure.
fn of_pressure(
    problem: &asperity::Problem,
    pressure: Field,
    stop: &Stop,
    solver: &str,
) -> Result<asperity::Contact, BoxedError> {
    let frame = Frame { values: pressure.into_iter().collect(), seconds: None };
    let replay = Replay::new(solver, GivenField::Pressure, [Ok(frame)].into_iter());
    Ok(replay.solve(problem, stop, &mut ())?)
}
