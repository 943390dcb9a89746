//! Numbers of surfaces.

use crate::arrays::vector;
use crate::conversion::to_python;
use crate::detached::Detached;
use crate::error::py_error;
use crate::surface::Surface;
use asperity::formats::Scan;
use asperity::surface::{
    PowerSpectrum, Roughness, SpectrumConvention, SpectrumTable, SurfaceParameter, SurfaceParameters, Survey,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl Surface {
    /// Statistics of the heights: rms_height, peak, valley (lengths), rms_gradient, rms_curvature (1/length), skewness, kurtosis.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let roughness = py.detached(|| Roughness::new(&self.surface))?;
        to_python(py, &roughness)
    }

    /// Parameters of texture by their symbols, as of ISO 25178-2 for maps (Sa, Sq, Sal, Str, ...) and ISO 21920-2 for lines (Pa, Pq, ...), with
    /// correlation_length_x, correlation_length_y and peklenik. A value is None where it is not defined. Axes along which the heights jump are
    /// taken as free.
    fn texture<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = py.detached(|| SurfaceParameters::new(&self.surface))?;
        by_key(py, &parameters.texture, |it| it.value)
    }

    /// Spectral moments m0 (length^2), m2 and m4 (1/length^2), also along each axis, and Nayak's parameter (nayak), by the spectrum. Axes
    /// along which the heights jump are taken as free.
    fn moments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = py.detached(|| SurfaceParameters::new(&self.surface))?;
        by_key(py, &parameters.moments, |it| it.value)
    }

    /// Standard errors of what texture() and moments() return, under the same keys. The surface is taken as a sample of a larger one that is
    /// everywhere alike: the errors mean nothing for an indenter. A value is None where the error is not known.
    fn sampling_errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let SurfaceParameters { texture, moments, .. } = py.detached(|| SurfaceParameters::new(&self.surface))?;
        by_key(py, texture.iter().chain(&moments), |it| it.error)
    }

    /// How random heights got a distribution that is not Gaussian: rounds, spectrum_error and height_error. None for other surfaces.
    #[getter]
    fn rank_map<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.surface.rank_map().map(|map| to_python(py, map)).transpose()
    }

    /// What the heights are like, as `asperity surface` prints it: a dictionary with voids, tilt and jumps (along y and x; the jumps across the period in
    /// rms steps), curvature_share, axes (for each its noise, resolution, and rms step, gradient and curvature at each distance), power_law
    /// and spectrum (in bands), ends (whether the heights end along y and x, so that they are not periodic), artefacts, area_error (the largest relative
    /// error of areas by those that can be mended), and noise.
    fn survey<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let survey = py.try_detached(|| Survey::new(&Scan::from_surface(&self.surface, 1)))?;
        to_python(py, &survey)
    }

    /// Power spectrum of the heights: wavenumbers 2 pi / wavelength (1/length), and densities, length^3 of a line, length^4 of a surface.
    ///
    /// With a `convention` the densities are those of this convention, averaged over directions: "surface", "surface-two-pi", "profile" or
    /// "profile-two-pi", as in files of spectra.
    #[pyo3(signature = (convention=None))]
    fn spectrum<'py>(&self, py: Python<'py>, convention: Option<&str>) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
        let Some(name) = convention else {
            let PowerSpectrum { wavenumber, density, .. } = py.detached(|| PowerSpectrum::new(&self.surface))?;
            return Ok([vector(py, wavenumber), vector(py, density)]);
        };
        let convention = convention_of(name)?;
        let own = py.try_detached(|| SpectrumTable::from_surface(&self.surface))?;
        let (wavenumber, table) = (own.wavenumbers().to_vec(), own.converted(convention.kind()).map_err(py_error)?);
        let density = wavenumber.iter().map(|&q| table.density(q) * convention.factor()).collect();
        Ok([vector(py, wavenumber), vector(py, density)])
    }
}

/// The convention of a name.
pub fn convention_of(name: &str) -> PyResult<SpectrumConvention> {
    name.parse().map_err(|_| {
        py_error(format!("the convention is {name:?}: give surface, surface-two-pi, profile or profile-two-pi"))
    })
}

/// Numbers of parameters by their keys.
fn by_key<'py, 'a>(
    py: Python<'py>,
    parameters: impl IntoIterator<Item = &'a SurfaceParameter>,
    number: fn(&SurfaceParameter) -> Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    parameters.into_iter().try_for_each(|it| found.set_item(&it.key, number(it)))?;
    Ok(found)
}
