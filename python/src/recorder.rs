//! The recorder of any solver.

use crate::contact::Contact;
use crate::field::{Given, list, rows_on};
use crate::problem::Problem;
use crate::process;
use crate::refusal::{Fault, refuse, refused};
use crate::target::Target;
use crate::value::{section, sections_of, setup, value};
use crate::watch::{Sight, watched};
use asperity::contact::{Multilevel, Solver, Stop};
use asperity::diagnosis::{Diagnosis, Findings, Reference};
use asperity::error::{Failure, FileError};
use asperity::foreign::{Distance, Distances, Frame, Quantity, Replay};
use asperity::record::{Options, Parts, Recording, Scene};
use asperity::setup::Setup;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The certificate of the reference.
const REFERENCE: f64 = 1e-12;
/// Steps on their way to the thread that records them.
const WAITING: usize = 2;

/// The instrument for any solver: each pressure (or gap, or displacement) that it is shown is certified, compared with the solution and
/// recorded like those of our own solvers.
///
/// with Recorder(problem, "mine.rrd") as r: r.step(pressure) for each step of your loop. Seconds are those between the steps, without
/// those of the recorder, unless they are given. quantity is "pressure", "gap" or "displacement"; without a path nothing is written, and
/// the numbers remain; live shows the steps in the installed viewer; stream is a callable that takes the recording as bytes, piece by piece as
/// it grows, such as asperity.notebook.Viewer(). The solution to compare with is found first, by multilevel to 1e-12,
/// unless reference is False.
#[pyclass(frozen, module = "asperity")]
pub struct Recorder {
    job: Arc<Job>,
    state: Mutex<State>,
}

/// A number of each step.
type Column = fn(&Distance) -> f64;

/// What is recorded, and how.
struct Job {
    problem: asperity::Problem,
    pressed: Arc<asperity::Surface>,
    setup: Setup,
    rank: usize,
    name: String,
    quantity: Quantity,
    target: Target,
    is_compared: bool,
}

/// Where a recorder stands.
#[derive(Default)]
struct State {
    at_work: Option<AtWork>,
    told: Option<Told>,
}

/// A recorder that takes steps.
struct AtWork {
    frames: SyncSender<Frame>,
    thread: JoinHandle<Result<Done, Fault>>,
    since: Instant,
    /// Time that the recorder itself took.
    own: Duration,
}

/// What comes out of a recorder.
struct Done {
    contact: asperity::Contact,
    distances: Vec<Distance>,
    findings: Findings,
}

/// What came out, for Python.
struct Told {
    contact: Py<Contact>,
    distances: Vec<Distance>,
    findings: String,
}

impl Job {
    /// Certifies and records all frames.
    fn carry_out(
        &self,
        reference: Option<asperity::Contact>,
        frames: impl Iterator<Item = Frame>,
    ) -> Result<Done, Fault> {
        let problem = &self.problem;
        let end = reference.as_ref().map(|contact| Arc::new(Reference::of(contact)));
        let mut diagnosis = Diagnosis::new(problem, end.clone());
        let mut distances = reference.as_ref().map(Distances::new);
        let recording = self.recording(end)?;
        let mut recorder = recording.as_ref().map(|recording| recording.recorder(0));
        let replay = Replay::new(&self.name, self.quantity, frames.map(Ok::<_, Failure>));
        let mut seen = (&mut recorder, &mut diagnosis, &mut distances);
        let mut contact = replay.solve(problem, &self.setup.stop, &mut seen)?;
        drop(recorder);
        if let Some(Err(failure)) = recording.map(Recording::finish) {
            contact.fail(failure);
        }
        if let Some(fault) = contact.fault().filter(|_| contact.failure.is_some()) {
            return Err(fault.into());
        }
        let distances = distances.map(|distances| distances.steps).unwrap_or_default();
        Ok(Done { contact, distances, findings: diagnosis.findings() })
    }

    fn recording(&self, end: Option<Arc<Reference>>) -> Result<Option<Recording>, FileError> {
        let mut options = Options::from(&self.setup.record);
        if self.setup.record.what.is_empty() {
            options.what = Parts::OF_OTHERS;
        }
        let title = format!("{}, {}", self.setup.surface.title(self.problem.surface().grid()), self.name);
        // no setup: it would name a solver that has not made this
        let scenes = [Scene { title, reference: end, ..Scene::new("contact", &self.problem) }];
        self.target.recording(&scenes, || options)
    }
}

impl Recorder {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for all that is on its way, and keeps what came out.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        let Some(AtWork { frames, thread, .. }) = self.state().at_work.take() else { return Ok(()) };
        drop(frames);
        let done = py.detach(|| thread.join()).unwrap_or_else(|panic| resume_unwind(panic));
        let streamed = self.job.target.finish(py);
        let Done { contact, distances, findings } = done.map_err(refused)?;
        let Job { pressed, setup, rank, .. } = &*self.job;
        let (pressed, setup, told) = (pressed.clone(), setup.clone(), findings.to_string());
        let contact = Contact { contact, pressed, setup, rank: *rank, diagnosis: Some(findings) };
        self.state().told = Some(Told { contact: Py::new(py, contact)?, distances, findings: told });
        streamed
    }

    /// Something of what came out.
    fn told<T>(&self, of: impl FnOnce(&Told) -> PyResult<T>) -> PyResult<T> {
        match &self.state().told {
            Some(told) => of(told),
            None => refuse("the recorder is not done: ask it after its `with` block"),
        }
    }
}

