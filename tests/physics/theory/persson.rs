//! Persson's area and its corrected form for lines.

use asperity::surface::{PowerSpectrum, Spectrum};
use asperity::theory::persson::{CorrectedArea, KAPPA, KAPPA_BGT, Pressures, relative_area};
use asperity::{Grid, Surface};
use libm::erf;
use std::f64::consts::{PI, SQRT_2};

#[test]
fn slopes_at_small_pressure() {
    assert!((KAPPA - (8.0 / PI).sqrt()).abs() < 1e-15 && (KAPPA - 1.5958).abs() < 5e-5);
    assert!((KAPPA_BGT - (2.0 * PI).sqrt()).abs() < 1e-15 && (KAPPA_BGT - 2.5066).abs() < 5e-5);
    assert!((relative_area(1e-8) / 1e-8 - KAPPA).abs() < 1e-12);
    assert_eq!(relative_area(10.0), 1.0);
}

#[test]
fn corrected_area_ends_in_persson() {
    let corrected = CorrectedArea { b1: 0.6, b2: 3.0 };
    assert!((corrected.kappa(1e-9) - KAPPA / 0.6).abs() < 1e-7);
    assert_eq!(corrected.kappa(0.0), KAPPA / 0.6);
    assert!((corrected.relative_area(3.0) - relative_area(3.0)).abs() < 1e-12);
    assert_eq!(CorrectedArea { b1: 1.0, b2: 3.0 }.relative_area(0.2), relative_area(0.2));
    let expected = erf(SQRT_2 * 0.1 / (0.6 + 0.4 * erf(0.3)));
    assert!((corrected.relative_area(0.1) - expected).abs() < 1e-15);
}

/// Moments of the density over contact: its share, mean and mean square, by the rule of midpoints.
fn moments(pressures: &Pressures) -> [f64; 3] {
    let (largest, steps) = (pressures.mean + 12.0 * pressures.deviation, 200_000);
    let width = largest / f64::from(steps);
    let moment = |power| {
        let term = |i| {
            let p = width * (f64::from(i) + 0.5);
            p.powi(power) * pressures.density(p)
        };
        width * (0..steps).map(term).sum::<f64>()
    };
    [0, 1, 2].map(moment)
}

#[test]
fn pressures_carry_the_load_and_their_share_is_the_area() {
    for (mean, deviation) in [(1e-3, 0.5), (0.1, 0.5), (1.0, 0.5), (3.0, 0.2)] {
        let pressures = Pressures { mean, deviation };
        let [share, load, square] = moments(&pressures);
        assert!((share - pressures.relative_area()).abs() < 1e-8 && (load / mean - 1.0).abs() < 1e-8, "{pressures:?}");
        assert!((square / pressures.mean_square() - 1.0).abs() < 1e-8, "{pressures:?}");
        // a new wave adds to the mean square what is in contact of it: the law behind the spectrum
        let step = 1e-5 * deviation;
        let at = |deviation| Pressures { mean, deviation }.mean_square();
        let slope = (at(deviation + step) - at(deviation - step)) / (4.0 * step * deviation);
        assert!((slope / pressures.relative_area() - 1.0).abs() < 1e-6, "{pressures:?}: {slope}");
    }
}

#[test]
fn the_spectrum_of_pressures_sums_to_their_mean_square() {
    let grids = [Grid::line(1 << 14, 1.0).unwrap(), Grid::surface([512, 512], [1.0, 1.0]).unwrap()];
    for grid in grids {
        let spectrum = Spectrum { hurst: 0.5, rolloff_wavelength: 0.1, short_cutoff: 0.01, rms_gradient: 1e-2 };
        let surface = Surface::rough(grid, &spectrum, 1).unwrap();
        let (modulus, mean) = (3.0, 2e-3);
        let heights = PowerSpectrum::new(&surface);
        let deviation = 0.5 * modulus * heights.integral(|q, density| q * q * density).sqrt();
        let pressures = Pressures::spectrum(mean, modulus, &heights);
        let sum = mean * mean + pressures.integral(|_, density| density);
        let expected = Pressures { mean, deviation }.mean_square();
        assert!((sum / expected - 1.0).abs() < 0.01, "{:?}: {sum} against {expected}", grid.shape());
    }
}
