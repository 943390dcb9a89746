//! Keywords of a solve.

use crate::arrays::{ArrayLike, field_on};
use crate::conversion::{Sections, section_mut, table_from_sections, value_from_py};
use crate::error::{argument, bail, error_in_solve, py_error, unexpected_keyword, wrong_type};
use crate::own_solver::OwnSolver;
use crate::setup::Setup;
use crate::sink::{NOTHING_RECORDED, RecordingSink};
use asperity::grid::Grid;
use asperity::setup::Part;
use asperity::surface::Field;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The options of a solve, in addition to its setup.
#[derive(Default)]
pub struct SolveOptions {
    /// Called with every step.
    pub callback: Option<Py<PyAny>>,
    /// Where the recording goes.
    pub sink: RecordingSink,
    /// Whether the contact is solved twice, to find out why the solver is slow.
    pub diagnose: bool,
    /// A pressure to start from.
    pub start: Option<Field>,
    /// A solver that is written in Python.
    pub own_solver: Option<OwnSolver>,
    /// Whether it is said what is recorded.
    has_recording: bool,
}

/// All keywords of a solve.
const KEYWORDS: [&str; 13] = [
    "solver",
    "tolerance",
    "pressure_tolerance",
    "max_iterations",
    "refine",
    "area_tolerance",
    "start",
    "callback",
    "record",
    "recording",
    "live",
    "stream",
    "diagnose",
];

impl SolveOptions {
    /// The options of some keywords, and the setup with the solver, the stop and the refinement that they name.
    pub fn from_keywords(keywords: Option<&Bound<'_, PyDict>>, setup: &Setup, grid: &Grid) -> PyResult<(Self, Setup)> {
        let (mut options, mut sections) = (Self::default(), setup.sections());
        for (key, it) in keywords.into_iter().flatten().filter(|(_, it)| !it.is_none()) {
            options.read(&key.extract::<String>()?, &it, &mut sections, grid.shape())?;
        }
        let given = setup.setup.path.as_ref().and_then(|path| path.file.clone());
        let mut setup = Setup::from_table(table_from_sections(&sections)?).map_err(error_in_solve)?;
        if let Some(path) = &mut setup.setup.path {
            path.file = given; // the sections have its lists instead
        }
        setup.setup.check_on(grid).map_err(py_error)?;
        options.sink.check(&setup.setup)?;
        if options.has_recording && !options.sink.is_active() {
            return bail(NOTHING_RECORDED);
        }
        options.check(&setup)?;
        Ok((options, setup))
    }

    fn read(&mut self, key: &str, it: &Bound<'_, PyAny>, sections: &mut Sections, shape: [usize; 2]) -> PyResult<()> {
        match key {
            "solver" if it.is_callable() => self.own_solver = Some(OwnSolver::new(it)?),
            "solver" => {
                sections.insert(key.into(), value_from_py(it, key)?);
            }
            "tolerance" | "pressure_tolerance" | "max_iterations" => {
                section_mut(sections, "stop").insert(key.replace('_', "-"), value_from_py(it, key)?);
            }
            "refine" => {
                let refine = value_from_py(it, key)?;
                if refine != "auto" {
                    return bail(format!("refine is {}: give 'auto' here, or a number to the surface", it.repr()?));
                }
                section_mut(sections, "grid").insert(key.into(), refine);
            }
            "area_tolerance" => {
                section_mut(sections, "grid").insert("area-tolerance".into(), value_from_py(it, key)?);
            }
            "recording" => {
                self.has_recording = true;
                sections.insert("record".into(), value_from_py(it, key)?);
            }
            "callback" if !it.is_callable() => return Err(wrong_type(key, "a callable that takes a Step", it)),
            "callback" => self.callback = Some(it.clone().unbind()),
            "record" => self.sink.path = Some(argument(it, key, "the name of a file")?),
            "live" => self.sink.is_live = argument(it, key, "True or False")?,
            "stream" => self.sink.stream_to(it)?,
            "diagnose" => self.diagnose = argument(it, key, "True or False")?,
            "start" => self.start = Some(field_on(&ArrayLike::new(it, key)?, shape, "pressure to start from")?),
            other => return Err(unexpected_keyword(it.py(), "solve", other, &KEYWORDS)),
        }
        Ok(())
    }

    /// Refuses what a solver in Python cannot do.
    fn check_own_solver(&self, setup: &Setup) -> PyResult<()> {
        let refused = [
            ("diagnose", self.diagnose, "use a Recorder, which has a diagnosis"),
            ("start", self.start.is_some(), "start your function where you like"),
            ("refine='auto'", setup.refinement.is_some(), "give a Surface with the grid that you need"),
            ("a list of loads", setup.has_loads(), "solve under one load after the other"),
            ("friction", setup.setup.friction.is_some(), "choose multilevel"),
            ("a history", setup.setup.is_history().map_err(py_error)?, "leave the solver out"),
        ];
        match refused.into_iter().find(|(_, is_given, _)| *is_given) {
            Some((what, _, instead)) => bail(format!("a solver of your own cannot have {what}: {instead}")),
            None => Ok(()),
        }
    }

    /// Refuses options that are only valid for one load, or for a given grid.
    fn check(&self, setup: &Setup) -> PyResult<()> {
        if self.own_solver.is_some() {
            self.check_own_solver(setup)?;
        }
        let only_once = [
            ("live and stream show", self.sink.is_live || self.sink.is_streamed()),
            ("diagnose needs", self.diagnose),
            ("start needs", self.start.is_some()),
            ("friction needs", setup.setup.friction.is_some()),
        ];
        let is_several = setup.has_loads() || setup.setup.is_history().map_err(py_error)?;
        if let Some(part) = setup.setup.record.what.iter().find(|part| is_several && Part::OF_A_RUN.contains(part)) {
            let part = part.name();
            return bail(format!(
                "the recording part {part} shows the steps of one solve, but there are several: leave it out"
            ));
        }
        match only_once.iter().find(|(_, is_given)| *is_given) {
            Some((what, _)) if setup.has_loads() => {
                bail(format!("{what} one load, but a list of loads is given: give one load"))
            }
            _ if setup.has_loads() && setup.refinement.is_some() => {
                bail("refine='auto' needs one load, but a list of loads is given: give one load")
            }
            _ if self.start.is_some() && setup.refinement.is_some() => {
                bail("start needs one grid, but refine='auto' uses several: leave one of them out")
            }
            _ => Ok(()),
        }
    }
}