#[pymethods]
impl Recorder {
    #[new]
    #[pyo3(signature = (problem, path=None, *, name="mine", quantity="pressure", reference=true, live=false, stream=None, recording=None))]
    #[allow(clippy::too_many_arguments, reason = "these are keywords")]
    fn new(
        problem: &Problem,
        path: Option<PathBuf>,
        name: &str,
        quantity: &str,
        reference: bool,
        live: bool,
        stream: Option<&Bound<'_, PyAny>>,
        recording: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut target = Target::new(path, live);
        stream.map_or(Ok(()), |stream| target.stream_to(stream))?;
        target.check()?;
        let Some(quantity) = Quantity::named(quantity) else {
            return refuse(format!("there is no quantity {quantity:?}: give pressure, gap or displacement"));
        };
        let mut sections = sections_of(&problem.setup);
        if let Some(recording) = recording {
            *section(&mut sections, "record") = value(recording, "recording")?.as_object().cloned().unwrap_or_default();
        }
        let job = Job {
            problem: problem.problem.clone(),
            pressed: problem.pressed.clone(),
            setup: setup(&sections)?,
            rank: problem.rank,
            name: name.into(),
            quantity,
            target,
            is_compared: reference,
        };
        Ok(Self { job: job.into(), state: Mutex::default() })
    }

    fn __enter__(slf: Bound<'_, Self>) -> PyResult<Bound<'_, Self>> {
        process::check()?;
        let (py, job) = (slf.py(), slf.get().job.clone());
        let reference = match job.is_compared {
            true => {
                let stop = Stop::new(REFERENCE, Stop::default().max_iterations()).map_err(refused)?;
                Some(watched(py, Sight::NONE, |watch| Multilevel.solve(&job.problem, &stop, watch))?.map_err(refused)?)
            }
            false => None,
        };
        let (frames, given) = sync_channel(WAITING);
        let thread = thread::spawn(move || job.carry_out(reference, given.into_iter()));
        let at_work = AtWork { frames, thread, since: Instant::now(), own: Duration::ZERO };
        *slf.get().state() = State { at_work: Some(at_work), told: None };
        Ok(slf)
    }

    /// Shows a step: values of the quantity, of the shape of the heights, and the seconds from the start if they are known better.
    #[pyo3(signature = (values, seconds=None))]
    fn step(&self, py: Python<'_>, values: Given<'_>, seconds: Option<f64>) -> PyResult<()> {
        let began = Instant::now();
        let Job { problem, quantity, .. } = &*self.job;
        let field = rows_on(&values, problem.surface().grid().shape(), quantity.name())?;
        let (frames, clock) = match &self.state().at_work {
            Some(it) => (it.frames.clone(), (began - it.since).saturating_sub(it.own).as_secs_f64()),
            None => {
                return refuse(
                    "the recorder is not at work: use it as `with Recorder(problem, path) as r: r.step(...)`",
                );
            }
        };
        let frame = Frame { values: field.into_raw_vec_and_offset().0, seconds: Some(seconds.unwrap_or(clock)) };
        let sent = py.detach(|| frames.send(frame));
        drop(frames);
        match sent {
            Ok(()) => self.job.target.pass_on(py)?,
            // the thread has ended before its time, and says why
            Err(_) => self.finish(py)?,
        }
        if let Some(at_work) = &mut self.state().at_work {
            at_work.own += began.elapsed();
        }
        Ok(())
    }

    #[pyo3(signature = (*_raised))]
    fn __exit__(&self, py: Python<'_>, _raised: &Bound<'_, pyo3::types::PyTuple>) -> PyResult<bool> {
        self.finish(py)?;
        Ok(false)
    }

    /// The contact of the last step, with tension clipped and the load restored.
    #[getter]
    fn contact(&self, py: Python<'_>) -> PyResult<Py<Contact>> {
        self.told(|told| Ok(told.contact.clone_ref(py)))
    }

    /// How far each step is from the solution, as arrays by name: step, seconds, certificate (eta), pressure_error (relative, by root mean
    /// squares) and energy_error (relative, in the energy norm). They are empty without a reference.
    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns: [(&str, Column); 5] = [
            ("step", |it| it.step as f64),
            ("seconds", |it| it.seconds),
            ("certificate", |it| it.certificate),
            ("pressure_error", |it| it.pressure_error),
            ("energy_error", |it| it.energy_error),
        ];
        self.told(|told| {
            let table = PyDict::new(py);
            let column = |of: Column| list(py, told.distances.iter().map(of).collect());
            columns.into_iter().try_for_each(|(name, of)| table.set_item(name, column(of)))?;
            Ok(table)
        })
    }

    /// What held the solver up, in words: slow wavelengths, nodes that flip, plateaus, contacts that come back.
    #[getter]
    fn diagnosis(&self) -> PyResult<String> {
        self.told(|told| Ok(told.findings.clone()))
    }
}
