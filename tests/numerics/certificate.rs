//! Certificates without a feasible pressure, and the penetration.

use asperity::contact::{Certificate, ContactModulus, Load};
use asperity::{Grid, Indenter, Problem};

#[test]
fn nothing_is_bounded_without_a_feasible_pressure() {
    let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(16, 1.0).unwrap()).unwrap();
    let pressed = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(0.5)).unwrap();
    let apart = pressed.clone().with_load(Load::MeanGap(0.5)).unwrap();
    let with = |value: f64| [[1.0; 15].as_slice(), &[value]].concat();
    for problem in [pressed, apart] {
        let Certificate { eta, pressure_error_bound, load_error, min_pressure, penetration } =
            Certificate::of(&problem, &[0.0; 16]);
        assert_eq!([eta, pressure_error_bound, load_error, penetration], [f64::INFINITY; 4]);
        assert_eq!(min_pressure, 0.0);
        for value in [f64::NAN, f64::INFINITY, -1e-3, -100.0] {
            let Certificate { eta, pressure_error_bound, .. } = Certificate::of(&problem, &with(value));
            assert_eq!([eta, pressure_error_bound], [f64::INFINITY; 2], "{value}");
        }
        assert!(Certificate::of(&problem, &with(1.0)).eta.is_finite());
    }
}

#[test]
fn penetration_is_that_of_the_deepest_node() {
    let sine = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(16, 1.0).unwrap()).unwrap();
    let pressed = Problem::new(sine, ContactModulus(1.0), Load::MeanPressure(1.0)).unwrap();
    // under a uniform pressure nothing is displaced: the highest peak lies its height below the mean plane, less the gap
    let found = Certificate::of(&pressed, &[1.0; 16]);
    assert!((found.penetration - found.eta).abs() < 1e-15 && (found.eta - 2f64.sqrt()).abs() < 1e-12);
    assert_eq!(found.pressure_error_bound, f64::INFINITY);
    let apart = pressed.with_load(Load::MeanGap(0.25)).unwrap();
    let found = Certificate::of(&apart, &[1.0; 16]);
    assert!((found.penetration - 0.75 * 2f64.sqrt()).abs() < 1e-12 && found.eta > found.penetration);
}
