//! What is wished for of a solve.

use crate::contact::Contact;
use crate::field::rows_on;
use crate::problem::Problem;
use crate::refusal::{AsperityWarning, Fault, refused};
use crate::step::Step;
use crate::target::Target;
use crate::value::{Sections, section, sections_of, setup, value};
use crate::watch::{Look, Shown, Sight, Watch, watched};
use asperity::contact::Status;
use asperity::diagnosis::{Diagnosis, Findings, Reference};
use asperity::grid::Grid;
use asperity::record::{Options, Recording, Scene};
use asperity::setup::{Cost, Part, Setup};
use asperity::surface::Field;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::CString;
use std::sync::Arc;

/// Fields of a recording or a result that are held besides those of a solver.
const FIELDS: f64 = 4.0;

/// What is wished for of a solve, beside its setup.
#[derive(Default)]
pub struct Wishes {
    callback: Option<Py<PyAny>>,
    target: Target,
    is_diagnosed: bool,
    start: Option<Field>,
}

impl Wishes {
    /// The wishes of some keywords, and the setup with the solver and the stop that they name.
    pub fn of(keys: Option<&Bound<'_, PyDict>>, of: &Setup, grid: &Grid) -> PyResult<(Self, Setup)> {
        let (mut wishes, mut sections) = (Self::default(), sections_of(of));
        for (key, it) in keys.into_iter().flatten().filter(|(_, it)| !it.is_none()) {
            wishes.take(&key.extract::<String>()?, &it, &mut sections, grid.shape())?;
        }
        let setup = setup(&sections)?;
        setup.solver.check().and_then(|()| setup.stop.check()).map_err(refused)?;
        setup.record.check(grid).map_err(refused)?;
        Ok((wishes, setup))
    }

    fn take(&mut self, key: &str, it: &Bound<'_, PyAny>, into: &mut Sections, shape: [usize; 2]) -> PyResult<()> {
        match key {
            "solver" => {
                let solver = value(it, key)?;
                let named = solver.as_str().map(|name| serde_json::json!({ "method": name }));
                into.insert(key.into(), named.unwrap_or(solver));
            }
            "tolerance" | "pressure_tolerance" | "max_iterations" => {
                section(into, "stop").insert(key.replace('_', "-"), value(it, key)?);
            }
            "recording" => {
                into.insert("record".into(), value(it, key)?);
            }
            "callback" => self.callback = Some(it.clone().unbind()),
            "record" => self.target.path = Some(it.extract()?),
            "live" => self.target.is_live = it.extract()?,
            "stream" => self.target.stream_to(it)?,
            "diagnose" => self.is_diagnosed = it.extract()?,
            "start" => self.start = Some(rows_on(&it.extract()?, shape, "pressure to start from")?),
            other => return Err(PyTypeError::new_err(format!("solve() got an unexpected keyword argument '{other}'"))),
        }
        Ok(())
    }

    /// Solves a problem as wished.
    pub fn solve(&self, py: Python<'_>, of: &Problem, setup: Setup) -> PyResult<Contact> {
        let Problem { problem, pressed, rank, .. } = of;
        self.target.check()?;
        let grid = problem.surface().grid();
        let fields = setup.solver.fields(grid, 0.0).max(3.0) + FIELDS;
        Cost::of_fields(grid, fields).check(setup.solver.name()).map_err(refused)?;
        let see = |py: Python<'_>, shown: &Shown| self.see(py, shown, *rank);
        let see: Option<&Look<'_>> = if self.callback.is_some() { Some(&see) } else { None };
        let meanwhile = |py: Python<'_>| self.target.pass_on(py);
        let solved = watched(py, Sight { see, meanwhile: &meanwhile }, |watch| self.run(problem, &setup, watch));
        self.target.finish(py)?;
        let (contact, diagnosis) = solved?.map_err(refused)?;
        let contact = Contact { contact, pressed: pressed.clone(), setup, rank: *rank, diagnosis };
        contact.tell(py)?;
        Ok(contact)
    }

    /// Shows a step to the callback, and returns whether to go on.
    fn see(&self, py: Python<'_>, shown: &Shown, rank: usize) -> PyResult<bool> {
        let (Some(callback), Some(step)) = (&self.callback, Step::of(shown, rank)) else { return Ok(true) };
        let answer = callback.bind(py).call1((step,))?;
        Ok(answer.is_none() || answer.is_truthy()?)
    }

    /// The solve itself, recorded and diagnosed if that is wished for.
    fn run(
        &self,
        problem: &asperity::Problem,
        setup: &Setup,
        watch: &mut Watch,
    ) -> Result<(asperity::Contact, Option<Findings>), Fault> {
        let (solver, stop) = (setup.solver.solver(), &setup.stop);
        let needs_end = self.is_diagnosed || self.target.is_any() && setup.record.what.contains(&Part::Waterfall);
        let end = match needs_end {
            true => Some(Arc::new(Reference::of(&solver.solve(problem, stop, &mut watch.quiet())?))),
            false => None,
        };
        let mut diagnosis = self.is_diagnosed.then(|| Diagnosis::new(problem, end.clone()));
        let scenes = [Scene { reference: end, ..Scene::of(setup, problem) }];
        let recording = self.target.recording(&scenes, || Options::from(&setup.record))?;
        let mut recorder = recording.as_ref().map(|recording| recording.recorder(0));
        let mut seen = (&mut recorder, &mut diagnosis, watch);
        let mut contact = solver.solve_from(self.start.as_ref(), problem, stop, &mut seen)?;
        drop(recorder);
        if let Some(Err(failure)) = recording.map(Recording::finish) {
            contact.fail(failure);
        }
        Ok((contact, diagnosis.map(|diagnosis| diagnosis.findings())))
    }
}

impl Contact {
    /// Raises the failure of a recorder, and warns of a contact that nobody has ended and that did not converge.
    fn tell(&self, py: Python<'_>) -> PyResult<()> {
        match self.contact.fault() {
            Some(fault) if self.contact.failure.is_some() => Err(refused(fault)),
            Some(fault) if self.contact.status != Status::StoppedByObserver => {
                let sentence = CString::new(fault.to_string())?;
                PyErr::warn(py, &py.get_type::<AsperityWarning>(), &sentence, level(py)?)
            }
            _ => Ok(()),
        }
    }
}

/// The level of the stack at which the code stands that called: above the package, whose functions call these.
fn level(py: Python<'_>) -> PyResult<i32> {
    let frame = py.import("sys")?.call_method1("_getframe", (0,))?;
    let module = frame.getattr("f_globals")?.get_item("__name__")?;
    Ok(if module.extract::<String>()? == "asperity" { 2 } else { 1 })
}
