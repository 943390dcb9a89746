//! Contact problems.

use crate::contact::Contact;
use crate::field::Given;
use crate::process;
use crate::refusal::{refuse, refused};
use crate::setup::Setup;
use crate::surface::Surface;
use crate::value::{Sections, section, sections, sections_of, setup};
use crate::verdict::Verdict;
use crate::wishes::Wishes;
use asperity::setup;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};
use std::sync::Arc;

/// Names of the loads.
const LOADS: [&str; 5] = ["mean-pressure", "reduced-pressure", "mean-gap", "force", "approach"];

/// A rigid surface pressed on an elastic solid.
///
/// Problem(surface, *, solid=None, law=None, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None,
/// record=None) takes one load: a mean pressure; a reduced pressure, the mean pressure over rms gradient and contact modulus; a mean
/// gap, a length; a force, of a line per length; or an approach, a length. `solid` is a contact modulus, or a dictionary:
/// contact_modulus, or young and poisson (a number each, or two for two bodies), and of a layer its thickness as layer, and base. `law`
/// is a dictionary with a hardness. `record` are the keys of the section `record` of a scene.
#[pyclass(frozen, module = "asperity")]
pub struct Problem {
    pub problem: asperity::Problem,
    /// The surface of the problem.
    pub pressed: Arc<asperity::Surface>,
    pub setup: setup::Setup,
    pub rank: usize,
}

impl Problem {
    /// The problem of a surface and a setup that describes the rest.
    pub fn made(py: Python<'_>, surface: &Arc<asperity::Surface>, setup: setup::Setup, rank: usize) -> PyResult<Self> {
        process::check()?;
        let problem = py.detach(|| setup.problem_of(surface.clone())).map_err(refused)?;
        Ok(Self { problem, pressed: surface.clone(), setup, rank })
    }
}

/// The sections of some keywords, laid over those of a surface.
pub fn described(surface: &Surface, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Sections> {
    let mut described = surface.sections.clone();
    for (key, value) in keys.map(sections).transpose()?.unwrap_or_default() {
        match key.as_str() {
            "solid" if value.is_number() || value.is_string() => {
                described.insert(key, json!({ "contact-modulus": value }));
            }
            "solid" | "law" | "record" | "solver" | "stop" => {
                described.insert(key, value);
            }
            load if LOADS.contains(&load) => {
                section(&mut described, "load").insert(key, value);
            }
            other => {
                let other = other.replace('-', "_");
                return Err(PyTypeError::new_err(format!("Problem() got an unexpected keyword argument '{other}'")));
            }
        }
    }
    Ok(described)
}

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(signature = (surface, **keys), text_signature = "(surface, *, solid=None, law=None, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None, record=None)")]
    fn new(py: Python<'_>, surface: &Surface, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::made(py, &surface.surface, setup(&described(surface, keys)?)?, surface.rank)
    }

    /// The same problem under another load.
    #[pyo3(signature = (**load), text_signature = "($self, *, mean_pressure=None, reduced_pressure=None, mean_gap=None, force=None, approach=None)")]
    fn with_load(&self, load: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut over = sections_of(&self.setup);
        over.insert("load".into(), Value::Object(load.map(sections).transpose()?.unwrap_or_default()));
        let setup = setup(&over)?;
        let problem = self.problem.clone().with_load(setup.load).map_err(refused)?;
        Ok(Self { problem, pressed: self.pressed.clone(), setup, rank: self.rank })
    }

    /// Solves the problem; the contact comes back whether the run converged or not, with a warning if it did not.
    ///
    /// solver is "multilevel", "polonsky-keer" or "gfmd", or a dictionary with its method and settings; it stops at a certificate
    /// `eta <= tolerance` (1e-8), and with a pressure_tolerance at a bound of the relative error of the pressure as well. callback(step)
    /// sees every step and ends the run by returning False. start is a pressure to start from. record is the file of a recording, live
    /// shows it in the installed viewer, stream is a callable that takes it as bytes, piece by piece as it grows. With diagnose the problem is solved twice, and the contact says what held the solver up.
    #[pyo3(signature = (**wishes), text_signature = "($self, *, solver='multilevel', tolerance=1e-8, pressure_tolerance=None, max_iterations=100000, start=None, callback=None, record=None, recording=None, live=False, stream=None, diagnose=False)")]
    pub fn solve(&self, py: Python<'_>, wishes: Option<&Bound<'_, PyDict>>) -> PyResult<Contact> {
        let (wishes, setup) = Wishes::of(wishes, &self.setup, self.problem.surface().grid())?;
        wishes.solve(py, self, setup)
    }

    /// Certifies somebody's result, one of pressure (positive in compression), gap or displacement (lengths).
    #[pyo3(signature = (*, pressure=None, gap=None, displacement=None))]
    fn certify(
        &self,
        py: Python<'_>,
        pressure: Option<Given<'_>>,
        gap: Option<Given<'_>>,
        displacement: Option<Given<'_>>,
    ) -> PyResult<Verdict> {
        match (pressure, gap, displacement) {
            (Some(field), None, None) => Verdict::of(py, self, "pressure", &field),
            (None, Some(field), None) => Verdict::of(py, self, "gap", &field),
            (None, None, Some(field)) => Verdict::of(py, self, "displacement", &field),
            _ => refuse("give one result to certify: a pressure, a gap or a displacement"),
        }
    }

    /// The surface.
    #[getter]
    fn surface(&self) -> Surface {
        let mut sections = sections_of(&self.setup);
        sections.retain(|key, _| key == "surface" || key == "grid");
        Surface { surface: self.pressed.clone(), sections, rank: self.rank }
    }

    /// The setup that describes it; heights that were given as an array are called array.npy there.
    #[getter]
    fn setup(&self) -> Setup {
        Setup(self.setup.clone())
    }

    /// Contact modulus, a pressure; 1 where pressures are over it.
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

    /// The mean pressure where it is prescribed, in whatever form; else None.
    #[getter]
    fn mean_pressure(&self) -> Option<f64> {
        self.problem.mean_pressure()
    }

    fn __repr__(&self) -> String {
        let grid = self.problem.surface().grid();
        let points = &grid.shape()[2 - self.rank..];
        format!(
            "Problem(shape={points:?}, contact_modulus={:e}, {})",
            self.problem.contact_modulus(),
            self.problem.load()
        )
    }
}
