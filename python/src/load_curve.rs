//! Contacts under several loads.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::contact_files::ending;
use crate::conversion::sections_of;
use crate::detached::Detached;
use crate::error::BoxedError;
use crate::flow::with_flow;
use crate::measures::columns;
use crate::output::check_output;
use crate::setup::Setup;
use crate::states::States;
use asperity::contact::{Observables, archive_of_states};
use asperity::files::write_beside;
use asperity::history::Sliding;
use asperity::job::{LoadNumbers, write_loads};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The contacts under a list of loads, in the order of the loads: a sequence of Contact.
///
/// curve[0] is the contact under the first load, curve.measures["kappa_r"] holds kappa_r under all loads.
#[pyclass(frozen, sequence, extends = States, module = "asperity")]
pub struct LoadCurve;

/// The values from which a curve is made again (pickle): the contacts and the setup.
type LoadCurveParts = (Py<PyTuple>, Setup);

impl LoadCurve {
    /// The curve of some contacts, with the setup that repeats it.
    pub fn new(py: Python<'_>, contacts: Vec<Contact>, setup: Setup) -> PyResult<Py<Self>> {
        Self::from_states(py, States::new(py, contacts, setup)?)
    }

    fn from_states(py: Python<'_>, states: States) -> PyResult<Py<Self>> {
        Py::new(py, PyClassInitializer::from(states).add_subclass(Self))
    }
}

#[pymethods]
impl LoadCurve {
    /// The values of the loads, in the form in which they were given.
    #[getter]
    fn loads<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyAny> {
        let setup = &slf.as_super().get().setup;
        vector(slf.py(), setup.setup.loads.iter().map(|load| load.value()).collect()).into_any()
    }

    /// All numbers of Contact.measures by their names, each an array with a value for every load.
    #[getter]
    fn measures<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let py = slf.py();
        columns(py, &slf.as_super().get().each(py)?)
    }

    /// Writes the curve to a file whose ending says what: .npz for the fields and numbers under all loads, with the setup, .csv for the table that the
    /// command line writes, .svg, .pdf or .png for the figure of `plot`. asperity.load reads a .npz again.
    fn save(slf: Bound<'_, Self>, path: PathBuf) -> PyResult<()> {
        let (py, it) = (slf.py(), slf.as_super().get());
        check_output(&path, &["npz", "csv", "svg", "pdf", "png"], &it.setup.setup)?;
        let contacts = it.each(py)?;
        match ending(&path).as_str() {
            "npz" => py.try_detached(|| write_archive(&path, &contacts, &it.setup)),
            "csv" => py.try_detached(|| write_table(&path, &contacts, &it.setup)),
            _ => slf.call_method0("plot")?.call_method1("savefig", (path,)).map(drop),
        }
    }

    /// The measures as a data frame of pandas, with a row for every load.
    fn to_pandas<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pandas")?.call_method1("DataFrame", (Self::measures(&slf)?,))
    }

    /// The fields and measures as a Dataset of xarray, over the loads and the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("curve_to_xarray", (slf,))
    }

    /// A figure of relative area, kappa_r and mean gap over the load as it was prescribed, by matplotlib.
    ///
    /// `length_unit` and `pressure_unit`, such as "um" and "MPa", are those of the axes, of a problem in metres and pascals.
    #[pyo3(signature = (*, length_unit=None, pressure_unit=None))]
    fn plot<'py>(
        slf: Bound<'py, Self>,
        length_unit: Option<&str>,
        pressure_unit: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let units = (slf.clone(), length_unit, pressure_unit);
        slf.py().import("asperity.plotting")?.call_method1("plot_curve", units)
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("curve_as_html", (slf,))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, Self>) -> PyResult<bool> {
        slf.as_super().get().is_same(slf.py(), other.as_super().get())
    }

    fn __reduce__<'py>(slf: Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, LoadCurveParts)> {
        let States { contacts, setup } = slf.as_super().get();
        Ok((slf.get_type().getattr("_from_parts")?, (contacts.clone_ref(slf.py()), setup.clone())))
    }

    /// The curve that the values of a pickle describe.
    #[staticmethod]
    fn _from_parts(contacts: Bound<'_, PyTuple>, setup: Setup) -> PyResult<Py<Self>> {
        contacts.iter().try_for_each(|it| it.cast::<Contact>().map(drop).map_err(PyErr::from))?;
        Self::from_states(contacts.py(), States { contacts: contacts.clone().unbind(), setup })
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let states = slf.as_super().get();
        let kind = sections_of(&states.setup.setup.load).keys().next().cloned().unwrap_or_default();
        let contacts = states.each(slf.py())?;
        let converged = contacts.iter().filter(|it| it.get().contact.is_converged()).count();
        let (count, kind) = (contacts.len(), kind.replace('-', "_"));
        Ok(format!("LoadCurve({count} loads by {kind}, {converged} converged)"))
    }
}

/// Writes the fields and numbers of contacts under all loads.
fn write_archive(path: &Path, contacts: &[Py<Contact>], setup: &Setup) -> Result<(), BoxedError> {
    let rank = contacts.first().map_or(1, |it| it.get().rank);
    let mut states = contacts.iter().map(|it| with_flow(it.get())).collect::<Result<Vec<_>, _>>()?;
    (0..).zip(&mut states).for_each(|(number, state)| state.point = Some(number));
    let bytes = archive_of_states(&states, rank, &setup.to_saved_table().to_toml());
    Ok(write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
}

/// Writes the observables of contacts under all loads.
fn write_table(path: &Path, contacts: &[Py<Contact>], setup: &Setup) -> Result<(), BoxedError> {
    let observables: Vec<_> = contacts.iter().map(|it| Observables::new(&*it.get().contact)).collect();
    let flows = match setup.setup.flow.is_none() {
        true => vec![Vec::new(); contacts.len()],
        false => contacts.iter().map(|it| Ok(it.get().flow()?.numbers)).collect::<Result<Vec<_>, BoxedError>>()?,
    };
    let of_motion = |it: &Py<Contact>| {
        let values = it.get().contact.values();
        Sliding::NUMBERS.into_iter().filter_map(|it| Some((it, values.get(it)?))).collect::<Vec<_>>()
    };
    let further: Vec<_> = contacts.iter().zip(flows).map(|(it, flow)| [of_motion(it), flow].concat()).collect();
    let numbers = |(i, it): (usize, &Py<Contact>)| LoadNumbers {
        status: it.get().contact.status,
        observables: &observables[i],
        further: &further[i],
    };
    Ok(write_loads(path, &contacts.iter().enumerate().map(numbers).collect::<Vec<_>>())?)
}
