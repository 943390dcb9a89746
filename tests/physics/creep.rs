//! Contacts of viscoelastic solids in time.

mod bounds;
mod cost;
mod energy;
mod errors_in_time;
mod grids;
mod lee_radok;
mod receding;
mod relaxation;
mod stability;
mod turns;

use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
use asperity::elastic::{Prony, PronyTerm};
use asperity::history::{Creep, CreepPath, CreepState, CreepSteps};
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Surface};

/// A rough surface of rms gradient 0.01 whose shortest waves are 16 nodes long.
pub fn rough(grid: Grid, hurst: f64, seed: u64) -> Surface {
    let [_, dx] = grid.spacing();
    let length = grid.size()[1];
    let short_cutoff = (16.0 * dx).min(length / 8.0).max(2.5 * dx);
    let spectrum = Spectrum { hurst, rolloff_wavelength: length / 4.0, short_cutoff, rms_gradient: 0.01 };
    Surface::rough(grid, &spectrum, seed).unwrap()
}

pub fn prony(terms: &[[f64; 2]]) -> Prony {
    Prony::new(terms.iter().map(|&[ratio, time]| PronyTerm { ratio, time }).collect()).unwrap()
}

pub fn tight() -> Stop {
    Stop::new(1e-13, 10_000).unwrap()
}

/// The problem under some load, which the histories do not use.
pub fn problem(surface: Surface) -> Problem {
    Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.01)).unwrap()
}

/// The states of a path with equal steps between its points.
pub fn fixed(problem: &Problem, prony: &Prony, path: Vec<(f64, Load)>, count: usize) -> Vec<CreepState> {
    let creep = Creep::new(problem.clone(), prony.clone());
    let steps = CreepSteps::fixed(creep, CreepPath::new(path).unwrap(), count, &Multilevel, tight()).unwrap();
    steps.map(Result::unwrap).collect()
}
