//! A study of one's own: how far kappa_r of a rough line depends on the Hurst exponent. Run it twice: what is in the table is
//! not solved again.

use asperity::contact::Load;
use asperity::setup::{Cell, Recipe, Setup};
use asperity::study::{Realisation, Spread, Sweep, Table};
use asperity::surface::Spectrum;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hurst = [0.3, 0.6, 0.9];
    let spectrum =
        |hurst| Spectrum { hurst, rolloff_wavelength: 20e-6, short_cutoff: 20e-6 / 32.0, rms_gradient: 1e-3 };
    let line = |hurst, seed| {
        Setup::new(Recipe::rough(spectrum(hurst), seed), Cell::line(1 << 14, 160e-6), Load::ReducedPressure(0.01))
    };
    let loads = Realisation::reduced_pressures(&[0.01, 0.03, 0.1]);
    let realisation =
        |hurst, seed| Realisation { name: "my line".into(), setup: line(hurst, seed), loads: loads.clone() };
    let realisations = hurst.into_iter().flat_map(|hurst| (1..=8).map(move |seed| realisation(hurst, seed))).collect();
    let sweep = Sweep { realisations, workers: 2, memory: None };
    let table = Table::new(std::env::temp_dir().join("asperity_own_study.csv"));
    println!("{} of {} points are in {}", sweep.points_in(&table)?, sweep.points(), table.path().display());
    let points = sweep.run(&table, &|_| ())?;
    for hurst in hurst {
        let points = points.iter().filter(|point| point.hurst == Some(hurst));
        let kappa_r = Spread::from_values(points.map(|point| point.observables.kappa_r));
        println!("H = {hurst}: kappa_r = {:.3}, scatter {:.3}", kappa_r.mean, kappa_r.deviation);
    }
    Ok(())
}
