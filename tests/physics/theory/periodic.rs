//! Periodic contacts of a line: the sine, narrow contacts, strip punches.

use super::integral;
use asperity::theory::periodic::{strip_load, strip_penetration, strip_pressure};
use asperity::theory::{Geometry, Periodic, PowerLaw, Westergaard, hertz};
use std::f64::consts::{FRAC_PI_2, TAU};

const PARABOLA: Periodic<fn(f64) -> f64> = Periodic { slope: |s| s / 0.5, period: 2.0, contact_modulus: 3.0 };

fn sine() -> (Westergaard, Periodic<impl Fn(f64) -> f64>) {
    let sine = Westergaard { amplitude: 0.3, period: 1.7, contact_modulus: 2.0 };
    let slope = move |s: f64| TAU * 0.3 / 1.7 * (TAU * s / 1.7).sin();
    (sine, Periodic { slope, period: 1.7, contact_modulus: 2.0 })
}

#[test]
fn parabola_at_four_widths() {
    let digits =
        [(0.01, 1.000165, 1.46997), (0.05, 1.004140, 1.46415), (0.10, 1.016896, 1.44578), (0.25, 1.123688, 1.30838)];
    for (relative, load, kappa_r) in digits {
        let a = relative * PARABOLA.period;
        let isolated = hertz::cylinder(0.5, 3.0).load(a);
        assert!((PARABOLA.load(a) / isolated - load).abs() < 5e-7, "{}", PARABOLA.load(a) / isolated);
        assert!((PARABOLA.kappa_r(a) - kappa_r).abs() < 5e-6, "{}", PARABOLA.kappa_r(a));
    }
}

#[test]
fn sine_is_westergaard() {
    let (exact, sine) = sine();
    for relative in [0.001, 0.05, 0.125, 0.25, 0.375, 0.45, 0.499] {
        let a = relative * 1.7;
        let mean = exact.mean_pressure(a);
        assert!((sine.load(a) / (1.7 * mean) - 1.0).abs() < 1e-12, "load at {relative}");
        assert!((sine.kappa_r(a) / exact.kappa_r(mean) - 1.0).abs() < 1e-11, "kappa_r at {relative}");
        assert!((sine.mean_gap(a) - exact.mean_gap(mean)).abs() < 1e-13, "gap at {relative}");
        let profile = sine.pressure(a);
        for s in [0.0, 1e-6, 0.1, 0.5, 0.9, 0.9999] {
            let (found, expected) = (profile.at(s * a), exact.pressure(mean, s * a));
            assert!((found - expected).abs() < 1e-7 * expected, "{relative}, {s}: {found} {expected}");
        }
        assert_eq!(profile.at(1.001 * a), 0.0);
    }
}

#[test]
fn narrow_contacts_are_isolated() {
    for n in [1.0, 1.5, 2.0, 3.0, 4.5] {
        let contact = Periodic { slope: |s: f64| 0.2 * n * s.powf(n - 1.0), period: 1.0, contact_modulus: 1.0 };
        let isolated = PowerLaw { geometry: Geometry::Line, coefficient: 0.2, exponent: n, contact_modulus: 1.0 };
        let (a, profile) = (1e-4, contact.pressure(1e-4));
        assert!((contact.load(a) / isolated.load(a) - 1.0).abs() < 1e-6, "{n}");
        assert!((contact.kappa_r(a) / isolated.kappa_r() - 1.0).abs() < 1e-6, "{n}");
        for x in [0.0, 1e-7, 3e-5, 9.9e-5] {
            let (found, expected) = (profile.at(x), isolated.pressure(a, x));
            assert!(found == expected || (found / expected - 1.0).abs() < 1e-6, "{n}, {x}: {found} {expected}");
        }
    }
}

#[test]
fn pressure_carries_the_load() {
    for relative in [0.01, 0.2, 0.4, 0.49] {
        let a = relative * PARABOLA.period;
        let profile = PARABOLA.pressure(a);
        let load = 2.0 * integral(0.0, FRAC_PI_2, |t| profile.at(a * t.sin()) * a * t.cos());
        assert!((load / PARABOLA.load(a) - 1.0).abs() < 1e-8, "{relative}: {load}");
    }
}

#[test]
fn half_width_inverts_the_load() {
    for relative in [1e-9, 1e-3, 0.1, 0.3, 0.49] {
        let a = relative * PARABOLA.period;
        assert!((PARABOLA.half_width(PARABOLA.load(a)).unwrap() / a - 1.0).abs() < 1e-12);
    }
    for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(PARABOLA.half_width(load), None);
    }
}

#[test]
fn strip_punch() {
    let load = integral(-FRAC_PI_2, FRAC_PI_2, |t: f64| strip_pressure(0.7, 0.3, 2.0, 0.3 * t.sin()) * 0.3 * t.cos());
    assert!((load / (0.7 * 2.0) - 1.0).abs() < 1e-10, "{load}");
    let half = integral(0.0, 0.2, |x| strip_pressure(0.7, 0.3, 2.0, x));
    assert!((strip_load(0.3, 2.0, 0.2) - half / 1.4).abs() < 1e-12);
    assert_eq!((strip_load(0.3, 2.0, 0.4), strip_load(0.3, 2.0, -0.3)), (0.5, -0.5));
    assert_eq!(strip_pressure(0.7, 0.3, 2.0, 0.31), 0.0);
    assert!(strip_penetration(1.0, 0.5, 1.0, 1.0).abs() < 1e-7);
}
