//! Closed forms to compare with.

use crate::field::{Given, over, taken};
use crate::problem::Problem;
use crate::refusal::{refuse, refused};
use crate::value::python;
use asperity::theory::{self, Geometry, hertz, persson};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A single indenter h = -coefficient |x|^exponent on a half-space; Hertz for the exponent 2.
///
/// Loads are forces, of a line per length; a is the half-width of the contact, or its radius. Numbers or arrays go in and come out.
#[pyclass(frozen, module = "asperity.theory")]
pub struct PowerLaw(theory::PowerLaw);

#[pymethods]
impl PowerLaw {
    #[new]
    #[pyo3(signature = (geometry, coefficient, exponent, contact_modulus=1.0))]
    fn new(geometry: &str, coefficient: f64, exponent: f64, contact_modulus: f64) -> PyResult<Self> {
        positive(&[("coefficient", coefficient), ("contact modulus", contact_modulus)])?;
        let geometry = match geometry {
            "line" => Geometry::Line,
            "point" => Geometry::Point,
            other => return refuse(format!("there is no geometry {other:?}: give line or point")),
        };
        if !theory::PowerLaw::EXPONENTS.contains(&exponent) {
            return refuse(format!("the exponent is {exponent}: give one from 1 to 64"));
        }
        Ok(Self(theory::PowerLaw { geometry, coefficient, exponent, contact_modulus }))
    }

    /// Load at the half-width a.
    fn load<'py>(&self, py: Python<'py>, a: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &a, |a| self.0.load(a))
    }

    /// Half-width of the contact under a load, a length.
    fn half_width<'py>(&self, py: Python<'py>, load: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &load, |load| self.0.half_width(load))
    }

    /// Approach at the half-width a, a length; NaN for a line, which has none.
    fn approach<'py>(&self, py: Python<'py>, a: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &a, |a| self.0.approach(a).unwrap_or(f64::NAN))
    }

    /// Pressure at the distance x from the middle of a contact of half-width a.
    fn pressure<'py>(&self, py: Python<'py>, a: f64, x: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &x, |x| self.0.pressure(a, x))
    }

    /// Proportionality factor kappa_r, which no load changes.
    #[getter]
    fn kappa_r(&self) -> f64 {
        self.0.kappa_r()
    }
}

/// Hertz: a paraboloid of a radius on a half-space.
#[pyfunction]
#[pyo3(signature = (radius, contact_modulus=1.0))]
pub fn sphere(radius: f64, contact_modulus: f64) -> PyResult<PowerLaw> {
    positive(&[("radius", radius), ("contact modulus", contact_modulus)])?;
    Ok(PowerLaw(hertz::sphere(radius, contact_modulus)))
}

/// Hertz: a parabolic cylinder of a radius on a half-space; loads are per length.
#[pyfunction]
#[pyo3(signature = (radius, contact_modulus=1.0))]
pub fn cylinder(radius: f64, contact_modulus: f64) -> PyResult<PowerLaw> {
    positive(&[("radius", radius), ("contact modulus", contact_modulus)])?;
    Ok(PowerLaw(hertz::cylinder(radius, contact_modulus)))
}

/// Westergaard: a sine of an amplitude and a period on a half-space, up to full contact and beyond.
#[pyclass(frozen, module = "asperity.theory")]
pub struct Westergaard(theory::Westergaard);

#[pymethods]
impl Westergaard {
    #[new]
    #[pyo3(signature = (amplitude, period, contact_modulus=1.0))]
    fn new(amplitude: f64, period: f64, contact_modulus: f64) -> PyResult<Self> {
        positive(&[("amplitude", amplitude), ("period", period), ("contact modulus", contact_modulus)])?;
        Ok(Self(theory::Westergaard { amplitude, period, contact_modulus }))
    }

    /// Mean pressure from which on all touches.
    #[getter]
    fn full_pressure(&self) -> f64 {
        self.0.full_pressure()
    }

    /// Half-width of the contact under a mean pressure, a length.
    fn half_width<'py>(&self, py: Python<'py>, mean_pressure: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &mean_pressure, |mean_pressure| self.0.half_width(mean_pressure))
    }

    /// Share in contact under a mean pressure.
    fn relative_area<'py>(&self, py: Python<'py>, mean_pressure: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &mean_pressure, |mean_pressure| self.0.relative_area(mean_pressure))
    }

    /// Mean gap under a mean pressure, a length.
    fn mean_gap<'py>(&self, py: Python<'py>, mean_pressure: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &mean_pressure, |mean_pressure| self.0.mean_gap(mean_pressure))
    }

    /// Proportionality factor kappa_r under a mean pressure.
    fn kappa_r<'py>(&self, py: Python<'py>, mean_pressure: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &mean_pressure, |mean_pressure| self.0.kappa_r(mean_pressure))
    }

    /// Pressure at the distance x from the peak under a mean pressure.
    fn pressure<'py>(&self, py: Python<'py>, mean_pressure: f64, x: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
        over(py, &x, |x| self.0.pressure(mean_pressure, x))
    }
}

