//! A rough seal under growing load: how much leaks, with bounds, until nothing does.
//!
//! `cargo run --release --example leakage [points]`

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::flow::{FlowAxis, Leakage, Percolation};
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = std::env::args().nth(1).map_or(Ok(256), |points| points.parse())?;
    let grid = Grid::surface([points; 2], [1e-3; 2])?;
    // eight waves of the roll-off a side, and eight points for the shortest wave
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: 125e-6, short_cutoff: 8e-3 / points as f64, rms_gradient: 0.1 };
    let rough = Surface::rough(grid, &spectrum, 1)?;
    println!(
        "{:>6} {:>7} {:>5} {:>5} {:>12} {:>12} {:>8} {:>11}",
        "p*", "area", "x", "y", "lower/<g>^3", "upper/<g>^3", "width", "seconds"
    );
    for reduced_pressure in [0.01, 0.03, 0.1, 0.15, 0.2, 0.24, 0.28, 0.32] {
        let problem = Problem::new(rough.clone(), ContactModulus(1e9), Load::ReducedPressure(reduced_pressure))?;
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let percolation = Percolation::from_contact(&contact);
        let [along_x, along_y] =
            FlowAxis::ALL.map(|axis| if percolation.open_percolates(axis) { "open" } else { "shut" });
        let start = Instant::now();
        let leakage = Leakage::from_contact(&contact, FlowAxis::X, Leakage::TOLERANCE)?.converged()?;
        let (plain, seconds) = (contact.mean_gap().powi(3), start.elapsed().as_secs_f64());
        println!(
            "{reduced_pressure:>6} {:>7.4} {along_x:>5} {along_y:>5} {:>12.5e} {:>12.5e} {:>8.1e} {:>5.2} {:>5.2}",
            contact.resolved().relative_area,
            leakage.lower / plain,
            leakage.upper / plain,
            leakage.width(),
            contact.work.seconds,
            seconds,
        );
    }
    Ok(())
}
