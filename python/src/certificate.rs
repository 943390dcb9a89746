//! Error bounds and work of results.

use asperity::contact;
use pyo3::prelude::*;

/// Error bounds of a pressure, all of them dimensionless. Converted to a number it is `eta`.
#[pyclass(frozen, eq, from_py_object, module = "asperity")]
#[derive(Clone, Copy, PartialEq)]
pub struct Certificate(pub contact::Certificate);

/// The values from which a certificate is made again (pickle).
type Values = (f64, f64, f64, f64, f64, f64, f64, f64, f64);

#[pymethods]
impl Certificate {
    #[new]
    #[pyo3(signature = (eta, eta_gap, pressure_error_bound, mean_gap_error_bound, load_error, min_pressure, above_hardness, penetration, rounding))]
    #[allow(clippy::too_many_arguments, reason = "these are the fields")]
    fn new(
        eta: f64,
        eta_gap: f64,
        pressure_error_bound: f64,
        mean_gap_error_bound: f64,
        load_error: f64,
        min_pressure: f64,
        above_hardness: f64,
        penetration: f64,
        rounding: f64,
    ) -> Self {
        Self(contact::Certificate {
            eta,
            eta_gap,
            pressure_error_bound,
            mean_gap_error_bound,
            load_error,
            min_pressure,
            above_hardness,
            penetration,
            rounding,
        })
    }

    /// Bound of the energy error, divided by load times rms height.
    #[getter]
    fn eta(&self) -> f64 {
        self.0.eta
    }

    /// Under a given mean gap: the error divided by the remaining gap. Otherwise 0.
    #[getter]
    fn eta_gap(&self) -> f64 {
        self.0.eta_gap
    }

    /// Bound of the relative error of the pressure, in the energy norm.
    #[getter]
    fn pressure_error_bound(&self) -> f64 {
        self.0.pressure_error_bound
    }

    /// Bound of the error of the mean gap, divided by the rms height.
    #[getter]
    fn mean_gap_error_bound(&self) -> f64 {
        self.0.mean_gap_error_bound
    }

    /// Relative deviation from the prescribed load.
    #[getter]
    fn load_error(&self) -> f64 {
        self.0.load_error
    }

    /// The smallest pressure divided by the mean pressure. It is negative where there is tension.
    #[getter]
    fn min_pressure(&self) -> f64 {
        self.0.min_pressure
    }

    /// Largest excess over the hardness, divided by the hardness.
    #[getter]
    fn above_hardness(&self) -> f64 {
        self.0.above_hardness
    }

    /// Largest penetration, divided by the rms height.
    #[getter]
    fn penetration(&self) -> f64 {
        self.0.penetration
    }

    /// The part of `eta` that rounding alone can cause.
    #[getter]
    fn rounding(&self) -> f64 {
        self.0.rounding
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, Values) {
        let it = &slf.get().0;
        let values = (
            it.eta,
            it.eta_gap,
            it.pressure_error_bound,
            it.mean_gap_error_bound,
            it.load_error,
            it.min_pressure,
            it.above_hardness,
            it.penetration,
            it.rounding,
        );
        (slf.get_type().into_any(), values)
    }

    pub fn __repr__(&self) -> String {
        let contact::Certificate { eta, pressure_error_bound, penetration, .. } = self.0;
        format!(
            "Certificate(eta={eta:.2e}, pressure_error_bound={pressure_error_bound:.2e}, penetration={penetration:.2e})"
        )
    }

    fn __float__(&self) -> f64 {
        self.0.eta
    }
}

/// The work that a solver has done.
#[pyclass(frozen, eq, from_py_object, module = "asperity")]
#[derive(Clone, Copy, PartialEq)]
pub struct Work(pub contact::Work);

#[pymethods]
impl Work {
    #[new]
    fn new(iterations: usize, transforms: u64, seconds: f64) -> Self {
        Self(contact::Work { iterations, transforms, seconds })
    }

    /// Iterations.
    #[getter]
    fn iterations(&self) -> usize {
        self.0.iterations
    }

    /// Fourier transforms, forward and inverse ones together.
    #[getter]
    fn transforms(&self) -> u64 {
        self.0.transforms
    }

    /// Seconds, without the time in callbacks and recorders.
    #[getter]
    fn seconds(&self) -> f64 {
        self.0.seconds
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (usize, u64, f64)) {
        let contact::Work { iterations, transforms, seconds } = slf.get().0;
        (slf.get_type().into_any(), (iterations, transforms, seconds))
    }

    fn __repr__(&self) -> String {
        let contact::Work { iterations, transforms, seconds } = self.0;
        format!("Work(iterations={iterations}, transforms={transforms}, seconds={seconds:.3})")
    }
}
