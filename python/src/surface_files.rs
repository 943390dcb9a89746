//! Surfaces as files, datasets and figures.

use crate::conversion::table_from_sections;
use crate::detached::Detached;
use crate::error::{BoxedError, py_error};
use crate::surface::Surface;
use crate::surface_numbers::convention_of;
use asperity::files::{check_apart, check_named};
use asperity::formats::Scan;
use asperity::surface::{SpectrumConvention, SpectrumTable};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

#[pymethods]
impl Surface {
    /// Writes the heights, in metres, to a file whose ending gives the format: .npy, .sdf, .x3p, .xyz, .gwy, or .stl (a closed block, in millimetres).
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.check_not_read(&path)?;
        py.try_detached(|| Scan::from_surface(&self.surface, 1).write(&path))
    }

    /// Writes the power spectrum, averaged over directions, to a file .csv that Surface.rough reads as `table`. The `convention` is "surface",
    /// "surface-two-pi", "profile" or "profile-two-pi"; without it "surface", of a line "profile".
    #[pyo3(signature = (path, convention=None))]
    fn save_spectrum(&self, py: Python<'_>, path: PathBuf, convention: Option<&str>) -> PyResult<()> {
        self.check_not_read(&path)?;
        let usual =
            if self.surface.grid().is_line() { SpectrumConvention::Profile } else { SpectrumConvention::Surface };
        let convention = convention.map_or(Ok(usual), convention_of)?;
        let write = || -> Result<(), BoxedError> {
            check_named(&path, &["csv"])?;
            Ok(SpectrumTable::from_surface(&self.surface)?.write(&path, convention)?)
        };
        py.try_detached(write)
    }

    /// The heights as a DataArray of xarray over the positions of the nodes.
    fn to_xarray<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.export")?.call_method1("surface_to_xarray", (slf,))
    }

    /// Writes the DataArray of to_xarray to a NetCDF file.
    fn to_netcdf<'py>(slf: Bound<'py, Self>, path: PathBuf) -> PyResult<Bound<'py, PyAny>> {
        slf.get().check_not_read(&path)?;
        slf.py().import("asperity.export")?.call_method1("write_netcdf", (slf, path))
    }

    /// A figure of the heights by matplotlib: a curve for a line, a map for a surface.
    ///
    /// `length_unit`, such as "um", is that of the axes, of a surface in metres.
    #[pyo3(signature = (*, length_unit=None))]
    fn plot<'py>(slf: Bound<'py, Self>, length_unit: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("plot_surface", (slf.clone(), length_unit))
    }

    fn _repr_html_<'py>(slf: Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("asperity.plotting")?.call_method1("surface_as_html", (slf,))
    }
}

impl Surface {
    /// Refuses a file that the surface was made of.
    fn check_not_read(&self, path: &Path) -> PyResult<()> {
        let read = if self.sections.is_empty() { Vec::new() } else { table_from_sections(&self.sections)?.files() };
        check_apart([path], read).map_err(py_error)
    }
}
