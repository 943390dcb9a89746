//! Contacts: what solvers return.

use crate::arrays::{ArrayLike, field, in_parentheses, owned, vector, view};
use crate::certificate::{Certificate, Work};
use crate::error::{BoxedError, NotConverged, bail, py_error};
use crate::problem::Problem;
use crate::setup::Setup;
use asperity::contact::{
    self, Distribution, Friction, OBSERVABLES, PartialSlip, Patch, Resolved, State, Status, archive, archive_of_slip,
};
use asperity::files::{check_named, write_beside};
use asperity::setup;
use asperity::surface::{Field, PowerSpectrum};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;

/// A solved contact, or the best one that the solver found.
///
/// Its fields have the shape of the heights. They share the memory of the contact and are read-only.
#[pyclass(frozen, module = "asperity")]
pub struct Contact {
    pub contact: asperity::Contact,
    /// The surface of its problem.
    pub surface: Arc<asperity::Surface>,
    pub setup: setup::Setup,
    pub rank: usize,
    /// Why the solver was slow, in words, if `diagnose` was set.
    pub diagnosis: Option<String>,
    /// The stick and slip areas, if there is friction.
    pub slip: Option<PartialSlip>,
}

/// A number of each patch.
type PatchColumn = fn(&Patch) -> f64;

/// Two arrays, such as the edges of bins and densities.
type Pair<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// The values that make a contact again: fields, certificate and work, status and solver, the state on the next coarser grid, the diagnosis,
/// and under friction its coefficient, the tangential load, the ratio of it to the load at which all slides, and the stick contact.
type ContactParts<'py> = (
    Problem,
    [Bound<'py, PyArrayDyn<f64>>; 3],
    (Certificate, Work),
    [String; 2],
    Option<([f64; 4], [usize; 2])>,
    Option<String>,
    Option<([f64; 3], Contact)>,
);

