//! Partial slip against Cattaneo and Mindlin.

use crate::common::solve;
use asperity::contact::{Contact, ContactModulus, Friction, Load, Multilevel, PartialSlip, Problem, Stop};
use asperity::error::{InputError, SlipError};
use asperity::surface::{Field, Indenter, Spectrum};
use asperity::{Grid, Surface};

const LOAD: f64 = 1e-3;
const MU: f64 = 0.4;

/// A cylinder or a sphere of unit radius, pressed by the mean pressure `LOAD` on a solid of unit modulus.
fn pressed(surface: Surface, load: Load) -> Contact {
    solve(&Multilevel, &Problem::new(surface, ContactModulus(1.0), load).unwrap(), 1e-12)
}

fn cylinder(points: usize, period: f64) -> Contact {
    let surface = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(points, period).unwrap()).unwrap();
    pressed(surface, Load::MeanPressure(LOAD))
}

/// The contact pulled by a share of the load at which it slides.
fn pulled(pressed: Contact, share: f64) -> PartialSlip {
    let friction = Friction { coefficient: MU, tangential: share * MU * pressed.problem.load().value() };
    let stop = Stop::new(1e-12, 100_000).unwrap();
    PartialSlip::solve(pressed, friction, &Multilevel, &stop, &mut ()).unwrap()
}

#[test]
fn the_width_that_sticks_under_a_cylinder_is_that_of_cattaneo_and_mindlin() {
    for share in [0.1, 0.5, 0.9, 0.99] {
        let slip = pulled(cylinder(1 << 14, 4.0), share);
        let found = slip.stick().relative_area / slip.touching().relative_area;
        let expected = (1.0 - share).sqrt();
        // neighbours in the periodic cell, (a/L)^2, and the place of an edge on the grid
        assert!((found - expected).abs() < 1e-3, "{found} against {expected} at {share}");
        assert!((slip.slip_area() + slip.stick().relative_area - slip.touching().relative_area).abs() < 1e-15);
    }
}

#[test]
fn traction_below_a_cylinder_is_the_difference_of_two_ellipses() {
    let (points, period, share) = (1 << 14, 4.0, 0.64);
    let slip = pulled(cylinder(points, period), share);
    let a = (4.0 * LOAD * period / std::f64::consts::PI).sqrt();
    let (c, peak) = (a * (1.0 - share).sqrt(), 0.5 * a);
    let ellipse = |x: f64, width: f64| (1.0 - (x / width).powi(2)).max(0.0).sqrt();
    for (i, tau) in slip.traction().iter().enumerate() {
        let x = (i as f64 - (points / 2) as f64) * period / points as f64;
        let expected = MU * peak * (ellipse(x, a) - c / a * ellipse(x, c));
        assert!((tau - expected).abs() < 0.03 * MU * peak, "{tau} against {expected} at {x}");
    }
}

/// Equilibrium, and Coulomb's law in every node.
fn check_coulomb(slip: &PartialSlip) {
    let traction = slip.traction();
    let (sticks, pressure) = (slip.sticks(), &slip.pressed.pressure);
    let mean = traction.mean().unwrap();
    let wanted = MU * slip.ratio * slip.pressed.mean_pressure();
    assert!((mean / wanted - 1.0).abs() < 1e-9, "{mean} against {wanted}");
    let peak = slip.pressed.max_pressure();
    for ((&tau, &p), &is_stuck) in traction.iter().zip(pressure).zip(&sticks) {
        assert!(tau > -1e-6 * peak && tau <= MU * p * (1.0 + 1e-12) + 1e-12 * peak);
        assert!(is_stuck || tau == MU * p);
        assert!(!is_stuck || p > 0.0, "what sticks touches");
    }
}

#[test]
fn coulomb_holds_in_every_node_of_a_cylinder_and_a_rough_line() {
    check_coulomb(&pulled(cylinder(4096, 4.0), 0.5));
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.02, rms_gradient: 0.01 };
    let rough = Surface::rough(Grid::line(4096, 1.0).unwrap(), &spectrum, 3).unwrap();
    for share in [0.05, 0.7] {
        check_coulomb(&pulled(pressed(rough.clone(), Load::ReducedPressure(0.05)), share));
    }
}

/// `c/a = (1 - Q/(mu P))^(1/3)` for a sphere.
#[test]
fn a_sphere_sticks_on_the_circle_of_mindlin() {
    let grid = Grid::surface([256, 256], [2.0, 2.0]).unwrap();
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
    let slip = pulled(pressed(sphere, Load::MeanPressure(1e-3)), 0.6);
    let ratio = (slip.stick().relative_area / slip.touching().relative_area).sqrt();
    assert!((ratio - 0.4f64.cbrt()).abs() < 2e-3, "{ratio}");
    check_coulomb(&slip);
}

#[test]
fn what_friction_cannot_carry_is_refused_with_numbers() {
    let pull = |coefficient: f64, tangential: f64, load: Load| Friction { coefficient, tangential }.ratio(load);
    let sliding = pull(0.5, 0.5, Load::MeanPressure(1.0)).unwrap_err();
    assert!(matches!(sliding, SlipError::Sliding { tangential: 0.5, limit: 0.5 }), "{sliding}");
    assert!(sliding.to_string().contains("0.5"));
    let gap = pull(0.5, 0.1, Load::MeanGap(0.1)).unwrap_err();
    assert!(matches!(gap, SlipError::NeedsPressure { .. }), "{gap}");
    for (coefficient, tangential) in [(0.0, 0.1), (f64::NAN, 0.1), (0.5, -0.1), (0.5, f64::INFINITY)] {
        let error = pull(coefficient, tangential, Load::ReducedPressure(1.0)).unwrap_err();
        let named = if coefficient > 0.0 { "the tangential load is" } else { "the coefficient of friction is" };
        assert!(error.to_string().starts_with(named) && error.is_input(), "{error}");
    }
    assert_eq!(pull(0.5, 0.25, Load::ReducedPressure(1.0)).unwrap(), 0.5);
}

#[test]
fn a_traction_has_the_shape_of_the_pressure() {
    let slip = pulled(cylinder(64, 4.0), 0.5);
    let traction: Field = slip.traction();
    assert_eq!(traction.dim(), (1, 64));
}
