//! A study of one's own: how far kappa_r of a rough line depends on the Hurst exponent. Run it twice: what is in the table is
//! not solved again.

use asperity::study::{Realisation, Shape, Spread, Sweep, Table};
use asperity::surface::Spectrum;
use asperity::{Grid, Stop};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = Grid::line(1 << 14, 160e-6)?;
    let hurst = [0.3, 0.6, 0.9];
    let spectrum =
        |hurst| Spectrum { hurst, rolloff_wavelength: 20e-6, short_cutoff: 20e-6 / 32.0, rms_gradient: 1e-3 };
    let profile = |hurst, seed| Realisation {
        name: "my line".into(),
        grid,
        shape: Shape::Rough { spectrum: spectrum(hurst), seed },
        loads: vec![0.01, 0.03, 0.1],
    };
    let realisations = hurst.into_iter().flat_map(|hurst| (1..=8).map(move |seed| profile(hurst, seed))).collect();
    let sweep = Sweep { realisations, stop: Stop::default(), workers: 2 };
    let table = Table::new(std::env::temp_dir().join("asperity_own_study.csv"));
    println!("{} of {} points are in {}", sweep.points_in(&table)?, sweep.points(), table.path().display());
    let points = sweep.run(&table, &|_| ())?;
    for hurst in hurst {
        let rows = points.iter().map(|timed| &timed.row).filter(|row| row.hurst == Some(hurst));
        let kappa_r = Spread::of(rows.map(|row| row.kappa_r_corrected));
        println!("H = {hurst}: kappa_r = {:.3}, scatter {:.3}", kappa_r.mean, kappa_r.deviation);
    }
    Ok(())
}
