//! A step of a solver, for callbacks.

use crate::arrays::owned;
use crate::background::StepHandle;
use crate::certificate::Certificate;
use crate::error::bail;
use asperity::contact::{self, Phase, Quantity, Reading};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A relaxation step of a solver. It can be read while the callback runs that receives it. Its values are computed when they are read; fields
/// are copies that may be changed.
#[pyclass(frozen, module = "asperity")]
pub struct Step {
    handle: StepHandle,
    rank: usize,
    index: usize,
    phase: Phase,
    seconds: f64,
    transforms: u64,
    certificate: Option<contact::Certificate>,
    error: f64,
}

impl Step {
    /// The step behind a handle, after one with the error `before`; none if the step is over.
    pub fn new(handle: &StepHandle, rank: usize, before: f64) -> Option<Self> {
        let numbers = |step: &contact::Step<'_>| {
            (step.index(), step.phase(), step.seconds(), step.transforms(), step.certificate().copied())
        };
        let (index, phase, seconds, transforms, certificate) = handle.query(numbers)?;
        let known = certificate.map(|it| it.eta).or((index > 0).then_some(before));
        let error = known.filter(|_| phase.level == 0).unwrap_or(f64::INFINITY);
        Some(Self { handle: handle.clone(), rank, index, phase, seconds, transforms, certificate, error })
    }

    fn query<T: Send + 'static>(
        &self,
        py: Python<'_>,
        of: impl FnOnce(&contact::Step<'_>) -> T + Send + 'static,
    ) -> PyResult<T> {
        match py.detach(|| self.handle.query(of)) {
            Some(answer) => Ok(answer),
            None => bail("the step is over: read its values while the callback runs"),
        }
    }

    /// A field of the step.
    fn field<'py>(
        &self,
        py: Python<'py>,
        of: fn(&contact::Step<'_>) -> Vec<f64>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let (values, shape) = self.query(py, move |step| (of(step), step.problem().surface().grid().shape()))?;
        Ok(owned(py, values, shape, self.rank))
    }
}

#[pymethods]
impl Step {
    /// Number of the step, from 0, which is the state at the start.
    #[getter]
    fn iteration(&self) -> usize {
        self.index
    }

    /// Grid level: 0 is the finest, each further one has half as many points per side.
    #[getter]
    fn level(&self) -> usize {
        self.phase.level
    }

    /// Seconds so far, without those spent in callbacks.
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Fourier transforms so far.
    #[getter]
    fn transforms(&self) -> u64 {
        self.transforms
    }

    /// Error bounds of this pressure, None where the solver does not know them without extra work.
    #[getter]
    fn certificate(&self) -> Option<Certificate> {
        self.certificate.map(Certificate)
    }

    /// The certificate `eta` on the finest grid, a bound of the error in energy over load times rms height. Where a step has none, it is that of
    /// the last step that had one; it is infinite on coarser grids and before the first.
    #[getter]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Pressure, shape (n) or (ny, nx) of the grid of this level.
    #[getter]
    fn pressure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.field(py, |step| step.pressure().to_vec())
    }

    /// Displacement of the solid's surface into the solid, a length; its datum is free.
    #[getter]
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.field(py, |step| step.displacement().to_vec())
    }

    /// Gap between the surfaces, a length, negative where they still penetrate.
    #[getter]
    fn gap<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.field(py, |step| step.gap().to_vec())
    }

    /// Relative contact area, with contact edges interpolated between grid nodes.
    #[getter]
    fn relative_area(&self, py: Python<'_>) -> PyResult<f64> {
        self.query(py, |step| step.resolved().relative_area)
    }

    /// Relative contact area over the reduced pressure with the rms gradient of the contact, with contact edges
    /// interpolated between grid nodes.
    #[getter]
    fn kappa_r(&self, py: Python<'_>) -> PyResult<f64> {
        self.query(py, |step| step.resolved().kappa_r)
    }

    /// Mean gap, a length.
    #[getter]
    fn mean_gap(&self, py: Python<'_>) -> PyResult<f64> {
        self.query(py, |step| step.mean_gap())
    }

    /// Number of contact patches.
    #[getter]
    fn patches(&self, py: Python<'_>) -> PyResult<usize> {
        self.query(py, |step| step.patches().count())
    }

    /// All observables that change from step to step, by their names.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = |step: &contact::Step<'_>| {
            let reading = Reading::from(step);
            Quantity::traced().map(|it| (it.name(), reading.value(it))).collect::<Vec<_>>()
        };
        let measures = PyDict::new(py);
        self.query(py, numbers)?.into_iter().try_for_each(|(name, number)| measures.set_item(name, number))?;
        Ok(measures)
    }

    fn __repr__(&self) -> String {
        format!("Step(iteration={}, level={}, error={:.2e})", self.index, self.phase.level, self.error())
    }
}
