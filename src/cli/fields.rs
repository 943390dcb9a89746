//! Fields of other codes, and the parts of a setup that they need.

use super::exit_status::usage;
use anyhow::Result;
use asperity::error::ClaimError;
use asperity::foreign::GivenField;
use asperity::setup::{Setup, SetupTable, Solid};
use asperity::surface::Field;
use ndarray::{ArrayD, Axis, Ix2};

/// Rows and columns of an array; one of rank 1 is a row.
pub(crate) fn rows(array: ArrayD<f64>) -> Result<Field> {
    let array = if array.ndim() == 1 { array.insert_axis(Axis(0)) } else { array };
    Ok(array.into_dimensionality::<Ix2>()?)
}

/// Whether a setup has a load. One that has none gets that of a field of some quantity.
pub(crate) fn lay_load(table: &mut SetupTable, quantity: GivenField, field: &Field) -> Result<bool> {
    check_one_load(table)?;
    if table.has_load() {
        return Ok(true);
    }
    let mean = field.mean().unwrap_or(f64::NAN);
    match quantity {
        GivenField::Pressure => table.lay("load.mean-pressure", mean.abs().into()),
        GivenField::Gap => table.lay("load.mean-gap", mean.into()),
        GivenField::Displacement => return Err(ClaimError::NoLoad.into()),
    }
    Ok(false)
}

/// Refuses lists of loads.
pub(crate) fn check_one_load(table: &mut SetupTable) -> Result<()> {
    match table.take_loads()? {
        Some(loads) if loads.len() > 1 => {
            usage(format!("{} loads are given, but a result has one load: give one", loads.len()))
        }
        _ => Ok(()),
    }
}

/// Refuses a body that yields below its surface, whose contact depends on its past.
pub(crate) fn check_elastic(setup: &Setup) -> Result<()> {
    if setup.feels().eigenstrain {
        return usage(
            "a yield stress is given, but this command is for bodies that have not yielded before: leave it out",
        );
    }
    Ok(())
}

/// Poisson's ratios of the bodies, where they are known.
pub(crate) fn poisson(setup: &Setup) -> Vec<f64> {
    match setup.solid.as_ref().map(Solid::as_elastic) {
        Some(Solid::Bodies(first, second)) => {
            [Some(first), second.as_ref()].into_iter().flatten().map(|it| it.poisson).collect()
        }
        Some(Solid::Layer { poisson, .. }) => vec![*poisson],
        Some(_) | None => Vec::new(),
    }
}
