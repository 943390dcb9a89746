//! Trials on other solids than the periodic half-space.

use super::shapes::{SurfaceMaker, SurfaceResult, noise, rough, shaped, two_peaks};
use super::trial::Trial;
use crate::contact::{ContactModulus, Load, Problem};
use crate::elastic::{Base, Layer};
use crate::error::SetupError;
use crate::grid::Grid;

/// Thicknesses over the length of the cell, from far below the spacing to far beyond the cell.
const THICKNESSES: [f64; 6] = [1e-5, 1e-3, 0.03, 0.3, 3.0, 1e3];

/// Layers thin and thick, on both bases, compressible and not, under pressures and at an approach.
pub(crate) fn layers(grids: [(&'static str, Grid); 2]) -> Vec<Trial> {
    let mut trials = Vec::new();
    for (kind, grid) in grids {
        for (base, name) in [(Base::Bonded, "bonded"), (Base::Sliding, "sliding")] {
            for poisson in [0.0, 0.3, 0.5] {
                for thickness in THICKNESSES {
                    for under in ["light", "heavy", "approach"] {
                        let layer = Layer { contact_modulus: 1.0, poisson, thickness, base };
                        let name = format!("layer-{kind}-{name}-{poisson}-{thickness:e}-{under}");
                        let is_at_mean_gap = under == "approach";
                        let pose = move || {
                            let load = Load::ReducedPressure(if under == "light" { 0.01 } else { 0.3 });
                            let problem = Problem::new(rough(grid)?, layer, load)?;
                            let approach = Load::Approach(0.3 * problem.highest());
                            Ok(if is_at_mean_gap { problem.with_load(approach)? } else { problem })
                        };
                        trials.push(Trial { is_at_mean_gap, ..Trial::new(name, pose) });
                    }
                }
            }
        }
    }
    trials
}

/// Free boundaries: contacts inside, and at the rim and in the corners.
///
/// # Errors
/// None that is known: the grids are fixed.
pub(crate) fn free() -> Result<Vec<Trial>, SetupError> {
    let grids = [
        ("line", Grid::line(512, 1.0)?.with_periodic([true, false])),
        ("line-odd", Grid::line(301, 1.0)?.with_periodic([true, false])),
        ("surface", Grid::surface([32, 48], [1.0, 1.5])?.with_periodic([false; 2])),
    ];
    let shapes: [(&str, SurfaceMaker); 4] =
        [("rough", rough), ("white-noise", noise), ("two-peaks", two_peaks), ("tilted", tilted)];
    let loads = [
        ("lightest", Load::ReducedPressure(1e-6)),
        ("light", Load::ReducedPressure(0.01)),
        ("heavy", Load::ReducedPressure(0.3)),
        ("heaviest", Load::ReducedPressure(30.0)),
        ("approach", Load::Approach(0.01)),
    ];
    let mut trials = Vec::new();
    for (kind, grid) in grids {
        for (name, shape) in shapes {
            for (under, load) in loads {
                let name = format!("free-{kind}-{name}-{under}");
                let is_at_mean_gap = !load.is_pressure();
                let pose = move || Ok(Problem::new(shape(grid)?, ContactModulus(1.0), load)?);
                trials.push(Trial { is_free: true, is_at_mean_gap, ..Trial::new(name, pose) });
            }
        }
    }
    Ok(trials)
}

/// A plane that is highest in a corner, which touches at the rim.
fn tilted(grid: Grid) -> SurfaceResult {
    shaped(grid, |y, x| 0.01 * (x as f64 + 0.3 * y as f64) / grid.len() as f64)
}
