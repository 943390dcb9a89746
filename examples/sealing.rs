//! The area at which random roughness seals: its mean and spread over ten surfaces, in cells of three sizes.
//!
//! `cargo run --release --example sealing [points of the smallest cell] [Hurst exponent]`

use asperity::contact::{ContactModulus, Load, Multilevel, Stop};
use asperity::flow::{FlowAxis, PercolationLoad};
use asperity::study::Spread;
use asperity::surface::Spectrum;
use asperity::{Grid, Problem, Surface};
use rayon::prelude::*;

/// Points of the roll-off and of the shortest wave, in cells of any size.
const ROLLOFF: f64 = 32.0;
const SHORTEST: f64 = 8.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let smallest: usize = words.next().map_or(Ok(64), |word| word.parse())?;
    let hurst: f64 = words.next().map_or(Ok(0.8), |word| word.parse())?;
    println!("Hurst exponent {hurst}: mean and standard deviation over ten surfaces, along x");
    println!(
        "{:>7} {:>11} {:>17} {:>17} {:>17} {:>17}",
        "points", "L/roll-off", "area, edges", "area, corrected", "area, counted", "p*"
    );
    for points in [1, 2, 4].map(|factor| factor * smallest) {
        let found: Vec<PercolationLoad> =
            (1..=10u64).into_par_iter().map(|seed| seal(points, hurst, seed)).collect::<Result<_, _>>()?;
        // halfway between the last state that is open and the first one that is not
        let spread = |of: fn(&asperity::flow::PercolationState) -> f64| {
            let values = found.iter().map(|it| 0.5 * (of(&it.open) + of(&it.sealed)));
            let Spread { mean, deviation, .. } = Spread::from_values(values);
            format!("{mean:.4} +- {deviation:.4}")
        };
        println!(
            "{points:>7} {:>11} {:>17} {:>17} {:>17} {:>17}",
            points as f64 / ROLLOFF,
            spread(|it| it.relative_area),
            spread(|it| it.relative_area_corrected),
            spread(|it| it.relative_area_counted),
            spread(|it| it.reduced_pressure),
        );
    }
    Ok(())
}

/// The load that seals a surface along x, to a thousandth.
fn seal(points: usize, hurst: f64, seed: u64) -> Result<PercolationLoad, String> {
    let length = |points_of: f64| points_of / points as f64;
    let spectrum =
        Spectrum { hurst, rolloff_wavelength: length(ROLLOFF), short_cutoff: length(SHORTEST), rms_gradient: 1e-2 };
    let grid = Grid::surface([points; 2], [1.0; 2]).map_err(|error| error.to_string())?;
    let surface = Surface::rough(grid, &spectrum, seed).map_err(|error| error.to_string())?;
    let problem = Problem::new(surface, ContactModulus(1.0), Load::ReducedPressure(0.1));
    let problem = problem.map_err(|error| error.to_string())?;
    let found = PercolationLoad::new(&problem, &Multilevel, &Stop::default(), FlowAxis::X, 1e-3, |_| ());
    found.map_err(|error| error.to_string())
}
