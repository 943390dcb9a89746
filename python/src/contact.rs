//! Contacts: what solvers return.

use crate::arrays::{in_parentheses, owned, vector, view};
use crate::certificate::{Certificate, Work};
use crate::detached::Detached;
use crate::error::{NotConverged, bail};
use crate::patches;
use crate::problem::Problem;
use crate::setup::Setup;
use crate::shared_state::SharedState;
use asperity::contact::{self, Distribution, PartialSlip};
use asperity::setup::{self, FlowFound};
use asperity::surface::{Field, PowerSpectrum};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, OnceLock};

/// Bins of a distribution at most.
const MOST_BINS: usize = 1_000_000;

/// A solved contact, or the best one that the solver found.
///
/// Its fields have the shape of the heights. They share the memory of the contact and are read-only.
#[pyclass(frozen, module = "asperity")]
pub struct Contact {
    /// The contact, with the state that it is.
    pub contact: SharedState,
    /// The surface of its problem.
    pub surface: Arc<asperity::Surface>,
    pub setup: setup::Setup,
    pub rank: usize,
    /// Why the solver was slow, in words, if `diagnose` was set.
    pub diagnosis: Option<String>,
    /// The stick and slip areas, if there is friction.
    pub slip: Option<PartialSlip>,
    /// Whether it is a state of a history.
    pub is_of_history: bool,
    /// The steps of the preparation of the heights.
    pub preparation: Arc<[String]>,
    /// What flows through the contact, after it was found.
    pub flow: OnceLock<FlowFound>,
}

/// Two arrays, such as the edges of bins and densities.
type Pair<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

impl Contact {
    /// A contact on a surface, of a setup, with arrays of some rank.
    pub fn new(
        contact: impl Into<SharedState>,
        surface: Arc<asperity::Surface>,
        setup: setup::Setup,
        rank: usize,
    ) -> Self {
        let (contact, preparation, flow) = (contact.into(), Arc::default(), OnceLock::new());
        let (diagnosis, slip, is_of_history) = (None, None, false);
        Self { contact, surface, setup, rank, diagnosis, slip, is_of_history, preparation, flow }
    }

    fn field<'py>(slf: Bound<'py, Self>, of: fn(&asperity::Contact) -> &Field) -> Bound<'py, PyArrayDyn<f64>> {
        let Self { contact, rank, .. } = slf.get();
        view(of(contact), *rank, slf.clone().into_any())
    }

    fn distribution<'py>(
        py: Python<'py>,
        bins: usize,
        of: impl FnOnce() -> Distribution + Send,
    ) -> PyResult<Pair<'py>> {
        if bins == 0 {
            return bail("a distribution has 0 bins: give at least one");
        }
        if bins > MOST_BINS {
            return bail(format!("a distribution has {bins} bins: give at most {MOST_BINS}"));
        }
        let Distribution { edges, density } = py.detached(of)?;
        Ok((vector(py, edges), vector(py, density)))
    }

    /// The contact of what sticks.
    pub fn stick(&self, slip: &PartialSlip) -> Self {
        let setup = setup::Setup { load: slip.stuck.problem.load(), friction: None, ..self.setup.clone() };
        Self::new(slip.stuck.clone(), self.surface.clone(), setup, self.rank)
    }

    /// The pressures, row by row.
    fn pressures(&self) -> &[f64] {
        self.contact.pressure.as_slice().unwrap_or_default()
    }

    /// The problem as an object of Python.
    pub fn py_problem(&self) -> Problem {
        let (problem, surface) = (self.contact.problem.clone(), self.surface.clone());
        let (setup, preparation) = (Setup::new(self.setup.clone()), self.preparation.clone());
        Problem { problem, surface, setup, rank: self.rank, preparation }
    }
}

