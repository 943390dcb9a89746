//! Stresses below a contact.

use crate::arrays::vector;
use crate::contact::Contact;
use crate::detached::Detached;
use crate::error::{bail, index_of, py_error, wrong_type};
use crate::warnings;
use asperity::elastic::stress::{Stress, USUAL_POISSON};
use asperity::quantity::length_of;
use asperity::setup::Cost;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// Depths at most.
const MOST_DEPTHS: usize = 1_000_000;
/// Values in memory for each column and depth.
const VALUES: f64 = 16.0;

#[pymethods]
impl Contact {
    /// The stress below a row of the contact, in the vertical cut along x, as arrays by name.
    ///
    /// `row` is the row of a surface, that of the largest pressure if it is not given; a line has none. `depths` are depths below the surface,
    /// lengths: numbers, or texts such as "1 um", which become metres. `poisson` is Poisson's ratio, that of the solid if it is not given. Stresses are positive in tension, in the unit of the
    /// pressure. They have the shape (depths, nx): sigma_xx, sigma_yy, sigma_zz, tau_xz, tau_xy, tau_yz, the largest shear stress tau_max and
    /// the equivalent stress von_mises. The entries x, depth, pressure, row and poisson say where they are.
    #[pyo3(signature = (*, row=None, depths=None, poisson=None))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        row: Option<isize>,
        depths: Option<Bound<'py, PyAny>>,
        poisson: Option<f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let row = self.checked_row(row)?;
        let depths = depths.map_or_else(|| Ok(self.contact.usual_depths()), |given| depths_of(&given))?;
        let depths = checked_depths(depths)?;
        let grid = self.contact.problem.surface().grid();
        let fields = VALUES * depths.len() as f64 / grid.shape()[0] as f64;
        Cost::from_fields(grid, fields).check("the stress").map_err(py_error)?;
        let known = poisson.or(self.setup.poisson());
        if known.is_none() {
            warnings::warn(py, self.setup.warning_of_stress().as_slice())?;
        }
        let solved = py.try_detached(|| self.contact.stress(row, known.unwrap_or(USUAL_POISSON), &depths))?;
        let table = self.stress_table(py, &solved)?;
        table.set_item("pressure", vector(py, self.contact.pressure.row(row).to_vec()))?;
        table.set_item("row", row)?;
        Ok(table)
    }
}

impl Contact {
    /// The row that is asked for, or that of the largest pressure.
    fn checked_row(&self, row: Option<isize>) -> PyResult<usize> {
        let grid = self.contact.problem.surface().grid();
        let rows = grid.shape()[0];
        match row {
            Some(_) if grid.is_line() => bail("row chooses a row of a surface, but this is a line: leave it out"),
            Some(row) => index_of("row", row, rows),
            None => Ok(self.contact.highest_row()),
        }
    }

    /// The stresses by name, where they are, and Poisson's ratio.
    fn stress_table<'py>(&self, py: Python<'py>, stress: &Stress) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        table.set_item("x", vector(py, self.contact.problem.surface().grid().x().collect()))?;
        table.set_item("depth", vector(py, stress.depth.clone()))?;
        let (tau_max, von_mises) = py.detached(|| (stress.tau_max(), stress.von_mises()))?;
        let fields = [
            ("sigma_xx", &stress.xx),
            ("sigma_yy", &stress.yy),
            ("sigma_zz", &stress.zz),
            ("tau_xz", &stress.xz),
            ("tau_xy", &stress.xy),
            ("tau_yz", &stress.yz),
            ("tau_max", &tau_max),
            ("von_mises", &von_mises),
        ];
        fields.into_iter().try_for_each(|(name, field)| table.set_item(name, PyArray2::from_array(py, field)))?;
        table.set_item("poisson", stress.poisson)?;
        Ok(table)
    }
}

/// Depths, which are numbers or texts with units.
fn depths_of(given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    const WANTED: &str = "a list of lengths, numbers or texts such as '1 um'";
    let depth = |it: PyResult<Bound<'_, PyAny>>| {
        let it = it?;
        match it.extract() {
            Ok(Depth::Number(depth)) => Ok(depth),
            Ok(Depth::Text(text)) => match length_of(&text) {
                Some(depth) => Ok(depth),
                None => bail(format!("a depth is '{text}': give a length, a number or one with a unit such as '1 um'")),
            },
            Err(_) => Err(wrong_type("a depth", "a length, a number or a text such as '1 um'", &it)),
        }
    };
    match given.try_iter() {
        Ok(depths) if !given.is_instance_of::<PyString>() => {
            let depths: Vec<f64> = depths.take(MOST_DEPTHS + 1).map(depth).collect::<PyResult<_>>()?;
            match depths.len() > MOST_DEPTHS {
                true => bail(format!("depths has more than {MOST_DEPTHS} values: give fewer")),
                false => Ok(depths),
            }
        }
        _ => Err(wrong_type("depths", WANTED, given)),
    }
}

/// A depth as it is given.
#[derive(FromPyObject)]
enum Depth {
    Number(f64),
    Text(String),
}

/// Depths that are finite and not above the surface.
fn checked_depths(depths: Vec<f64>) -> PyResult<Vec<f64>> {
    match depths.iter().find(|depth| !(depth.is_finite() && **depth >= 0.0)) {
        Some(depth) => bail(format!("a depth is {depth}: give finite depths from 0 on")),
        None if depths.is_empty() => bail("no depths are given: give at least one"),
        None => Ok(depths),
    }
}
