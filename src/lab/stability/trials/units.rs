//! Units, with results that must be those of the unit case.

use super::shapes::{Grids, STRAIN, rough};
use crate::contact::{ContactModulus, Load, Problem};
use crate::error::SetupError;
use crate::grid::Grid;
use crate::lab::stability::trial::{Pose, Trial};
use crate::surface::Surface;

/// Units of length and pressure.
const UNITS: [[f64; 2]; 8] =
    [[1e-12, 1.0], [1e12, 1.0], [1.0, 1e-15], [1.0, 1e15], [1e-12, 1e-15], [1e-12, 1e15], [1e12, 1e-15], [1e12, 1e15]];
/// Close enough to the solution for its dimensionless results to agree.
const TOLERANCE: f64 = 1e-12;

pub fn trials(grids: Grids) -> Vec<Trial> {
    let [_, points] = grids.line.shape();
    let trial = |[length, modulus]: [f64; 2]| {
        let pose = move || posed(points, [length; 2], modulus, STRAIN * modulus);
        let twin: Pose = Box::new(move || posed(points, [1.0; 2], 1.0, STRAIN));
        let trial = Trial::new(format!("length-{length:e}-modulus-{modulus:e}"), pose).to(TOLERANCE);
        Trial { twin: Some(twin), ..trial }
    };
    UNITS.map(trial).into()
}

/// A rough line of some length and unit of heights, modulus and mean pressure.
pub fn posed(points: usize, [length, unit]: [f64; 2], modulus: f64, pressure: f64) -> Result<Problem, SetupError> {
    let line = Grid::line(points, 1.0)?;
    let heights = rough(line).surface(line)?.height() * unit;
    let surface = Surface::new(Grid::line(points, length)?, heights)?;
    Ok(Problem::new(surface, ContactModulus(modulus), Load::MeanPressure(pressure))?)
}
