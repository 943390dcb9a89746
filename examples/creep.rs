//! A rough line on a solid that creeps, under a held load: the contact grows as that of an elastic solid under a growing load (Lee and Radok).
//!
//! `cargo run --release --example creep`

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::elastic::{Prony, PronyTerm};
use asperity::history::{Creep, CreepPath, CreepSteps};
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 0.02 };
    let rough = Surface::rough(Grid::line(4096, 160e-6)?, &spectrum, 1)?;
    // the modulus is 10 MPa at once after loading, and a tenth of it after a long time
    let (modulus, reduced_pressure) = (10e6, 0.01);
    let problem = Problem::new(rough, ContactModulus(modulus), Load::ReducedPressure(reduced_pressure))?;
    let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 9e-3 }])?;

    let path = CreepPath::held(problem.load(), 45e-3)?;
    let creep = Creep::new(problem.clone(), prony.clone());
    println!("   time, ms     area  elastic under P J(t)  energy lost, J/m2  bound through time");
    for state in CreepSteps::adaptive(creep, path, 1e-3, &Multilevel, Stop::default())? {
        let state = state?;
        // the elastic contact under the load times the creep compliance
        let load = Load::ReducedPressure(reduced_pressure * prony.creep(state.time));
        let elastic = Multilevel.solve(&problem.clone().with_load(load)?, &Stop::default(), &mut ())?.converged()?;
        println!(
            "{:>11.3} {:>8.5} {:>21.5} {:>18.3e} {:>19.1e}",
            1e3 * state.time,
            state.resolved().relative_area,
            elastic.resolved().relative_area,
            state.energy.lost,
            state.error_bound(),
        );
    }
    Ok(())
}
