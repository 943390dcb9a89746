//! Contacts under several loads.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::contact_files::ending;
use crate::conversion::sections_of;
use crate::error::{BoxedError, py_error};
use crate::flow::with_flow;
use crate::measures::columns;
use crate::output::{check_not_read, check_output};
use crate::setup::Setup;
use asperity::contact::{Observables, archive_of_states};
use asperity::files::write_beside;
use asperity::job::{LoadNumbers, write_loads};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyTuple};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The contacts under a list of loads, in the order of the loads: a sequence of Contact.
///
/// curve[0] is the contact under the first load, curve.measures["kappa_r"] holds kappa_r under all loads.
#[pyclass(frozen, sequence, module = "asperity")]
pub struct LoadCurve {
    contacts: Py<PyTuple>,
    setup: Setup,
}

/// The values from which a curve is made again (pickle): the contacts and the setup.
type LoadCurveParts = (Py<PyTuple>, Setup);

impl LoadCurve {
    /// The curve of some contacts, with the setup that repeats it.
    pub fn new(py: Python<'_>, contacts: Vec<Contact>, setup: Setup) -> PyResult<Self> {
        let contacts = contacts.into_iter().map(|it| Py::new(py, it)).collect::<PyResult<Vec<_>>>()?;
        Ok(Self { contacts: PyTuple::new(py, contacts)?.unbind(), setup })
    }

    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Vec<PyRef<'py, Contact>>> {
        self.contacts.bind(py).iter().map(|it| Ok(it.cast::<Contact>()?.borrow())).collect()
    }
}

#[pymethods]
impl LoadCurve {
    /// The values of the loads, in the form in which they were given.
    #[getter]
    fn loads<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        vector(py, self.setup.loads.iter().flatten().map(|load| load.value()).collect()).into_any()
    }

    /// All numbers of Contact.measures by their names, each an array with a value for every load.
    #[getter]
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let contacts: Vec<Py<Contact>> = self.contacts(py)?.into_iter().map(Into::into).collect();
        columns(py, &contacts)
    }

    /// Whether the solver converged under all loads.
    #[getter]
    fn converged(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.contacts(py)?.iter().all(|it| it.contact.is_converged()))
    }

    /// The setup that repeats the curve. Heights that were given as an array have the name array.npy in it.
    #[getter]
    fn setup(&self) -> Setup {
        self.setup.clone()
    }

    /// Writes the curve to a file whose ending says what: .npz for the fields and numbers under all loads, with the setup, .csv for the table that the
    /// command line writes, .svg or .png for the figure of `plot`. asperity.load reads a .npz again.
    fn save(slf: Bound<'_, Self>, path: PathBuf) -> PyResult<()> {
        let (py, it) = (slf.py(), slf.get());
        check_output(&path, &["npz", "csv", "svg", "png"], &it.setup.setup)?;
        let contacts: Vec<Py<Contact>> = it.contacts(py)?.into_iter().map(Into::into).collect();
        match ending(&path).as_str() {
            "npz" => py.detach(|| write_archive(&path, &contacts, &it.setup)).map_err(py_error),
            "csv" => py.detach(|| write_table(&path, &contacts, &it.setup)).map_err(py_error),
            _ => slf.call_method0("plot")?.call_method1("savefig", (path,)).map(drop),
        }
    }

    /// The measures as a data frame of pandas, with a row for every load.
    fn to_pandas<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pandas")?.call_method1("DataFrame", (slf.get().measures(slf.py())?,))
    }

    /// The fields and measures as a Dataset of xarray, over the loads and the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("curve_to_xarray", (slf,))
    }

    /// Writes the Dataset of to_xarray to a NetCDF file.
    fn to_netcdf<'py>(slf: Bound<'py, Self>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
        check_not_read(&path, &slf.get().setup.setup)?;
        slf.py().import("asperity.export")?.call_method1("write_netcdf", (slf, path))
    }

    /// A figure of relative area, kappa_r and mean gap over the reduced pressure, by matplotlib.
    fn plot<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("plot_curve", (slf,))
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("curve_as_html", (slf,))
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

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        Ok(self.setup == other.setup && self.contacts.bind(py).eq(other.contacts.bind(py))?)
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, LoadCurveParts)> {
        let Self { contacts, setup } = slf.get();
        Ok((slf.get_type().getattr("_from_parts")?, (contacts.clone_ref(slf.py()), setup.clone())))
    }

    /// The curve that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(contacts: Bound<'_, PyTuple>, setup: Setup) -> PyResult<Self> {
        contacts.iter().try_for_each(|it| it.cast::<Contact>().map(drop).map_err(PyErr::from))?;
        Ok(Self { contacts: contacts.unbind(), setup })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let kind = sections_of(&self.setup.setup.load).keys().next().cloned().unwrap_or_default();
        let [count, converged] = {
            let contacts = self.contacts(py)?;
            [contacts.len(), contacts.iter().filter(|it| it.contact.is_converged()).count()]
        };
        Ok(format!("LoadCurve({count} loads by {}, {converged} converged)", kind.replace('-', "_")))
    }
}

/// Writes the fields and numbers of contacts under all loads.
fn write_archive(path: &Path, contacts: &[Py<Contact>], setup: &Setup) -> Result<(), BoxedError> {
    let rank = contacts.first().map_or(1, |it| it.get().rank);
    let mut states = contacts.iter().map(|it| with_flow(it.get())).collect::<Result<Vec<_>, _>>()?;
    (0..).zip(&mut states).for_each(|(number, state)| state.point = Some(number));
    let bytes = archive_of_states(&states, rank, &setup.with_full_path().to_toml());
    Ok(write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
}

/// Writes the observables of contacts under all loads.
fn write_table(path: &Path, contacts: &[Py<Contact>], setup: &Setup) -> Result<(), BoxedError> {
    let observables: Vec<_> = contacts.iter().map(|it| Observables::new(&*it.get().contact)).collect();
    let flows = match setup.setup.flow.is_none() {
        true => vec![Vec::new(); contacts.len()],
        false => contacts.iter().map(|it| Ok(it.get().flow()?.numbers)).collect::<Result<Vec<_>, BoxedError>>()?,
    };
    let numbers = |(i, it): (usize, &Py<Contact>)| LoadNumbers {
        status: it.get().contact.status,
        observables: &observables[i],
        flow: &flows[i],
    };
    Ok(write_loads(path, &contacts.iter().enumerate().map(numbers).collect::<Vec<_>>())?)
}
