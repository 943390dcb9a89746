//! Units, with results that must be those of the unit case.

use super::{Size, rough};
use crate::cli::stability::case::Case;
use anyhow::Result;
use asperity::{Grid, Problem, Surface};

/// Units of length and pressure.
const UNITS: [[f64; 2]; 8] =
    [[1e-12, 1.0], [1e12, 1.0], [1.0, 1e-15], [1.0, 1e15], [1e-12, 1e-15], [1e-12, 1e15], [1e12, 1e-15], [1e12, 1e15]];
/// Close enough to the solution for its dimensionless results to agree.
const TOLERANCE: f64 = 1e-12;
const STRAIN: f64 = 0.01;

pub fn cases(size: Size) -> Vec<Case> {
    let case = |units: [f64; 2]| {
        let [length, modulus] = units;
        Case::new(format!("length-{length:e}-modulus-{modulus:e}"), move || posed(size, units))
            .like(move || posed(size, [1.0, 1.0]))
            .to(TOLERANCE)
    };
    UNITS.map(case).into()
}

/// A rough line whose lengths and pressures are multiplied by their units.
fn posed(size: Size, [length, modulus]: [f64; 2]) -> Result<Problem> {
    let unit = rough(size.line()?)?;
    let surface = Surface::new(Grid::line(size.line, length)?, unit.height() * length)?;
    Ok(Problem::new(surface, modulus, STRAIN * modulus)?)
}