/// Persson: the share in contact of a rough surface under a reduced pressure, erf(sqrt(2) p*).
#[pyfunction]
pub fn persson_relative_area<'py>(py: Python<'py>, reduced_pressure: Given<'py>) -> PyResult<Bound<'py, PyAny>> {
    over(py, &reduced_pressure, persson::relative_area)
}

/// Persson: density (1/pressure) of a pressure over contact and gap under a mean pressure, on a surface of an rms gradient.
#[pyfunction]
#[pyo3(signature = (pressure, mean_pressure, rms_gradient, contact_modulus=1.0))]
pub fn persson_pressure_density<'py>(
    py: Python<'py>,
    pressure: Given<'py>,
    mean_pressure: f64,
    rms_gradient: f64,
    contact_modulus: f64,
) -> PyResult<Bound<'py, PyAny>> {
    positive(&[("rms gradient", rms_gradient), ("contact modulus", contact_modulus)])?;
    let pressures = persson::Pressures { mean: mean_pressure, deviation: 0.5 * contact_modulus * rms_gradient };
    over(py, &pressure, |pressure| pressures.density(pressure))
}

/// Greenwood and Williamson: relative area, pressure, rms_gradient_contact and kappa_r at a separation over the scale of the summits' heights.
///
/// heights is "gaussian" or "exponential"; scale and radius of the summits are lengths, density is summits per area.
#[pyfunction]
#[pyo3(signature = (separation, scale, radius, density, contact_modulus=1.0, heights="gaussian"))]
pub fn greenwood_williamson<'py>(
    py: Python<'py>,
    separation: Given<'py>,
    scale: f64,
    radius: f64,
    density: f64,
    contact_modulus: f64,
    heights: &str,
) -> PyResult<Bound<'py, PyDict>> {
    positive(&[("scale", scale), ("radius", radius), ("density", density), ("contact modulus", contact_modulus)])?;
    let heights = match heights {
        "gaussian" => theory::SummitHeights::Gaussian,
        "exponential" => theory::SummitHeights::Exponential,
        other => return refuse(format!("there is no distribution {other:?}: give gaussian or exponential")),
    };
    let model = theory::GreenwoodWilliamson { heights, scale, radius, density, contact_modulus };
    let told = PyDict::new(py);
    told.set_item("relative_area", over(py, &separation, |it| model.relative_area(it))?)?;
    told.set_item("mean_pressure", over(py, &separation, |it| model.pressure(it))?)?;
    told.set_item("rms_gradient_contact", over(py, &separation, |it| model.rms_gradient_contact(it))?)?;
    told.set_item("kappa_r", over(py, &separation, |it| heights.kappa_r(it))?)?;
    Ok(told)
}

/// The exact solution of a problem whose surface is a smooth indenter, where there is one: its name, relative_area, kappa_r, mean_gap,
/// max_pressure, and the pressure at the nodes; else None.
#[pyfunction]
pub fn exact<'py>(py: Python<'py>, problem: &Problem) -> PyResult<Option<Bound<'py, PyAny>>> {
    let grid = problem.problem.surface().grid();
    let mean_pressure = problem.problem.mean_pressure();
    let Some(exact) = mean_pressure.and_then(|it| problem.setup.exact(grid, it)) else { return Ok(None) };
    let told = python(py, &exact)?;
    let pressure = exact.pressure.iter().copied().collect();
    told.set_item("pressure", taken(py, pressure, grid.shape(), problem.rank))?;
    Ok(Some(told))
}

/// The mean excess of counted nodes over the true contact beside a straight edge, in spacings; angle is that of its normal to an axis of
/// the grid, in radians.
#[pyfunction]
pub fn counting_excess(py: Python<'_>, angle: f64) -> f64 {
    py.detach(|| theory::counting_excess(angle))
}

/// Refuses the first value that is not positive and finite.
fn positive(values: &[(&str, f64)]) -> PyResult<()> {
    match values.iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        Some((name, value)) => Err(refused(format!("the {name} is {value}: give a positive number"))),
        None => Ok(()),
    }
}
