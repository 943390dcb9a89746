//! Contacts: what solvers return.

use crate::certificate::{Certificate, Work};
use crate::field::{list, shared};
use crate::problem::Problem;
use crate::refusal::{refuse, refused};
use crate::setup::Setup;
use asperity::contact::{self, Distribution, OBSERVABLES, Patch, State};
use asperity::diagnosis::Findings;
use asperity::files::{check_named, write_beside};
use asperity::setup;
use asperity::surface::{Field, PowerSpectrum};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

/// A contact that was solved, or the best that was found.
///
/// Fields have the shape of the heights, share the memory of the contact and are read-only.
#[pyclass(frozen, module = "asperity")]
pub struct Contact {
    pub contact: asperity::Contact,
    /// The surface of its problem.
    pub pressed: Arc<asperity::Surface>,
    pub setup: setup::Setup,
    pub rank: usize,
    pub diagnosis: Option<Findings>,
}

/// A number of each patch.
type Column = fn(&Patch) -> f64;

/// Two arrays: ends of bins or wavenumbers, and densities.
type Pair<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

impl Contact {
    fn field<'py>(slf: Bound<'py, Self>, of: fn(&asperity::Contact) -> &Field) -> Bound<'py, PyArrayDyn<f64>> {
        let Self { contact, rank, .. } = slf.get();
        shared(of(contact), *rank, slf.clone().into_any())
    }

    fn distribution<'py>(
        py: Python<'py>,
        bins: usize,
        of: impl FnOnce() -> Distribution + Send,
    ) -> PyResult<Pair<'py>> {
        if bins == 0 {
            return refuse("a distribution has 0 bins: give at least one");
        }
        let Distribution { edges, density } = py.detach(of);
        Ok((list(py, edges), list(py, density)))
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

    /// Gap between the surfaces, a length.
    #[getter]
    fn gap<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| &contact.gap)
    }

    /// Heights of the rigid surface about their mean, a length.
    #[getter]
    fn height<'py>(slf: Bound<'py, Self>) -> Bound<'py, PyArrayDyn<f64>> {
        Self::field(slf, |contact| contact.problem.surface().height())
    }

    /// All observables of the contact by their names: areas, gradients, kappa_r, mean gap, errors and so on. help(asperity.observables)
    /// says what they are.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = py.detach(|| {
            let state = State::from(&self.contact);
            OBSERVABLES.iter().map(|row| (row.name, (row.value)(&state))).collect::<Vec<_>>()
        });
        let measures = PyDict::new(py);
        numbers.into_iter().try_for_each(|(name, number)| measures.set_item(name, number))?;
        Ok(measures)
    }

    /// Error bounds of this very pressure.
    #[getter]
    fn certificate(&self) -> Certificate {
        self.contact.certificate.into()
    }

    /// What the solver has done.
    #[getter]
    fn work(&self) -> Work {
        self.contact.work.into()
    }

    /// How the solver stopped, in words.
    #[getter]
    fn status(&self) -> String {
        self.contact.status.to_string()
    }

    /// Whether the certificate met the tolerance.
    #[getter]
    fn converged(&self) -> bool {
        self.contact.is_converged()
    }

    /// Name of the solver.
    #[getter]
    fn solver(&self) -> &str {
        &self.contact.solver
    }

    /// The setup that repeats it; heights that were given as an array are called array.npy there.
    #[getter]
    fn setup(&self) -> Setup {
        Setup(self.setup.clone())
    }

    /// The problem that it solves.
    #[getter]
    fn problem(&self) -> Problem {
        let (problem, pressed) = (self.contact.problem.clone(), self.pressed.clone());
        Problem { problem, pressed, setup: self.setup.clone(), rank: self.rank }
    }

    /// What held the solver up, in words, if it was asked to say so; else None.
    #[getter]
    fn diagnosis(&self) -> Option<String> {
        self.diagnosis.as_ref().map(Findings::to_string)
    }

    /// Mean pressure.
    #[getter]
    fn mean_pressure(&self) -> f64 {
        self.contact.mean_pressure()
    }

    /// Mean gap, a length.
    #[getter]
    fn mean_gap(&self) -> f64 {
        self.contact.mean_gap()
    }

    /// The approach, a length: how far the surface has moved on from first touch; None on a solid that sinks without end.
    #[getter]
    fn approach(&self) -> Option<f64> {
        self.contact.approach()
    }

    /// Elastic energy per area, pressure times length.
    #[getter]
    fn elastic_energy(&self) -> f64 {
        self.contact.elastic_energy()
    }

    /// Contact stiffness, by how much the mean pressure rises as the mean gap falls: pressure per length. A tenth of the work of a solve,
    /// when it is first asked for.
    fn stiffness(&self, py: Python<'_>) -> f64 {
        py.detach(|| self.contact.stiffness())
    }

    /// Contact patches, the largest first, as arrays by name: nodes, the node of the largest pressure (peak), area (length of a line), load
    /// (force, per length of a line), kappa_r and curvature (1/length).
    fn patches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let patches = py.detach(|| Patch::all(&self.contact.problem, self.pressures()));
        let table = PyDict::new(py);
        table.set_item("nodes", PyArray1::from_iter(py, patches.iter().map(|it| it.nodes as i64)))?;
        table.set_item("peak", PyArray1::from_iter(py, patches.iter().map(|it| it.peak as i64)))?;
        let columns: [(&str, Column); 4] = [
            ("area", |it| it.area),
            ("load", |it| it.load),
            ("kappa_r", |it| it.kappa_r),
            ("curvature", |it| it.curvature),
        ];
        columns
            .into_iter()
            .try_for_each(|(name, of)| table.set_item(name, list(py, patches.iter().map(of).collect())))?;
        Ok(table)
    }

    /// Edges of the contact between the nodes, as arrays by name: the node in contact, the step to its neighbour (towards_y, towards_x), the
    /// distance of the edge from the node in spacings (place), and the share of the link in the contour (weight).
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let edges: Vec<contact::Edge> = py.detach(|| {
            let edges = self.contact.edges();
            let nodes = (0..self.pressures().len()).filter(|&node| self.pressures()[node] > 0.0);
            nodes.flat_map(|node| edges.around(node).collect::<Vec<_>>()).collect()
        });
        let table = PyDict::new(py);
        table.set_item("node", PyArray1::from_iter(py, edges.iter().map(|it| it.node as i64)))?;
        table.set_item("towards_y", PyArray1::from_iter(py, edges.iter().map(|it| it.towards[0] as i64)))?;
        table.set_item("towards_x", PyArray1::from_iter(py, edges.iter().map(|it| it.towards[1] as i64)))?;
        table.set_item("place", list(py, edges.iter().map(|it| it.place).collect()))?;
        table.set_item("weight", list(py, edges.iter().map(|it| it.weight).collect()))?;
        Ok(table)
    }

    /// Distribution of the pressure over the nodes in contact: ends of the bins, and densities (1/pressure).
    #[pyo3(signature = (bins=64, largest=None))]
    fn pressure_distribution<'py>(&self, py: Python<'py>, bins: usize, largest: Option<f64>) -> PyResult<Pair<'py>> {
        let largest = largest.unwrap_or_else(|| self.contact.max_pressure());
        Self::distribution(py, bins, || self.contact.pressure_distribution(bins, largest))
    }

    /// Distribution of the gap over the nodes that are not in contact: ends of the bins, and densities (1/length).
    #[pyo3(signature = (bins=64, largest=None))]
    fn gap_distribution<'py>(&self, py: Python<'py>, bins: usize, largest: Option<f64>) -> PyResult<Pair<'py>> {
        let largest = largest.unwrap_or_else(|| self.contact.max_gap());
        Self::distribution(py, bins, || self.contact.gap_distribution(bins, largest))
    }

    /// Power spectrum of the pressure: wavenumbers 2 pi / wavelength (1/length), and densities, pressure^2 length of a line, pressure^2
    /// length^2 of a surface.
    fn pressure_spectrum<'py>(&self, py: Python<'py>) -> Pair<'py> {
        let PowerSpectrum { wavenumber, density, .. } = py.detach(|| self.contact.pressure_spectrum());
        (list(py, wavenumber), list(py, density))
    }

    /// Writes fields, distributions, spectra, numbers and setup to a file whose name ends in .npz. The command line reads its setup, and the
    /// heights with it.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| {
            check_named(&path, &["npz"])?;
            let bytes = contact::archive(&self.contact, self.rank, Some(&self.setup.to_toml()))?;
            Ok(write_beside(&path, |file| file.write_all(&bytes))?)
        })
        .map_err(|error: crate::refusal::Fault| refused(error))
    }

    fn __repr__(&self) -> String {
        let asperity::Contact { status, certificate, solver, .. } = &self.contact;
        let points = &self.contact.problem.surface().grid().shape()[2 - self.rank..];
        format!(
            "Contact(shape={points:?}, {}, eta={:.1e}, {status} by {solver})",
            self.contact.problem.load(),
            certificate.eta
        )
    }
}

impl Contact {
    /// The pressures, row by row.
    fn pressures(&self) -> &[f64] {
        self.contact.pressure.as_slice().unwrap_or_default()
    }
}
