//! Contact problems.

use crate::arrays::in_parentheses;
use crate::conversion::{Sections, section_mut, sections_from_keywords, table_from_sections};
use crate::detached::Detached;
use crate::error::{bail, py_error, unexpected_keyword, wrong_type};
use crate::fork;
use crate::setup::Setup;
use crate::surface::Surface;
use asperity::setup::Key;
use asperity::study::Refinement;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::sync::Arc;

/// Names of the loads.
const LOADS: [&str; 5] = ["mean-pressure", "reduced-pressure", "mean-gap", "force", "approach"];

/// Sections that a problem takes from its surface, its load and its solve, so that they are no keywords.
const OTHERS: [&str; 5] = ["surface", "grid", "load", "solver", "stop"];

/// The sections that are keywords of a problem.
fn sections() -> Vec<&'static str> {
    let mut sections = Vec::new();
    for section in Key::all().map(Key::section) {
        if !OTHERS.contains(&section) && !sections.contains(&section) {
            sections.push(section);
        }
    }
    sections
}

/// A rigid surface pressed on an elastic solid.
///
/// Problem(surface, *, solid=None, law=None, friction=None, adhesion=None, viscoelastic=None, path=None, sliding=None, rolling=None,
/// flow=None, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None, record=None) takes one kind of load: a mean pressure; a
/// reduced pressure, which is the mean pressure divided by rms gradient and contact modulus; a mean gap, a length; a force, which is a force per
/// length of a line; or an approach, a length. A list of loads is solved one load after the other. `solid` is a contact modulus, or a dictionary: contact_modulus, or young and poisson (a number
/// each, or two for two bodies), and for a layer its thickness as layer, and base; a body that yields has yield_stress and hardening_modulus. A solid of your own is a function k(q) or a dictionary with stiffness, the stiffness of each wave: see
/// solve(). `law` is a dictionary with a hardness. `friction` is a
/// dictionary with a coefficient and a tangential load. `adhesion` is a dictionary with work, range, form and method, or with a table.
/// `viscoelastic` is a dictionary with creep or relaxation, pairs of a ratio and a time.
/// `path` holds time, load and tangential, lists of one length; `sliding` a speed or several; `rolling` a creepage or a tangential load, or
/// several: with these, but for a single speed, solve() returns a History. A path may be a file, too, a table with the columns time, load and tangential.
/// `flow` is a dictionary with leakage (true), and resistivity or conductivity (a number for both bodies, or two). `record` holds the keys of the
/// section `record` of a scene.
#[pyclass(frozen, module = "asperity")]
pub struct Problem {
    /// The problem under its load, or under the largest load of a list.
    pub problem: asperity::Problem,
    pub surface: Arc<asperity::Surface>,
    pub setup: Setup,
    pub rank: usize,
    /// The steps of the preparation of its heights.
    pub preparation: Arc<[String]>,
}

impl PartialEq for Problem {
    fn eq(&self, other: &Self) -> bool {
        self.rank == other.rank && self.setup == other.setup && self.surface == other.surface
    }
}

impl Problem {
    /// The problem of a surface that presses as a setup describes.
    pub fn new(py: Python<'_>, surface: &Arc<asperity::Surface>, setup: Setup, rank: usize) -> PyResult<Self> {
        fork::check_not_forked()?;
        if setup.has_loads() && setup.refinement.is_some() {
            return bail("refine='auto' needs one load, but several are given: give one load, or a number for refine");
        }
        let problem = py.try_detached(|| setup.setup.problem_of(surface.clone()))?;
        Ok(Self { problem, surface: surface.clone(), setup, rank, preparation: Arc::default() })
    }

    /// The problem of a surface of Python.
    fn from_surface(py: Python<'_>, surface: &Surface, setup: Setup) -> PyResult<Self> {
        let preparation = surface.preparation.clone();
        Ok(Self { preparation, ..Self::new(py, &surface.surface, setup, surface.rank)? })
    }

    /// The problem under another load.
    pub fn under(&self, problem: asperity::Problem, setup: Setup) -> Self {
        let Self { surface, rank, preparation, .. } = self;
        Self { problem, surface: surface.clone(), setup, rank: *rank, preparation: preparation.clone() }
    }

    /// Whether the heights were given as an array, so that the setup does not describe them.
    pub fn is_array(&self) -> bool {
        Surface::is_array(&self.setup.sections())
    }

    /// The surface as an object of Python.
    fn py_surface(&self) -> Surface {
        let mut sections = self.setup.sections();
        sections.retain(|key, _| key == "surface" || key == "grid");
        let preparation = self.preparation.clone();
        Surface { preparation, ..Surface::from_surface(self.surface.clone(), sections, self.rank) }
    }
}

/// The keywords with the values of a stiffness that is a function or an array over the waves of the grid.
fn with_sampled_solid<'py>(surface: &Surface, keywords: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
    let keywords = keywords.copy()?;
    if let Some(solid) = keywords.get_item("solid")? {
        let grid = surface.surface.grid();
        let (shape, size) = (grid.shape()[2 - surface.rank..].to_vec(), grid.size()[2 - surface.rank..].to_vec());
        let sampled = keywords.py().import("asperity.solids")?.call_method1("sampled", (solid, shape, size))?;
        keywords.set_item("solid", sampled)?;
    }
    Ok(keywords)
}

