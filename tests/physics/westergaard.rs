//! The sine: Westergaard's solution from first touch to beyond full contact, and its sister of two dimensions.

use crate::common::{relative_l2, solve, solvers};
use asperity::contact::{Contact, ContactModulus, Load, PolonskyKeer, Problem};
use asperity::theory::Exact;
use asperity::{Grid, Indenter};
use std::f64::consts::{PI, SQRT_2};

const AMPLITUDE: f64 = 0.02;

/// A sine of 2^12 points per period, pressed by `share` of the pressure of full contact.
fn sine(share: f64) -> Problem {
    let indenter = Indenter::Sine { amplitude: AMPLITUDE };
    let surface = indenter.surface(Grid::line(4096, 1.0).unwrap()).unwrap();
    Problem::new(surface, ContactModulus(3.0), Load::MeanPressure(share * PI * 3.0 * AMPLITUDE)).unwrap()
}

#[test]
fn area_mean_gap_and_kappa_r_have_the_exact_digits() {
    // a_rel, mean gap over 2 D, kappa_r
    let exact = [(0.25, 0.286108, 1.45531), (0.50, 0.076713, SQRT_2), (0.75, 0.005644, 1.36815)];
    for (area, gap, kappa_r) in exact {
        let problem = sine((PI * area / 2.0).sin().powi(2));
        let contact = solve(&PolonskyKeer, &problem, 1e-12);
        let measures = contact.counted();
        assert!((measures.relative_area_corrected - area).abs() < 3e-4, "{area}: {measures:?}");
        assert!((contact.mean_gap() / (2.0 * AMPLITUDE) - gap).abs() < 1e-6, "{area}: {}", contact.mean_gap());
        assert!((measures.kappa_r_corrected / kappa_r - 1.0).abs() < 2e-3, "{area}: {measures:?}");
    }
}

#[test]
fn every_solver_is_exact_in_and_beyond_full_contact() {
    for share in [1.0, 1.5, 20.0] {
        let problem = sine(share);
        let exact = Exact::new(
            &Indenter::Sine { amplitude: AMPLITUDE },
            problem.surface().grid(),
            problem.contact_modulus(),
            problem.expected_mean_pressure(),
        );
        for solver in solvers() {
            let contact = solve(solver.as_ref(), &problem, 1e-12);
            let error = relative_l2(&contact.pressure, &exact.as_ref().unwrap().pressure);
            assert!(error < 1e-5, "{} at {share}: {error}", solver.settings());
            assert!(contact.mean_gap() < 1e-9 * AMPLITUDE);
        }
    }
}

fn crossed_sine(points: usize, share: f64) -> Contact {
    let indenter = Indenter::CrossedSine { amplitude: AMPLITUDE };
    let surface = indenter.surface(Grid::surface([points, points], [1.0, 1.0]).unwrap()).unwrap();
    let problem =
        Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(share * SQRT_2 * PI * AMPLITUDE)).unwrap();
    solve(&PolonskyKeer, &problem, 1e-11)
}

/// Areas of Johnson, Greenwood & Higginson's wavy surface, found by another code on 256^2 nodes with the perimeter correction,
/// to half a per cent.
#[test]
fn crossed_sine_has_the_areas_of_johnson_greenwood_and_higginson() {
    for (share, area) in [(0.1, 0.191), (0.2, 0.345), (0.4, 0.620), (0.6, 0.776), (0.8, 0.897), (0.9, 0.951)] {
        let found = crossed_sine(256, share).counted().relative_area_corrected;
        assert!((found / area - 1.0).abs() < 6e-3, "{share}: {found} against {area}");
    }
}

#[test]
fn crossed_sine_closes_at_its_full_pressure() {
    assert_eq!(crossed_sine(64, 1.001).counted().relative_area, 1.0);
    assert!(crossed_sine(64, 0.99).counted().relative_area < 1.0);
}
