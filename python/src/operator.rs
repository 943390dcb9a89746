//! The elastic response, for solvers that are written in Python.

use crate::arrays::{ArrayLike, field_on, owned};
use crate::detached::Detached;
use crate::problem::Problem;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

#[pymethods]
impl Problem {
    /// The displacement of the surface of the solid under a pressure, a length, of the shape of the heights. Its mean is a datum and zero on
    /// a periodic boundary, except if an approach is given.
    fn displacement<'py>(&self, py: Python<'py>, pressure: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let shape = self.problem.surface().grid().shape();
        let pressure = field_on(&ArrayLike::new(&pressure, "pressure")?, shape, "pressure")?;
        let displacement = py.detached(|| {
            let mut displacement = vec![0.0; pressure.len()];
            let (pressure, _) = pressure.into_raw_vec_and_offset();
            self.problem.response().displacement(&pressure, &mut displacement);
            displacement
        })?;
        Ok(owned(py, displacement, shape, self.rank))
    }

    /// The stiffness of each wave of the periodic solid, a pressure per length, in the order of numpy.fft.rfft (a line) or rfft2 (a surface):
    /// the pressure of a wave over its displacement. It is 0 for the mean.
    #[getter]
    fn stiffness<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDyn<f64>> {
        let [ny, nx] = self.problem.surface().grid().shape();
        let columns = nx / 2 + 1;
        let by_column: Vec<f64> = self.problem.response().stiffnesses().collect();
        let by_row = (0..ny * columns).map(|i| by_column[i % columns * ny + i / columns]).collect();
        owned(py, by_row, [ny, columns], self.rank)
    }
}
