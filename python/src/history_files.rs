//! Files, figures and data sets of histories.

use crate::contact_files::ending;
use crate::detached::Detached;
use crate::error::{BoxedError, bail};
use crate::flow::with_flow;
use crate::history::History;
use crate::output::{check_not_read, check_output};
use asperity::contact::archive_of_states;
use asperity::files::write_beside;
use pyo3::prelude::*;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

impl History {
    /// Writes the fields and numbers of all states, those of a list of loads with what flows through them.
    fn write_archive(&self, path: &Path) -> Result<(), BoxedError> {
        let text = self.setup.to_saved_table().to_toml();
        let bytes = match self.outcome.drive.is_list {
            false => archive_of_states(&self.outcome.states, self.rank, &text),
            true => {
                let contacts = Python::attach(|py| self.each(py)).map_err(io::Error::other)?;
                let mut states = contacts.iter().map(|it| with_flow(it.get())).collect::<Result<Vec<_>, _>>()?;
                (0..).zip(&mut states).for_each(|(number, state)| state.point = Some(number));
                archive_of_states(&states, self.rank, &text)
            }
        };
        Ok(write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
    }
}

#[pymethods]
impl History {
    /// Writes the history to a file whose ending says what: .npz for the fields and numbers of all states, with the setup, .csv for the table that the
    /// command line writes, .svg, .pdf or .png for the figure of `plot`. asperity.load reads a .npz again.
    fn save(slf: Bound<'_, Self>, path: PathBuf) -> PyResult<()> {
        let it = slf.get();
        check_output(&path, &["npz", "csv", "svg", "pdf", "png"], &it.setup.setup)?;
        if it.outcome.states.is_empty() {
            return bail("the history has no states: nothing is saved");
        }
        match ending(&path).as_str() {
            "npz" => slf.py().try_detached(|| it.write_archive(&path)),
            "csv" => slf.py().try_detached(|| it.outcome.write_table(&path).map_err(BoxedError::from)),
            _ => slf.call_method0("plot")?.call_method1("savefig", (path,)).map(drop),
        }
    }

    /// The numbers, or the measures of a list of loads, as a data frame of pandas, with a row for every state.
    fn to_pandas<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("pandas")?.call_method1("DataFrame", (slf.get()._columns(slf.py())?,))
    }

    /// The fields and numbers as a Dataset of xarray, over the states and the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("history_to_xarray", (slf,))
    }

    /// Writes the Dataset of to_xarray to a NetCDF file.
    fn to_netcdf<'py>(slf: Bound<'py, Self>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
        check_not_read(&path, &slf.get().setup.setup)?;
        slf.py().import("asperity.export")?.call_method1("write_netcdf", (slf, path))
    }

    /// A figure by matplotlib, with the quantities that the command line draws: area and kappa_r over the reduced pressure for a list of loads; area and gap over time for creep; mean pressure and area over the mean
    /// gap for adhesion, with an arrow for each jump; traction over the shift and the share that sticks for slip; friction and area over the
    /// speed for sliding; friction and the share that sticks over the creepage for rolling.
    ///
    /// `length_unit` and `pressure_unit`, such as "um" and "MPa", are those of the axes, of a problem in metres and pascals.
    #[pyo3(signature = (*, length_unit=None, pressure_unit=None))]
    fn plot<'py>(
        slf: Bound<'py, Self>,
        length_unit: Option<&str>,
        pressure_unit: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let units = (slf.clone(), length_unit, pressure_unit);
        slf.py().import("asperity.plotting")?.call_method1("plot_history", units)
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("history_as_html", (slf,))
    }
}
