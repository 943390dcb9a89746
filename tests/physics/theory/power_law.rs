//! Power laws: definitions, limits, and the load that the pressure carries.

use super::integral;
use asperity::theory::Geometry::{self, Line, Point};
use asperity::theory::PowerLaw;
use std::f64::consts::PI;

fn indenter(geometry: Geometry, exponent: f64) -> PowerLaw {
    PowerLaw { geometry, coefficient: 0.3, exponent, contact_modulus: 2.0 }
}

#[test]
fn kappa_r_of_the_first_four_exponents() {
    let line = [2.0, 1.47021, 1.34164, 1.28330];
    let point = [2.0, 1.66608, 1.53960, 1.47262];
    for (n, (line, point)) in line.into_iter().zip(point).enumerate() {
        let n = n as f64 + 1.0;
        assert!((indenter(Line, n).kappa_r() - line).abs() < 5e-6);
        assert!((indenter(Point, n).kappa_r() - point).abs() < 5e-6);
    }
}

#[test]
fn kappa_r_is_its_definition() {
    for n in [1.0, 1.5, 2.0, 3.3, 10.0] {
        let (line, point, a) = (indenter(Line, n), indenter(Point, n), 0.7);
        let of_line = 2.0 * a * line.rms_gradient_contact(a) * 2.0 / line.load(a);
        let of_point = PI * a * a * point.rms_gradient_contact(a) * 2.0 / point.load(a);
        assert!((line.kappa_r() / of_line - 1.0).abs() < 1e-13);
        assert!((point.kappa_r() / of_point - 1.0).abs() < 1e-13);
    }
}

#[test]
fn wedge_and_cone_have_their_logarithmic_pressure() {
    let (wedge, cone) = (indenter(Line, 1.0), indenter(Point, 1.0));
    assert!((wedge.load(0.4) - 2.0 * 0.3 * 0.4).abs() < 1e-15);
    assert!((cone.half_width(1.7) - (2.0 * 1.7 / (PI * 2.0 * 0.3)).sqrt()).abs() < 1e-14);
    for x in [1e-9, 0.1, 0.3, 0.3999] {
        let log = (0.4_f64 / x).acosh();
        assert!((wedge.pressure(0.4, x) - 2.0 * 0.3 / PI * log).abs() < 1e-13);
        assert!((cone.pressure(0.4, -x) - 2.0 * 0.3 / 2.0 * log).abs() < 1e-13);
    }
    assert_eq!((wedge.pressure(0.4, 0.0), cone.pressure(0.4, 0.4)), (f64::INFINITY, 0.0));
}

#[test]
fn pressure_carries_the_load() {
    for n in [1.2, 1.5, 2.0, 2.7, 3.0, 4.0, 7.5, 64.0] {
        let (line, point, a) = (indenter(Line, n), indenter(Point, n), 1.3);
        // x = a sin^3(t) spreads the nodes to both ends.
        let x = |t: f64| (a * t.sin().powi(3), 3.0 * a * t.sin().powi(2) * t.cos());
        let of_line = 2.0 * integral(0.0, 0.5 * PI, |t| line.pressure(a, x(t).0) * x(t).1);
        let of_point = integral(0.0, 0.5 * PI, |t| 2.0 * PI * x(t).0 * point.pressure(a, x(t).0) * x(t).1);
        assert!((of_line / line.load(a) - 1.0).abs() < 1e-6, "{n}: {of_line}");
        assert!((of_point / point.load(a) - 1.0).abs() < 1e-6, "{n}: {of_point}");
    }
}

#[test]
fn pressure_is_continuous_in_the_middle() {
    for n in [2.0, 2.5, 3.0, 4.0, 9.0] {
        let line = indenter(Line, n);
        assert!((line.pressure(1.0, 1e-12) / line.pressure(1.0, 0.0) - 1.0).abs() < 1e-9, "{n}");
    }
    assert!(PowerLaw { exponent: 1e300, ..indenter(Line, 1.0) }.pressure(1.0, 0.5).is_nan());
}

#[test]
fn half_width_inverts_the_load() {
    for geometry in [Line, Point] {
        for n in [1.0, 2.0, 3.7] {
            let indenter = indenter(geometry, n);
            assert!((indenter.half_width(indenter.load(0.8)) - 0.8).abs() < 1e-14);
        }
    }
}
