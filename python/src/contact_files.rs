//! Contacts as files, datasets and figures.

use crate::contact::Contact;
use crate::detached::Detached;
use crate::error::{BoxedError, bail};
use crate::flow::with_flow;
use crate::output::{check_not_read, check_output};
use crate::setup::Setup;
use asperity::contact::{archive_of_slip, archive_of_state};
use asperity::files::write_beside;
use asperity::job::write_nodes;
use pyo3::prelude::*;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

#[pymethods]
impl Contact {
    /// Writes the contact to a file whose ending says what: .npz for fields, distributions, spectra, numbers and setup, .csv for the nodes of a
    /// line, .svg, .pdf or .png for the figure of `plot`. asperity.load reads a .npz again; Setup.read and the command line read the setup in it, with the
    /// heights.
    fn save(slf: Bound<'_, Self>, path: PathBuf) -> PyResult<()> {
        let it = slf.get();
        check_output(&path, &["npz", "csv", "svg", "pdf", "png"], &it.setup)?;
        match ending(&path).as_str() {
            "npz" => slf.py().try_detached(|| it.write_archive(&path)),
            "csv" if it.rank > 1 => {
                bail("a .csv holds the nodes of a line, but this is a surface: give a name that ends in .npz")
            }
            "csv" => slf.py().try_detached(|| write_nodes(&path, &it.contact)),
            _ => slf.call_method0("plot")?.call_method1("savefig", (path,)).map(drop),
        }
    }

    /// The fields as a Dataset of xarray over the positions of the nodes, with the measures as attributes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("contact_to_xarray", (slf,))
    }

    /// Writes the Dataset of to_xarray to a NetCDF file.
    fn to_netcdf<'py>(slf: Bound<'py, Self>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
        check_not_read(&path, &slf.get().setup)?;
        slf.py().import("asperity.export")?.call_method1("write_netcdf", (slf, path))
    }

    /// A figure of the contact by matplotlib: surfaces and pressure of a line, maps of pressure and gap of a surface.
    ///
    /// `length_unit` and `pressure_unit`, such as "um" and "MPa", are those of the axes, of a problem in metres and pascals.
    #[pyo3(signature = (*, length_unit=None, pressure_unit=None))]
    fn plot<'py>(
        slf: Bound<'py, Self>,
        length_unit: Option<&str>,
        pressure_unit: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let units = (slf.clone(), length_unit, pressure_unit);
        slf.py().import("asperity.plotting")?.call_method1("plot_contact", units)
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("contact_as_html", (slf,))
    }
}

impl Contact {
    /// Writes fields, distributions, spectra, numbers and setup.
    fn write_archive(&self, path: &Path) -> Result<(), BoxedError> {
        let text = Setup::new(self.setup.clone()).to_saved_table().to_toml();
        let bytes = match &self.slip {
            Some(slip) => archive_of_slip(slip, self.rank, Some(&text)),
            None => archive_of_state(&with_flow(self)?, self.rank, Some(&text)),
        };
        Ok(write_beside(path, |file| file.write_all(&bytes.map_err(io::Error::other)?))?)
    }
}

/// The ending of the name of a file in small letters.
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}
