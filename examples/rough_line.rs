//! `kappa` and `kappa_r` of one rough profile over two decades of load: the one drifts, the other does not.
//!
//! `cargo run --release --example rough_line`

use asperity::contact::{ContactModulus, Dynamics, Gfmd, Load, Masses, Solver};
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let period = 160e-6;
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: period / 8.0, short_cutoff: period / 512.0, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::line(1 << 14, period)?, &spectrum, 1)?;
    // masses proportional to mode stiffness: the same state of rest as the paper's uniform masses, in far fewer steps
    let solver = Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, ..Gfmd::default() };
    println!("    p*    area    patches  kappa   kappa_r  counted  steps");
    let mut problem = Problem::new(surface, ContactModulus(1e9), Load::ReducedPressure(1e-3))?;
    for reduced_pressure in [1e-3, 3e-3, 1e-2, 3e-2, 1e-1] {
        problem = problem.with_load(Load::ReducedPressure(reduced_pressure))?;
        let contact = solver.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let resolved = contact.resolved();
        println!(
            "{reduced_pressure:>6}  {:.5}  {:>6}   {:.3}   {:.3}    {:.3}      {}",
            resolved.relative_area,
            contact.patches().count(),
            resolved.relative_area / reduced_pressure,
            resolved.kappa_r,
            contact.counted().kappa_r,
            contact.work.iterations
        );
    }
    Ok(())
}
