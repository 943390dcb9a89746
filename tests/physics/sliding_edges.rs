//! The edges of contacts that slide over viscoelastic solids, against elastic contacts at both ends and finer grids between.

use crate::common::solve;
use asperity::contact::{Contact, ContactModulus, Load, MonotoneSets, Multilevel, Problem};
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Surface};

const CREEP: f64 = 9.0;

fn spectrum(short_cutoff: f64) -> Spectrum {
    Spectrum { hurst: 0.8, rolloff_wavelength: 0.125, short_cutoff, rms_gradient: 0.02 }
}

fn line(points: usize, seed: u64) -> Surface {
    Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum(1.0 / 64.0), seed).unwrap()
}

fn pressed(surface: Surface, modulus: f64, pressure: f64) -> Problem {
    Problem::new(surface, ContactModulus(modulus), Load::MeanPressure(pressure)).unwrap()
}

fn sliding(surface: Surface, pressure: f64, speed: f64) -> Contact {
    solve(&MonotoneSets, &pressed(surface, 1.0, pressure).sliding(speed, &[(CREEP, 1.0)]).unwrap(), 1e-9)
}

#[test]
fn explore() {
    for seed in [1, 2] {
        for lag in [1e-9, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 1e9] {
            let coarse = 512;
            let of = |points| sliding(line(points, seed), 2e-4, lag / coarse as f64);
            let found = [coarse, 2 * coarse, 4 * coarse, 32 * coarse].map(of);
            let area = found.each_ref().map(|it| it.resolved().relative_area);
            let kappa = found.each_ref().map(|it| it.resolved().kappa_r);
            let old = found.each_ref().map(|it| it.counted().relative_area);
            let [a, b, c] = [0, 1, 2].map(|i| 100.0 * (area[i] / area[3] - 1.0));
            let [d, e, f] = [0, 1, 2].map(|i| 100.0 * (old[i] / area[3] - 1.0));
            println!("{seed} lag {lag:8.2e} area {:.6} error {a:+.2} {b:+.2} {c:+.2} % counted {d:+.2} {e:+.2} {f:+.2} kappa_r {kappa:.4?} modulus {:.4}", area[3], found[3].problem.effective_modulus(found[3].pressure.as_slice().unwrap()));
        }
    }
}
