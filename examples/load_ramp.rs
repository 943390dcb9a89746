//! A rough line pressed from a light touch to beyond full contact and back, each load started from the contact of the last one.
//!
//! `cargo run --release --example load_ramp`

use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Solver, Stop};
use asperity::surface::Spectrum;
use asperity::{Contact, Grid, Surface};

/// Loads `p*` from 1e-4 on, each a fifth more than the last: this line is in full contact at about 2.
const LOADS: i32 = 60;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff: 0.125 / 64.0, rms_gradient: 1e-3 };
    let surface = Surface::rough(Grid::line(1 << 14, 1.0)?, &spectrum, 1)?;
    let mut problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(1e-4))?;
    let loads = (0..=LOADS).chain((0..LOADS).rev()).map(|i| 1e-4 * 1.2f64.powi(i));

    println!(
        "{:>10} {:>8} {:>8} {:>12} {:>12} {:>12}",
        "p*", "area", "kappa_r", "certificate", "transforms", "from flat"
    );
    let mut last: Option<Contact> = None;
    for load in loads {
        problem = problem.with_load(Load::ReducedPressure(load))?;
        let start = last.as_ref().map(|contact| &contact.pressure);
        let contact = Multilevel.solve_from(start, &problem, &Stop::default(), &mut ())?.converged()?;
        let flat = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        let resolved = contact.resolved();
        println!(
            "{load:>10.2e} {:>8.4} {:>8.4} {:>12.1e} {:>12} {:>12}",
            resolved.relative_area,
            resolved.kappa_r,
            contact.certificate.eta,
            contact.work.transforms,
            flat.work.transforms
        );
        last = Some(contact);
    }
    Ok(())
}
