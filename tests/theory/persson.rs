//! Persson's area and its corrected form for lines.

use asperity::theory::persson::{CorrectedArea, KAPPA, KAPPA_BGT, relative_area};
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
