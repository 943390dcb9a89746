//! What flows through a contact.

use crate::arrays::owned;
use crate::contact::Contact;
use crate::conversion::{Sections, to_python, value_from_py};
use crate::detached::Detached;
use crate::error::{argument, bail, py_error};
use asperity::contact::State;
use asperity::error::FlowError;
use asperity::flow::{Conductance, FlowAxis, Leakage, Percolation, PercolationLoad};
use asperity::setup::Flow;
use asperity::surface::Field;
use pyo3::Borrowed;
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl Contact {
    /// Leakage of a thin fluid through the gap along an axis, "x" or "y", by Reynolds' equation.
    ///
    /// A dictionary: bounds of the cube of the gap of parallel plates that leak as much under the same pressure drop (lower and upper, length^3), the
    /// gap of these plates (hydraulic_gap, a length), whether nothing flows (sealed), whether the bounds are within `tolerance` (converged), and
    /// in the shape of the heights the pressure of the fluid from 1 to 0 (pressure, nan where nothing flows) and the magnitude of the
    /// flux over its mean (flux).
    #[pyo3(signature = (axis=FlowAxisName(FlowAxis::X), *, tolerance=1e-4), text_signature = "($self, axis='x', *, tolerance=0.0001)")]
    fn leakage<'py>(&self, py: Python<'py>, axis: FlowAxisName, tolerance: f64) -> PyResult<Bound<'py, PyDict>> {
        let FlowAxisName(axis) = axis;
        let leakage = py.try_detached(|| Leakage::from_contact(&self.contact, axis, tolerance))?;
        let found = PyDict::new(py);
        let numbers = [("lower", leakage.lower), ("upper", leakage.upper), ("hydraulic_gap", leakage.sigma().cbrt())];
        numbers.into_iter().try_for_each(|(name, value)| found.set_item(name, value))?;
        found.set_item("sealed", leakage.is_sealed())?;
        found.set_item("converged", leakage.width() <= tolerance)?;
        let array = |field: Field| {
            let shape = field.dim().into();
            owned(py, field.into_iter().collect(), shape, self.rank)
        };
        found.set_item("pressure", array(leakage.pressure))?;
        found.set_item("flux", array(leakage.flux))?;
        Ok(found)
    }

    /// Electrical or thermal conductance of the contact per area of the cell, between half-spaces of some resistivities (two values, or one that
    /// both have): `2 k / (E* (rho_1 + rho_2))` with the stiffness k (Barber 2003). For heat give metre kelvin per watt. Texts have units, such as
    /// "17 nohm*m". A `conductivity`, or two, can be given instead, such as "401 W/m/K".
    #[pyo3(signature = (resistivity=None, *, conductivity=None))]
    fn conductance(
        &self,
        py: Python<'_>,
        resistivity: Option<&Bound<'_, PyAny>>,
        conductivity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<f64> {
        if let Some(drive) = self.drive() {
            let process = drive.name;
            return bail(format!(
                "the conductance follows from the stiffness of an elastic contact at rest, but this is a state of {process}"
            ));
        }
        let mut asked = Sections::new();
        for (key, given) in [("resistivity", resistivity), ("conductivity", conductivity)] {
            if let Some(given) = given {
                asked.insert(key.into(), value_from_py(given, key)?);
            }
        }
        let asked: Flow = serde_json::from_value(asked.into()).map_err(py_error)?;
        let Some(resistivities) = asked.resistivities().map_err(py_error)? else {
            return bail(
                "no resistivity is given: give that of both bodies, or two (resistivity), or the conductivity",
            );
        };
        let found = py.try_detached(|| Conductance::new(&self.contact, resistivities))?;
        Ok(found.per_area)
    }

    /// Whether the open area and the contact connect both sides of the cell: open_x, open_y, contact_x, contact_y.
    fn percolation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let percolation = py.detached(|| Percolation::from_contact(&self.contact))?;
        let found = PyDict::new(py);
        for axis in FlowAxis::ALL {
            found.set_item(format!("open_{}", axis.name()), percolation.open_percolates(axis))?;
            found.set_item(format!("contact_{}", axis.name()), percolation.contact_percolates(axis))?;
        }
        Ok(found)
    }

    /// The load at which the surface of this contact seals along an axis, found by bisection to the relative `width`.
    ///
    /// A dictionary with the number of contacts that were solved (solves) and two others: the highest load at which the gap was seen open (open) and
    /// the lowest one at which the contact sealed (sealed), each with reduced_pressure, mean_pressure, mean_gap, relative_area,
    /// relative_area_counted and relative_area_corrected.
    #[pyo3(signature = (axis=FlowAxisName(FlowAxis::X), *, width=1e-3), text_signature = "($self, axis='x', *, width=0.001)")]
    fn sealing_load<'py>(&self, py: Python<'py>, axis: FlowAxisName, width: f64) -> PyResult<Bound<'py, PyAny>> {
        let FlowAxisName(axis) = axis;
        let (problem, setup) = (&self.contact.problem, &self.setup);
        let found =
            py.try_detached(|| PercolationLoad::new(problem, setup.solver.solver(), &setup.stop, axis, width, |_| ()))?;
        to_python(py, &found)
    }
}

/// A contact as a state, with the fields of the flow through it, as far as its setup asks for them.
pub fn with_flow(contact: &Contact) -> Result<State, FlowError> {
    let state = State::clone(&contact.contact.0);
    if !contact.setup.flow.leakage || !state.fields.is_empty() {
        return Ok(state);
    }
    let found = contact.setup.flow.measure(&contact.contact)?;
    Ok(state.with_fields(found.leakages.into_iter().flat_map(Leakage::into_fields).collect()))
}

/// The name of an axis.
struct FlowAxisName(FlowAxis);

impl<'a, 'py> FromPyObject<'a, 'py> for FlowAxisName {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let name: String = argument(&given, "axis", "'x' or 'y'")?;
        name.parse().map(Self).map_err(|_| py_error(format!("the axis is '{name}': give 'x' or 'y'")))
    }
}