#[pymethods]
impl Contact {
    /// Pressure, positive in compression.
    #[getter]
    fn pressure<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| &contact.pressure)
    }

    /// Displacement of the solid's surface into the solid, a length; without mean on a periodic grid.
    #[getter]
    fn displacement<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| &contact.displacement)
    }

    /// Gap between the surfaces, a length. Where they yield it is 0, see overlap.
    #[getter]
    fn gap<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| &contact.gap)
    }

    /// Overlap of the surfaces where they yield, a length; zero elsewhere, and without a hardness.
    #[getter]
    fn overlap<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        let overlap = self.contact.overlap();
        owned(py, overlap.iter().copied().collect(), overlap.dim().into(), self.rank)
    }

    /// Heights of the rigid surface about their mean, a length.
    #[getter]
    fn height<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| contact.problem.surface().height())
    }

    /// Nodes in contact, as truth values of the shape of the heights.
    #[getter]
    fn contact<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<bool>> {
        let mask = self.contact.mask();
        owned(py, mask.iter().copied().collect(), mask.dim().into(), self.rank)
    }

    /// Positions of the nodes along x, a length, from 0.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.surface.grid().x().collect())
    }

    /// Positions of the nodes along y, a length, from 0. A line has the single position 0.
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.surface.grid().y().collect())
    }

    /// Error bounds of this very pressure. With adhesion they are NaN: History.claims and the residual in History.numbers stand for them.
    #[getter]
    fn certificate(&self) -> Certificate {
        Certificate(self.contact.certificate)
    }

    /// The work that the solver has done.
    #[getter]
    fn work(&self) -> Work {
        Work(self.contact.work)
    }

    /// How the solver stopped, in words.
    #[getter]
    fn status(&self) -> String {
        self.contact.status.to_string()
    }

    /// Whether the certificate meets the tolerance.
    #[getter]
    fn converged(&self) -> bool {
        self.contact.is_converged()
    }

    /// Name of the solver.
    #[getter]
    fn solver(&self) -> &str {
        &self.contact.solver
    }

    /// Returns the contact itself if the solver converged, and raises NotConverged otherwise, with the contact in its attribute `contact`.
    fn raise_if_not_converged(slf: Bound<'_, Self>) -> PyResult<Bound<'_, Self>> {
        let Some(fault) = slf.get().contact.fault() else { return Ok(slf) };
        let exception = NotConverged::new_err(fault.to_string());
        exception.value(slf.py()).setattr("contact", slf)?;
        Err(exception)
    }

    /// The setup that repeats the solve. Heights that were given as an array have the name array.npy in it.
    #[getter]
    fn setup(&self) -> Setup {
        Setup::new(self.setup.clone())
    }

    /// The problem that the contact solves.
    #[getter]
    fn problem(&self) -> Problem {
        self.py_problem()
    }

    /// What slowed the solver down, in words. None if the contact was not solved with diagnose=True.
    #[getter]
    fn diagnosis(&self) -> Option<&str> {
        self.diagnosis.as_deref()
    }

    /// Contact patches, the largest first, as arrays by name: number of nodes (nodes), node of the largest pressure (peak), area (the length
    /// in a line), load (a force, per length in a line), kappa_r, curvature (1/length) and centre (x, y; lengths from the first node on). Of heights
    /// that were mirrored, patches are those of the part without images.
    fn patches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        patches::of_contact(py, &self.contact, &self.setup)
    }

    /// Edges of the contact between the nodes, as arrays by name: the node in contact (node), the step to the neighbour without contact
    /// (towards_y, towards_x), the distance of the edge from the node in spacings (place), and the share of the link in the contour (weight).
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let edges: Vec<contact::Edge> = py.detached(|| {
            let edges = self.contact.edges();
            let nodes = (0..self.pressures().len()).filter(|&node| self.pressures()[node] > 0.0);
            nodes.flat_map(|node| edges.around(node).collect::<Vec<_>>()).collect()
        })?;
        let table = PyDict::new(py);
        table.set_item("node", PyArray1::from_iter(py, edges.iter().map(|it| it.node as i64)))?;
        table.set_item("towards_y", PyArray1::from_iter(py, edges.iter().map(|it| it.towards[0] as i64)))?;
        table.set_item("towards_x", PyArray1::from_iter(py, edges.iter().map(|it| it.towards[1] as i64)))?;
        table.set_item("place", vector(py, edges.iter().map(|it| it.place).collect()))?;
        table.set_item("weight", vector(py, edges.iter().map(|it| it.weight).collect()))?;
        Ok(table)
    }

    /// Distribution of the pressure of the nodes in contact: edges of the bins, and densities (1/pressure).
    #[pyo3(signature = (bins=64, largest=None))]
    fn pressure_distribution<'py>(&self, py: Python<'py>, bins: usize, largest: Option<f64>) -> PyResult<Pair<'py>> {
        let largest = largest.unwrap_or_else(|| self.contact.max_pressure());
        Self::distribution(py, bins, || self.contact.pressure_distribution(bins, largest))
    }

    /// Distribution of the gap of the nodes without contact: edges of the bins, and densities (1/length).
    #[pyo3(signature = (bins=64, largest=None))]
    fn gap_distribution<'py>(&self, py: Python<'py>, bins: usize, largest: Option<f64>) -> PyResult<Pair<'py>> {
        let largest = largest.unwrap_or_else(|| self.contact.max_gap());
        Self::distribution(py, bins, || self.contact.gap_distribution(bins, largest))
    }

    /// Power spectrum of the pressure: wavenumbers 2 pi / wavelength (1/length), and densities (pressure^2 length of a line,
    /// pressure^2 length^2 of a surface).
    fn pressure_spectrum<'py>(&self, py: Python<'py>) -> PyResult<Pair<'py>> {
        let PowerSpectrum { wavenumber, density, .. } = py.detached(|| self.contact.pressure_spectrum())?;
        Ok((vector(py, wavenumber), vector(py, density)))
    }

    fn __repr__(&self) -> String {
        let asperity::Contact { status, certificate, solver, .. } = &*self.contact;
        let points = &self.contact.problem.surface().grid().shape()[2 - self.rank..];
        let shape = in_parentheses(points);
        match self.drive() {
            Some(drive) => {
                let (process, pressure) = (drive.name, self.contact.mean_pressure());
                format!("Contact(shape={shape}, a state of {process}, contact pressure {pressure:e}, {status})")
            }
            None => {
                let load = self.contact.problem.load();
                format!("Contact(shape={shape}, {load}, eta={:.1e}, {solver}: {status})", certificate.eta)
            }
        }
    }
}
