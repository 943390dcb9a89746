//! Error bounds and work of results.

use asperity::contact;
use pyo3::prelude::*;

/// Error bounds of a pressure, all of them dimensionless. As a number it is `eta`.
#[pyclass(frozen, get_all, module = "asperity")]
#[derive(Clone, Copy)]
pub struct Certificate {
    /// Bound of the error in energy, over load times rms height.
    eta: f64,
    /// At a given mean gap, the error over what is left of the gap; else 0.
    eta_gap: f64,
    /// Bound of the relative error of the pressure, in the energy norm.
    pressure_error_bound: f64,
    /// Bound of the error of the mean gap, over the rms height.
    mean_gap_error_bound: f64,
    /// Distance from the prescribed load, over it.
    load_error: f64,
    /// The least pressure over the mean pressure, negative where there is tension.
    min_pressure: f64,
    /// Largest excess over the hardness, over it.
    above_hardness: f64,
    /// Largest penetration, over the rms height.
    penetration: f64,
    /// What rounding alone may leave of `eta`.
    rounding: f64,
}

impl Certificate {
    /// The most telling of them, in words.
    pub fn told(&self) -> String {
        let Self { eta, pressure_error_bound, penetration, .. } = self;
        format!("eta={eta:.2e}, pressure_error_bound={pressure_error_bound:.2e}, penetration={penetration:.2e}")
    }
}

#[pymethods]
impl Certificate {
    fn __repr__(&self) -> String {
        format!("Certificate({})", self.told())
    }

    fn __float__(&self) -> f64 {
        self.eta
    }
}

impl From<contact::Certificate> for Certificate {
    fn from(it: contact::Certificate) -> Self {
        Self {
            eta: it.eta,
            eta_gap: it.eta_gap,
            pressure_error_bound: it.pressure_error_bound,
            mean_gap_error_bound: it.mean_gap_error_bound,
            load_error: it.load_error,
            min_pressure: it.min_pressure,
            above_hardness: it.above_hardness,
            penetration: it.penetration,
            rounding: it.rounding,
        }
    }
}

/// What a solver has done.
#[pyclass(frozen, get_all, module = "asperity")]
#[derive(Clone, Copy)]
pub struct Work {
    /// Relaxation steps.
    iterations: usize,
    /// Fourier transforms, forward and inverse counted alike.
    transforms: u64,
    /// Seconds, without those spent in callbacks and recorders.
    seconds: f64,
}

#[pymethods]
impl Work {
    fn __repr__(&self) -> String {
        let Self { iterations, transforms, seconds } = self;
        format!("Work(iterations={iterations}, transforms={transforms}, seconds={seconds:.3})")
    }
}

impl From<contact::Work> for Work {
    fn from(contact::Work { iterations, transforms, seconds }: contact::Work) -> Self {
        Self { iterations, transforms, seconds }
    }
}