impl Contact {
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
        let Distribution { edges, density } = py.detach(of);
        Ok((vector(py, edges), vector(py, density)))
    }

    /// All observables by their names.
    pub fn numbers(&self) -> Vec<(&'static str, f64)> {
        let state = State::from(&self.contact);
        OBSERVABLES.iter().map(|row| (row.name, (row.value)(&state))).collect()
    }

    /// The contact of what sticks.
    pub fn stick(&self, slip: &PartialSlip) -> Self {
        Self {
            contact: slip.stuck.clone(),
            surface: self.surface.clone(),
            setup: setup::Setup { load: slip.stuck.problem.load(), friction: None, ..self.setup.clone() },
            rank: self.rank,
            diagnosis: None,
            slip: None,
        }
    }

    /// The pressures, row by row.
    fn pressures(&self) -> &[f64] {
        self.contact.pressure.as_slice().unwrap_or_default()
    }

    /// The problem as an object of Python.
    fn py_problem(&self) -> Problem {
        let (problem, surface) = (self.contact.problem.clone(), self.surface.clone());
        Problem { problem, surface, setup: Setup::new(self.setup.clone()), rank: self.rank }
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

    /// All observables of the contact by their names: areas, gradients, kappa_r, mean gap, errors and so on. asperity.observables() explains
    /// them.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = py.detach(|| self.numbers());
        let measures = PyDict::new(py);
        numbers.into_iter().try_for_each(|(name, number)| measures.set_item(name, number))?;
        Ok(measures)
    }

    /// Error bounds of this very pressure.
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

    /// The approach, a length: how far the surface has moved since first touch. None on a periodic half-space, where it has no limit.
    #[getter]
    fn approach(&self) -> Option<f64> {
        self.contact.approach()
    }

    /// Elastic energy per area, pressure times length.
    #[getter]
    fn elastic_energy(&self) -> f64 {
        self.contact.elastic_energy()
    }

    /// Contact stiffness, pressure per length: the increase of the mean pressure divided by the decrease of the mean gap. The first call takes
    /// about a tenth of the time of a solve.
    fn stiffness(&self, py: Python<'_>) -> f64 {
        py.detach(|| self.contact.stiffness())
    }

    /// Contact patches, the largest first, as arrays by name: number of nodes (nodes), node of the largest pressure (peak), area (the length
    /// in a line), load (a force, per length in a line), kappa_r and curvature (1/length).
    fn patches<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let patches = py.detach(|| Patch::all(&self.contact.problem, self.pressures()));
        let table = PyDict::new(py);
        table.set_item("nodes", PyArray1::from_iter(py, patches.iter().map(|it| it.nodes as i64)))?;
        table.set_item("peak", PyArray1::from_iter(py, patches.iter().map(|it| it.peak as i64)))?;
        let columns: [(&str, PatchColumn); 4] = [
            ("area", |it| it.area),
            ("load", |it| it.load),
            ("kappa_r", |it| it.kappa_r),
            ("curvature", |it| it.curvature),
        ];
        columns
            .into_iter()
            .try_for_each(|(name, of)| table.set_item(name, vector(py, patches.iter().map(of).collect())))?;
        Ok(table)
    }

    /// Edges of the contact between the nodes, as arrays by name: the node in contact (node), the step to the neighbour without contact
    /// (towards_y, towards_x), the distance of the edge from the node in spacings (place), and the share of the link in the contour (weight).
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
    fn pressure_spectrum<'py>(&self, py: Python<'py>) -> Pair<'py> {
        let PowerSpectrum { wavenumber, density, .. } = py.detach(|| self.contact.pressure_spectrum());
        (vector(py, wavenumber), vector(py, density))
    }

    /// Writes fields, distributions, spectra, numbers and setup to a file whose name ends in .npz. Setup.read and the command line read the
    /// setup in it, with the heights.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let write = || -> Result<(), BoxedError> {
            check_named(&path, &["npz"])?;
            let text = self.setup.to_toml();
            let bytes = match &self.slip {
                Some(slip) => archive_of_slip(slip, self.rank, Some(&text)),
                None => archive(&self.contact, self.rank, Some(&text)),
            };
            Ok(write_beside(&path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
        };
        py.detach(write).map_err(py_error)
    }

    /// The fields as a Dataset of xarray over the positions of the nodes, with the measures as attributes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("contact_to_xarray", (slf,))
    }

    /// A figure of the contact by matplotlib: surfaces and pressure of a line, maps of pressure and gap of a surface.
    fn plot<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("plot_contact", (slf,))
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("contact_as_html", (slf,))
    }

    fn __eq__(&self, other: &Self) -> bool {
        let (one, two) = (&self.contact, &other.contact);
        let has_same_fields =
            one.pressure == two.pressure && one.gap == two.gap && one.displacement == two.displacement;
        has_same_fields && self.setup == other.setup && self.surface == other.surface
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, ContactParts<'py>)> {
        let it = slf.get();
        let Self { contact, rank, .. } = it;
        if contact.problem.surface() != &it.surface {
            return bail(
                "this contact lies on a surface that has yielded under a higher load, which a pickle does not hold: save it in place of \
                 pickling it",
            );
        }
        let fields = [&contact.pressure, &contact.displacement, &contact.gap];
        let fields = fields.map(|field| view(field, *rank, slf.clone().into_any()));
        let coarser = contact.coarser.map(|it| {
            (
                [it.relative_area, it.rms_gradient_contact, it.kappa_r, it.reduced_pressure_contact],
                [it.edges, it.edges_of_shape],
            )
        });
        let slip = it.slip.as_ref().map(|slip| {
            let Friction { coefficient, tangential } = slip.friction;
            ([coefficient, tangential, slip.ratio], it.stick(slip))
        });
        let words = [contact.status.name().to_owned(), contact.solver.clone()];
        let numbers = (Certificate(contact.certificate), Work(contact.work));
        let parts = (it.py_problem(), fields, numbers, words, coarser, it.diagnosis.clone(), slip);
        Ok((slf.get_type().getattr("_from_parts")?, parts))
    }

    /// The contact that the values of a pickle describe.
    #[staticmethod]
    #[pyo3(signature = (problem, fields, numbers, words, coarser, diagnosis, slip))]
    fn _from_parts(
        problem: &Problem,
        fields: [ArrayLike<'_>; 3],
        numbers: (Certificate, Work),
        words: [String; 2],
        coarser: Option<([f64; 4], [usize; 2])>,
        diagnosis: Option<String>,
        slip: Option<([f64; 3], Bound<'_, Self>)>,
    ) -> PyResult<Self> {
        let [pressure, displacement, gap] = &fields;
        let fields = [field(pressure)?, field(displacement)?, field(gap)?];
        let (Certificate(certificate), Work(work)) = numbers;
        let [status, solver] = words;
        let status: Status = serde_json::from_value(status.into()).map_err(py_error)?;
        let coarser =
            coarser.map(|([relative_area, rms_gradient_contact, kappa_r, last], [edges, edges_of_shape])| Resolved {
                relative_area,
                rms_gradient_contact,
                kappa_r,
                reduced_pressure_contact: last,
                edges,
                edges_of_shape,
            });
        let Problem { problem, surface, setup, rank } = problem;
        let contact =
            asperity::Contact::from_parts(problem.clone(), fields, (certificate, work, status), solver, coarser);
        let contact = contact.map_err(py_error)?;
        let slip = slip.map(|([coefficient, tangential, ratio], stick)| PartialSlip {
            friction: Friction { coefficient, tangential },
            ratio,
            pressed: contact.clone(),
            stuck: stick.get().contact.clone(),
        });
        Ok(Self { contact, surface: surface.clone(), setup: setup.setup.clone(), rank: *rank, diagnosis, slip })
    }

    fn __repr__(&self) -> String {
        let asperity::Contact { status, certificate, solver, .. } = &self.contact;
        let points = &self.contact.problem.surface().grid().shape()[2 - self.rank..];
        format!(
            "Contact(shape={}, {}, eta={:.1e}, {solver}: {status})",
            in_parentheses(points),
            self.contact.problem.load(),
            certificate.eta
        )
    }
}
