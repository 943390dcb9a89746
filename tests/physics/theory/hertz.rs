//! Hertz contact in closed form.

use asperity::theory::hertz::{KAPPA_R_LINE, KAPPA_R_POINT, cylinder, sphere};
use std::f64::consts::PI;

const A: f64 = 0.2;
const R: f64 = 1.7;
const E: f64 = 3.0;

#[test]
fn line_contact() {
    let contact = cylinder(R, E);
    assert!((contact.load(A) - PI * E * A * A / (4.0 * R)).abs() < 1e-15);
    assert!((contact.rms_gradient_contact(A) - A / (R * 3f64.sqrt())).abs() < 1e-15);
    assert!((contact.kappa_r() - KAPPA_R_LINE).abs() < 1e-14);
    assert!((KAPPA_R_LINE - 8.0 / (PI * 3f64.sqrt())).abs() < 1e-15);
    assert_eq!(contact.approach(A), None);
    for s in [0.0, 1e-7, 0.3, 0.9, 0.999] {
        let expected = E * A / (2.0 * R) * (1.0_f64 - s * s).sqrt();
        assert!((contact.pressure(A, s * A) - expected).abs() < 1e-14);
    }
}

#[test]
fn point_contact() {
    let contact = sphere(R, E);
    assert!((contact.load(A) - 4.0 * E * A.powi(3) / (3.0 * R)).abs() < 1e-15);
    assert!((contact.rms_gradient_contact(A) - A / (R * 2f64.sqrt())).abs() < 1e-15);
    assert!((contact.kappa_r() - KAPPA_R_POINT).abs() < 1e-14);
    assert!((KAPPA_R_POINT - 3.0 * PI / (4.0 * 2f64.sqrt())).abs() < 1e-15);
    assert!((contact.approach(A).unwrap() - A * A / R).abs() < 1e-15);
    assert!((KAPPA_R_LINE / KAPPA_R_POINT - 0.8824).abs() < 5e-5);
    for s in [0.0, 1e-7, 0.3, 0.9, 0.999] {
        let expected = 2.0 * E * A / (PI * R) * (1.0_f64 - s * s).sqrt();
        assert!((contact.pressure(A, s * A) - expected).abs() < 1e-14);
    }
}
