//! The electrical resistance of a rough contact of copper against its load, beside that of one disc of the same area (Holm).
//!
//! `cargo run --release --example contact_resistance`

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::flow::Conductance;
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};
use std::f64::consts::PI;

/// The resistivity of copper, in ohm metres.
const COPPER: f64 = 1.7e-8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = Grid::surface([512, 512], [1e-3; 2])?;
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 125e-6, short_cutoff: 16e-6, rms_gradient: 0.05 };
    let rough = Surface::rough(grid, &spectrum, 1)?;
    println!("{:>10} {:>8} {:>16} {:>14} {:>14}", "pressure", "area", "S/m^2", "rough, ohm", "one disc, ohm");
    for pressure in [1e6, 3e6, 1e7, 3e7, 1e8, 3e8, 1e9] {
        let problem = Problem::new(rough.clone(), ContactModulus(70e9), Load::MeanPressure(pressure))?;
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let conductance = Conductance::new(&contact, [COPPER; 2])?;
        let area = contact.resolved().relative_area;
        let disc = 4.0 * (area * grid.area() / PI).sqrt() / (2.0 * COPPER);
        println!(
            "{pressure:>10.0e} {area:>8.5} {:>16.4e} {:>14.3e} {:>14.3e}",
            conductance.per_area,
            1.0 / conductance.total,
            1.0 / disc
        );
    }
    Ok(())
}
