//! A plateau-honed surface: a fine plateau with the grooves of an earlier step, as the lower of two random surfaces, beside the plateau
//! alone and the grooves alone.
//!
//! `cargo run --release --example plateau_honed [points]`

use asperity::contact::{ContactModulus, Load, Multilevel, Solver};
use asperity::surface::{Lay, RandomRoughness, RoughnessScale, Spectrum, Texture};
use asperity::{Grid, Problem, Stop, Surface};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = std::env::args().nth(1).map_or(Ok(256), |points| points.parse())?;
    let grid = Grid::surface([points; 2], [1e-3; 2])?;
    let short_cutoff = 16e-3 / points as f64;
    let law = |rolloff_wavelength| Spectrum { hurst: 0.8, rolloff_wavelength, short_cutoff, rms_gradient: 1.0 };
    let fine = RandomRoughness { scale: RoughnessScale::RmsHeight(50e-9), ..law(100e-6).into() };
    let coarse = RandomRoughness {
        scale: RoughnessScale::RmsHeight(1e-6),
        lay: Lay { peklenik: 4.0, angle: 30.0 },
        ..law(250e-6).into()
    };
    let [plateau, rough] = [fine.surface(grid, 1)?, coarse.surface(grid, 2)?];
    // a third of the grooves lies above the plateau, and is honed off
    let lifted = Surface::new(grid, rough.heights_as_given() + 0.4e-6)?;
    let honed = plateau.lower(&lifted);
    println!("{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}", "", "Ssk", "Sku", "Spk, nm", "Svk, nm", "area", "gap, nm");
    for (name, surface) in [("plateau", plateau), ("grooves", lifted), ("honed", honed)] {
        let texture = Texture::new(&surface);
        let problem = Problem::new(surface, ContactModulus(100e9), Load::MeanPressure(50e6))?;
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ())?.converged()?;
        println!(
            "{name:>8} {:>8.2} {:>8.2} {:>8.0} {:>8.0} {:>8.4} {:>8.0}",
            texture.skewness,
            texture.kurtosis,
            1e9 * texture.core.peaks,
            1e9 * texture.core.valleys,
            contact.resolved().relative_area,
            1e9 * contact.mean_gap(),
        );
    }
    Ok(())
}
