//! Contacts one after the other, whatever makes them.

use crate::contact::Contact;
use crate::detached::Detached;
use crate::output::check_not_read;
use crate::patches;
use crate::setup::Setup;
use asperity::contact::PatchHistory;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyTuple};
use std::path::PathBuf;

/// Contacts one after the other, whatever makes them: a sequence of Contact. A LoadCurve and a History are such sequences.
#[pyclass(frozen, subclass, sequence, module = "asperity")]
pub struct States {
    pub contacts: Py<PyTuple>,
    pub setup: Setup,
}

impl States {
    /// The sequence of some contacts, with the setup that repeats it.
    pub fn new(py: Python<'_>, contacts: impl IntoIterator<Item = Contact>, setup: Setup) -> PyResult<Self> {
        let contacts = contacts.into_iter().map(|it| Py::new(py, it)).collect::<PyResult<Vec<_>>>()?;
        Ok(Self { contacts: PyTuple::new(py, contacts)?.unbind(), setup })
    }

    /// The contacts themselves.
    pub fn each(&self, py: Python<'_>) -> PyResult<Vec<Py<Contact>>> {
        self.contacts.bind(py).iter().map(|it| Ok(it.cast::<Contact>()?.clone().unbind())).collect()
    }

    /// The contact patches from state to state.
    fn patch_history(&self, py: Python<'_>) -> PyResult<PatchHistory> {
        let contacts = self.each(py)?;
        py.detached(|| {
            let shape = contacts.first().map_or([0, 0], |it| it.get().contact.problem.surface().grid().shape());
            let mut history = PatchHistory::new(self.setup.setup.surface.own_shape(shape));
            contacts.iter().for_each(|it| history.add(&it.get().contact));
            history
        })
    }

    /// Whether the setups and all contacts are the same.
    pub fn is_same(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        Ok(self.setup == other.setup && self.contacts.bind(py).eq(other.contacts.bind(py))?)
    }
}

#[pymethods]
impl States {
    /// Whether the solver converged in all states.
    #[getter]
    fn converged(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.each(py)?.iter().all(|it| it.get().contact.is_converged()))
    }

    /// The setup that repeats the states. Heights that were given as an array have the name array.npy in it.
    #[getter]
    fn setup(&self) -> Setup {
        self.setup.clone()
    }

    /// The contact patches of all states as arrays by name, a row for each patch in each state: the index of the state (state), the number of the patch,
    /// which it keeps from state to state (patch), nodes, area, load, load_share (of the load of all patches), kappa_r, x and y. See Contact.patches.
    fn patches<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        patches::of_states(slf.py(), &slf.get().patch_history(slf.py())?)
    }

    /// What happened to the contact patches, as a list of tuples: the index of the first state that shows it, "born", "died", "merged" or "split", the
    /// number of the patch, and the number of the patch that it merged into or was split from, or None.
    fn patch_events(&self, py: Python<'_>) -> PyResult<Vec<patches::PatchEventRow>> {
        Ok(patches::events(self.patch_history(py)?))
    }

    /// Writes the Dataset of to_xarray to a NetCDF file.
    fn to_netcdf<'py>(slf: Bound<'py, Self>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
        check_not_read(&path, &slf.get().setup.setup)?;
        slf.py().import("asperity.export")?.call_method1("write_netcdf", (slf, path))
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        self.contacts.bind(py).len()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, index: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.contacts.bind(py).as_any().get_item(index)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.contacts.bind(py).try_iter()
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }
}
