//! The finding of van Dokkum et al. (2018): for rough lines `kappa` depends on the Hurst exponent and the load, `kappa_r` does
//! not and is near 1.75.
//!
//! The table is printed with `cargo test --release --test physics paper:: -- --nocapture`.

use crate::common::solve;
use asperity::contact::{Contact, ContactModulus, Dynamics, Gfmd, Load, Masses, Problem};
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};

const HURST: [f64; 3] = [0.2, 0.5, 0.8];
const REDUCED_PRESSURES: [f64; 3] = [1e-3, 1e-2, 1e-1];

/// The paper's profile (Sec. 3), of 2^17 instead of 2^18 points: 32 points per shortest wavelength instead of 64.
fn profile(hurst: f64, seed: u64) -> Surface {
    let (period, rolloff) = (160e-6, 20e-6);
    let spectrum = Spectrum { hurst, rolloff_wavelength: rolloff, short_cutoff: rolloff / 512.0, rms_gradient: 1e-3 };
    Surface::rough(Grid::line(1 << 17, period).unwrap(), &spectrum, seed).unwrap()
}

fn contact(hurst: f64, reduced_pressure: f64) -> Contact {
    let problem =
        Problem::new(profile(hurst, 1), ContactModulus(1.0), Load::ReducedPressure(reduced_pressure)).unwrap();
    let solver = Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, ..Gfmd::default() };
    solve(&solver, &problem, 1e-8)
}

#[test]
fn kappa_r_of_rough_lines_is_constant_and_kappa_is_not() {
    println!("   H     p*    kappa  kappa_r   resolved");
    let table = HURST.map(|hurst| {
        REDUCED_PRESSURES.map(|reduced_pressure| {
            let contact = contact(hurst, reduced_pressure);
            let (m, resolved) = (contact.counted(), contact.resolved());
            println!("{hurst:>4} {reduced_pressure:>6} {:>8.3} {:>8.3} {:>10.3}", m.kappa, m.kappa_r, resolved.kappa_r);
            m
        })
    });
    for row in table {
        for m in row {
            // the nodes of the paper are counted, too
            assert!((m.kappa_r / 1.75 - 1.0).abs() < 0.06, "{m:?}");
        }
        let [light, _, heavy] = row;
        assert!(light.kappa > 1.15 * heavy.kappa, "kappa falls with load: {light:?} {heavy:?}");
    }
    let [low, _, high] = table.map(|row| row[1].kappa);
    assert!(low > 1.15 * high, "kappa falls with the Hurst exponent: {low} {high}");
}
