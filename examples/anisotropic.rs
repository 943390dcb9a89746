//! A ground surface: the same spectrum with grooves that get longer, its correlation lengths, its contact, and how much leaks along and
//! across the grooves.
//!
//! `cargo run --release --example anisotropic [points]`

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::flow::{FlowAxis, Leakage};
use asperity::surface::{Lay, RandomRoughness, Spectrum, Texture};
use asperity::{Grid, Problem, Stop};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = std::env::args().nth(1).map_or(Ok(256), |points| points.parse())?;
    let grid = Grid::surface([points; 2], [1e-3; 2])?;
    // across the longest grooves the shortest waves are a third as long, and have four points
    let spectrum =
        Spectrum { hurst: 0.8, rolloff_wavelength: 125e-6, short_cutoff: 12e-3 / points as f64, rms_gradient: 0.05 };
    println!(
        "{:>5} {:>9} {:>9} {:>8} {:>7} {:>15} {:>15}",
        "gamma", "along, um", "across", "measured", "area", "leaks along, nm", "leaks across"
    );
    for peklenik in [1.0, 3.0, 9.0] {
        let roughness = RandomRoughness { lay: Lay { peklenik, angle: 0.0 }, ..spectrum.into() };
        let surface = roughness.surface(grid, 1)?;
        let texture = Texture::new(&surface);
        let [across, along] = texture.correlation_length.map(|length| 1e6 * length.unwrap_or(f64::NAN));
        let problem = Problem::new(surface, ContactModulus(1e9), Load::ReducedPressure(0.1))?;
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        // the gap of parallel plates that leak as much
        let plates = |axis| Leakage::from_contact(&contact, axis, 1e-6).map(|it| 1e9 * it.sigma().cbrt());
        println!(
            "{peklenik:>5} {along:>9.2} {across:>9.2} {:>8.2} {:>7.4} {:>15.2} {:>15.2}",
            texture.peklenik().unwrap_or(f64::NAN),
            contact.resolved().relative_area,
            plates(FlowAxis::X)?,
            plates(FlowAxis::Y)?,
        );
    }
    Ok(())
}
