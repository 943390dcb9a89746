//! Stick and slip under a tangential load.

use crate::arrays::owned;
use crate::contact::Contact;
use crate::detached::Detached;
use asperity::contact;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

/// A contact under a normal and a tangential load: a part of it sticks, the rest slips (Cattaneo, Mindlin, Ciavarella, Jäger).
///
/// The tangential load acts along x. Contact.slip returns it where a contact was solved with `friction`.
#[pyclass(frozen, module = "asperity")]
pub struct PartialSlip {
    slip: contact::PartialSlip,
    stick: Py<Contact>,
    /// The contact under the normal load.
    pressed: Py<Contact>,
    rank: usize,
}

#[pymethods]
impl PartialSlip {
    /// Coefficient of friction.
    #[getter]
    fn coefficient(&self) -> f64 {
        self.slip.friction.coefficient
    }

    /// The tangential load, of the same kind as the normal load: a pressure with a mean pressure, a force with a force.
    #[getter]
    fn tangential(&self) -> f64 {
        self.slip.friction.tangential
    }

    /// The tangential load divided by that at which the whole contact slides.
    #[getter]
    fn tangential_over_sliding(&self) -> f64 {
        self.slip.ratio
    }

    /// Tangential traction along x on the surface of the solid, a pressure, of the shape of the heights.
    #[getter]
    fn traction<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        let traction = self.slip.traction();
        owned(py, traction.iter().copied().collect(), traction.dim().into(), self.rank)
    }

    /// Nodes that stick, as truth values of the shape of the heights.
    #[getter]
    fn stick<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<bool>> {
        let sticks = self.slip.sticks();
        owned(py, sticks.iter().copied().collect(), sticks.dim().into(), self.rank)
    }

    /// The area that sticks divided by the area of the cell, with edges interpolated between the nodes.
    #[getter]
    fn stick_area(&self, py: Python<'_>) -> PyResult<f64> {
        py.detached(|| self.slip.stick().relative_area)
    }

    /// The area that slips divided by the area of the cell, with edges interpolated between the nodes.
    #[getter]
    fn slip_area(&self, py: Python<'_>) -> PyResult<f64> {
        py.detached(|| self.slip.slip_area())
    }

    /// The contact under the smaller normal load `P - Q / mu`: its nodes in contact are those that stick.
    #[getter]
    fn stick_contact(&self, py: Python<'_>) -> Py<Contact> {
        self.stick.clone_ref(py)
    }

    fn __eq__(&self, other: &Self) -> bool {
        let is_same = |one: &Py<Contact>, two: &Py<Contact>| one.get() == two.get();
        let is_same_friction = self.slip.friction == other.slip.friction;
        is_same_friction && is_same(&self.pressed, &other.pressed) && is_same(&self.stick, &other.stick)
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    // a pickle holds the contact, which has its slip
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Py<Contact>,))> {
        let py = slf.py();
        let getter = py.import("operator")?.call_method1("attrgetter", ("slip",))?;
        Ok((getter, (slf.get().pressed.clone_ref(py),)))
    }

    fn __repr__(&self) -> String {
        let contact::PartialSlip { ratio, stuck, .. } = &self.slip;
        format!("PartialSlip(tangential_over_sliding={ratio:.4}, eta={:.1e}, {})", stuck.certificate.eta, stuck.status)
    }
}

#[pymethods]
impl Contact {
    /// The stick and slip areas, if the contact was solved with `friction` and converged; otherwise None.
    #[getter]
    fn slip(slf: Bound<'_, Self>) -> PyResult<Option<PartialSlip>> {
        let it = slf.get();
        let Some(slip) = &it.slip else { return Ok(None) };
        let stick = Py::new(slf.py(), it.stick(slip))?;
        Ok(Some(PartialSlip { slip: slip.clone(), stick, rank: it.rank, pressed: slf.clone().unbind() }))
    }
}
