//! Closed forms to compare with.

use crate::arrays::{ArrayLike, map, owned};
use crate::conversion::to_python;
use crate::detached::Detached;
use crate::error::{bail, py_error};
use crate::problem::Problem;
use asperity::theory::{self, Geometry, hertz, persson};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A single indenter h = -coefficient |x|^exponent on a half-space; Hertz for the exponent 2.
///
/// Loads are forces, or forces per length of a line. `a` is the half-width of the contact, or its radius. A number gives a number, an array
/// gives an array.
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
            other => return bail(format!("there is no geometry {other:?}: give line or point")),
        };
        if !theory::PowerLaw::EXPONENTS.contains(&exponent) {
            return bail(format!("the exponent is {exponent}: give one from 1 to 64"));
        }
        Ok(Self(theory::PowerLaw { geometry, coefficient, exponent, contact_modulus }))
    }

    /// Load at the half-width a.
    fn load<'py>(&self, py: Python<'py>, a: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &a, |a| self.0.load(a))
    }

    /// Half-width of the contact under a load, a length.
    fn half_width<'py>(&self, py: Python<'py>, load: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &load, |load| self.0.half_width(load))
    }

    /// Approach at the half-width a, a length. NaN for a line, whose approach has no limit.
    fn approach<'py>(&self, py: Python<'py>, a: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &a, |a| self.0.approach(a).unwrap_or(f64::NAN))
    }

    /// Pressure at the distance x from the centre of a contact of half-width a.
    fn pressure<'py>(&self, py: Python<'py>, a: f64, x: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &x, |x| self.0.pressure(a, x))
    }

    /// Proportionality factor kappa_r, the same under all loads.
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

/// Hertz: a parabolic cylinder of a radius on a half-space. Loads are forces per length.
#[pyfunction]
#[pyo3(signature = (radius, contact_modulus=1.0))]
pub fn cylinder(radius: f64, contact_modulus: f64) -> PyResult<PowerLaw> {
    positive(&[("radius", radius), ("contact modulus", contact_modulus)])?;
    Ok(PowerLaw(hertz::cylinder(radius, contact_modulus)))
}

/// Westergaard: a sine of an amplitude and a period on a half-space, up to full contact and above.
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

    /// Smallest mean pressure of full contact.
    #[getter]
    fn full_pressure(&self) -> f64 {
        self.0.full_pressure()
    }

    /// Half-width of the contact under a mean pressure, a length.
    fn half_width<'py>(&self, py: Python<'py>, mean_pressure: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &mean_pressure, |mean_pressure| self.0.half_width(mean_pressure))
    }

    /// Relative contact area under a mean pressure.
    fn relative_area<'py>(&self, py: Python<'py>, mean_pressure: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &mean_pressure, |mean_pressure| self.0.relative_area(mean_pressure))
    }

    /// Mean gap under a mean pressure, a length.
    fn mean_gap<'py>(&self, py: Python<'py>, mean_pressure: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &mean_pressure, |mean_pressure| self.0.mean_gap(mean_pressure))
    }

    /// Proportionality factor kappa_r under a mean pressure.
    fn kappa_r<'py>(&self, py: Python<'py>, mean_pressure: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &mean_pressure, |mean_pressure| self.0.kappa_r(mean_pressure))
    }

    /// Pressure at the distance x from the peak under a mean pressure.
    fn pressure<'py>(&self, py: Python<'py>, mean_pressure: f64, x: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
        map(py, &x, |x| self.0.pressure(mean_pressure, x))
    }
}

/// Persson: relative contact area of a rough surface under a reduced pressure p*, erf(sqrt(2) p*).
#[pyfunction]
pub fn persson_relative_area<'py>(py: Python<'py>, reduced_pressure: ArrayLike<'py>) -> PyResult<Bound<'py, PyAny>> {
    map(py, &reduced_pressure, persson::relative_area)
}

/// Persson: probability density (1/pressure) of a pressure under a mean pressure, on a surface of an rms gradient. The cell, with its parts
/// without contact, has the probability 1.
#[pyfunction]
#[pyo3(signature = (pressure, mean_pressure, rms_gradient, contact_modulus=1.0))]
pub fn persson_pressure_density<'py>(
    py: Python<'py>,
    pressure: ArrayLike<'py>,
    mean_pressure: f64,
    rms_gradient: f64,
    contact_modulus: f64,
) -> PyResult<Bound<'py, PyAny>> {
    positive(&[("rms gradient", rms_gradient), ("contact modulus", contact_modulus)])?;
    let pressures = persson::Pressures { mean: mean_pressure, deviation: 0.5 * contact_modulus * rms_gradient };
    map(py, &pressure, |pressure| pressures.density(pressure))
}

/// Greenwood and Williamson: relative area, pressure, rms_gradient_contact and kappa_r at a separation divided by the scale of the
/// summit heights.
///
/// heights is "gaussian" or "exponential". scale and radius of the summits are lengths, density is the number of summits per area.
#[pyfunction]
#[pyo3(signature = (separation, scale, radius, density, contact_modulus=1.0, heights="gaussian"))]
pub fn greenwood_williamson<'py>(
    py: Python<'py>,
    separation: ArrayLike<'py>,
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
        other => return bail(format!("there is no distribution {other:?}: give gaussian or exponential")),
    };
    let model = theory::GreenwoodWilliamson { heights, scale, radius, density, contact_modulus };
    let table = PyDict::new(py);
    table.set_item("relative_area", map(py, &separation, |it| model.relative_area(it))?)?;
    table.set_item("mean_pressure", map(py, &separation, |it| model.pressure(it))?)?;
    table.set_item("rms_gradient_contact", map(py, &separation, |it| model.rms_gradient_contact(it))?)?;
    table.set_item("kappa_r", map(py, &separation, |it| heights.kappa_r(it))?)?;
    Ok(table)
}

/// The exact solution of a problem whose surface is a smooth indenter: its name, relative_area, kappa_r, mean_gap, max_pressure, and the
/// pressure at the nodes. None if no exact solution is known.
#[pyfunction]
pub fn exact<'py>(py: Python<'py>, problem: &Problem) -> PyResult<Option<Bound<'py, PyAny>>> {
    let grid = problem.problem.surface().grid();
    let mean_pressure = problem.problem.mean_pressure();
    let Some(exact) = mean_pressure.and_then(|it| problem.setup.setup.exact(grid, it)) else { return Ok(None) };
    let table = to_python(py, &exact)?;
    let pressure = exact.pressure.iter().copied().collect();
    table.set_item("pressure", owned(py, pressure, grid.shape(), problem.rank))?;
    Ok(Some(table))
}

/// The mean excess of counted nodes over the true contact beside a straight edge, in spacings. `angle` is the angle between the normal of
/// the edge and an axis of the grid, in radians.
#[pyfunction]
pub fn counting_excess(py: Python<'_>, angle: f64) -> PyResult<f64> {
    py.detached(|| theory::counting_excess(angle))
}

/// Refuses the first value that is not positive and finite.
fn positive(values: &[(&str, f64)]) -> PyResult<()> {
    match values.iter().find(|(_, value)| !(value.is_finite() && *value > 0.0)) {
        Some((name, value)) => Err(py_error(format!("the {name} is {value}: give a positive number"))),
        None => Ok(()),
    }
}
