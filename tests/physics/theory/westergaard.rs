//! The sine in closed form.

use super::integral;
use asperity::theory::{Westergaard, crossed_full_pressure, hertz};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

const SINE: Westergaard = Westergaard { amplitude: 0.3, period: 1.7, contact_modulus: 2.0 };

fn at(relative_area: f64) -> f64 {
    SINE.mean_pressure(0.5 * relative_area * SINE.period)
}

#[test]
fn kappa_r_at_four_areas() {
    for (area, kappa_r) in [(0.10, 1.46780), (0.25, 1.45531), (0.50, SQRT_2), (0.75, 1.36815)] {
        assert!((SINE.relative_area(at(area)) - area).abs() < 1e-14);
        assert!((SINE.kappa_r(at(area)) - kappa_r).abs() < 5e-6);
    }
    assert!((SINE.kappa_r(at(1e-6)) - hertz::KAPPA_R_LINE).abs() < 1e-10);
    assert!((SINE.kappa_r(SINE.full_pressure()) - 2f64.sqrt()).abs() < 1e-14);
}

#[test]
fn mean_gap_at_three_areas() {
    for (area, gap) in [(0.25, 0.286108), (0.50, 0.076713), (0.75, 0.005644)] {
        assert!((SINE.mean_gap(at(area)) / (2.0 * SINE.amplitude) - gap).abs() < 5e-7);
    }
    assert_eq!((SINE.mean_gap(0.0), SINE.mean_gap(2.0 * SINE.full_pressure())), (SINE.amplitude, 0.0));
}

#[test]
fn area_is_the_formula_in_reduced_pressure() {
    let gradient = TAU * SINE.amplitude / SINE.period / 2f64.sqrt();
    for pressure in [1e-6, 0.01, 0.2, 0.9].map(|p| p * SINE.full_pressure()) {
        let reduced = pressure / (gradient * SINE.contact_modulus);
        let expected = 2.0 / PI * (2f64.sqrt() * reduced).sqrt().asin();
        assert!((SINE.relative_area(pressure) - expected).abs() < 1e-14);
    }
}

#[test]
fn pressure_carries_the_load_and_joins_full_contact() {
    for area in [0.1, 0.5, 0.9] {
        let (pressure, a) = (at(area), 0.5 * area * SINE.period);
        let load = 2.0 * integral(0.0, FRAC_PI_2, |t| SINE.pressure(pressure, a * t.sin()) * a * t.cos());
        assert!((load / (pressure * SINE.period) - 1.0).abs() < 1e-12);
    }
    let full = SINE.full_pressure();
    for x in [0.0, 0.3, 0.8, -1.5] {
        let (below, above) = (SINE.pressure(full * (1.0 - 1e-15), x), SINE.pressure(full, x));
        assert!((below - above).abs() < 1e-6 * full);
    }
}

#[test]
fn crossed_sines() {
    let expected = 2f64.sqrt() * PI * 2.0 * 0.3 / 1.7;
    assert!((crossed_full_pressure(0.3, [1.7, 1.7], 2.0) - expected).abs() < 1e-14);
}