/// The sections of some keywords, laid over those of a surface. The keywords have a unit for all quantities of a kind, or for none.
fn described(py: Python<'_>, surface: &Surface, keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Sections> {
    let mut given = Sections::new();
    let keywords = keywords.map(|keywords| with_sampled_solid(surface, keywords)).transpose()?;
    for (key, value) in sections_from_keywords(keywords.as_ref())? {
        match key.as_str() {
            section if sections().contains(&section) => {
                given.insert(key, value);
            }
            load if LOADS.contains(&load) => {
                section_mut(&mut given, "load").insert(key, value);
            }
            other => {
                let known = [&sections()[..], &LOADS].concat();
                return Err(unexpected_keyword(py, "Problem", other, &known));
            }
        }
    }
    table_from_sections(&given)?.check_numbers().map_err(py_error)?;
    let mut described = surface.sections.clone();
    described.extend(given);
    Ok(described)
}

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(signature = (surface, **keys), text_signature = "(surface, *, solid=None, law=None, friction=None, adhesion=None, viscoelastic=None, path=None, sliding=None, rolling=None, flow=None, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None, record=None)")]
    fn py_new(surface: Bound<'_, PyAny>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let py = surface.py();
        let surface =
            surface.cast::<Surface>().map_err(|_| wrong_type("surface", "a Surface(height, size)", &surface))?.get();
        Self::from_surface(py, surface, Setup::from_sections(&described(py, surface, keys)?)?)
    }

    /// The same problem under another load, or under a list of loads.
    #[pyo3(signature = (**load), text_signature = "($self, *, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None)")]
    fn with_load(&self, py: Python<'_>, load: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut sections = self.setup.sections();
        let load = sections_from_keywords(load)?;
        if let Some(other) = load.keys().find(|key| !LOADS.contains(&key.as_str())) {
            return Err(unexpected_keyword(py, "with_load", other, &LOADS));
        }
        sections.insert("load".into(), Value::Object(load));
        let setup = Setup::from_sections(&sections)?;
        if setup.setup.feels().attraction {
            // adhesion has loads that no other contact has, such as pulls, and so its problem does not depend on the load
            setup.setup.problem_of(self.surface.clone()).map_err(py_error)?;
            return Ok(self.under(self.problem.clone(), setup));
        }
        let under = |load| self.problem.clone().with_load(load).map_err(py_error);
        setup.setup.loads.iter().try_for_each(|load| under(*load).map(drop))?;
        if let (Some(friction), None) = (setup.setup.friction, setup.setup.drive().map_err(py_error)?) {
            friction.ratio(setup.setup.load).map_err(py_error)?;
        }
        Ok(self.under(under(setup.setup.load)?, setup))
    }

    /// The surface.
    #[getter]
    fn surface(&self) -> Surface {
        self.py_surface()
    }

    /// The setup that describes the problem. Heights that were given as an array have the name array.npy in it.
    #[getter]
    fn setup(&self) -> Setup {
        self.setup.clone()
    }

    /// Contact modulus, a pressure. It is 1 where pressures are given in units of the contact modulus.
    #[getter]
    fn contact_modulus(&self) -> f64 {
        self.problem.contact_modulus()
    }

    /// Root mean square of the heights about their mean, a length.
    #[getter]
    fn rms_height(&self) -> f64 {
        self.problem.rms_height()
    }

    /// Root-mean-square gradient of the surface.
    #[getter]
    fn rms_gradient(&self) -> f64 {
        self.problem.rms_gradient()
    }

    /// The prescribed mean pressure, also if it is given as a reduced pressure or a force. None under a mean gap or an
    /// approach.
    #[getter]
    fn mean_pressure(&self) -> Option<f64> {
        self.problem.mean_pressure()
    }

    fn __eq__(&self, other: &Self) -> bool {
        self == other
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Surface, Setup))> {
        let it = slf.get();
        Ok((slf.get_type().getattr("_from_parts")?, (it.py_surface(), it.setup.clone())))
    }

    /// The problem that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(py: Python<'_>, surface: &Surface, setup: Setup) -> PyResult<Self> {
        Self::from_surface(py, surface, setup)
    }

    fn __repr__(&self) -> String {
        let grid = self.problem.surface().grid();
        let points = &grid.shape()[2 - self.rank..];
        let loads = match self.setup.setup.loads.len() {
            0 => self.problem.load().to_string(),
            several => format!("{several} loads"),
        };
        format!(
            "Problem(shape={}, contact_modulus={:e}, {loads})",
            in_parentheses(points),
            self.problem.contact_modulus()
        )
    }
}

#[pymethods]
impl Setup {
    /// The problem that the setup describes. If the grid is automatic, it is the problem on the first grid.
    pub fn problem(&self, py: Python<'_>) -> PyResult<Problem> {
        let mut first = self.clone();
        if let Some(auto) = self.refinement {
            let setups = Refinement::new(self.setup.clone(), auto);
            first.setup = setups.setups().next().unwrap_or_else(|| self.setup.clone());
        }
        let surface = first.surface(py)?;
        Problem::from_surface(py, &surface, first)
    }
}
