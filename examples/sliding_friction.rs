//! A rough line slides over a solid that creeps: friction is largest at the speed at which the waves and the solid have the same time.
//!
//! `cargo run --release --example sliding_friction`

use asperity::contact::{ContactModulus, Load};
use asperity::history::Sliding;
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Stop, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 1e-6, rms_gradient: 0.02 };
    let rough = Surface::rough(Grid::line(4096, 160e-6)?, &spectrum, 1)?;
    // 10 MPa for fast loads; a tenth of it for slow ones, with a retardation time of 9 ms
    let rest = Problem::new(rough, ContactModulus(10e6), Load::ReducedPressure(0.01))?;
    let creep = [(9.0, 9e-3)];

    println!("speed, m/s  friction  in full contact   Persson     area  pressure within");
    for i in 0..13 {
        let speed = 1e-6 * 10f64.powf(0.5 * f64::from(i));
        // all speeds start from nothing here; a `SlidingProcess` starts each from the one before
        let sliding = Sliding::solve(&rest.clone().sliding(speed, &creep)?, &Stop::default(), &mut ())?;
        let contact = &sliding.contact;
        println!(
            "{speed:>10.2e} {:>9.6} {:>16.6} {:>9.6} {:>8.5} {:>16.1e}",
            sliding.friction,
            sliding.full_contact,
            sliding.persson,
            contact.resolved().relative_area,
            contact.certificate.pressure_error_bound,
        );
    }
    Ok(())
}
