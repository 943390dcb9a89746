//! Exact solutions on grids: the gap is closed in contact and open elsewhere.

use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Solver, Stop};
use asperity::fourier::{Complex, Fourier};
use asperity::theory::{EllipticHertz, Exact, crossed_full_pressure, hertz};
use asperity::{Grid, Indenter};
use std::f64::consts::PI;

const MODULUS: f64 = 2.0;

/// The gap under the sampled pressure, up to a constant: `u - h` with `u_q = 2 p_q/(E* q)`.
fn gap(indenter: &Indenter, grid: Grid, exact: &Exact) -> Vec<f64> {
    let surface = indenter.surface(grid).unwrap();
    let mut spectrum = vec![Complex::default(); grid.modes()];
    let mut fourier = Fourier::new(&grid);
    fourier.forward(exact.pressure.as_slice().unwrap(), &mut spectrum);
    for (coefficient, q) in spectrum.iter_mut().zip(grid.wavenumbers()) {
        *coefficient *= if q > 0.0 { 2.0 / (MODULUS * q) } else { 0.0 };
    }
    let mut displacement = vec![0.0; grid.len()];
    fourier.inverse(&mut spectrum, &mut displacement);
    displacement.iter().zip(surface.heights()).map(|(u, h)| u - h).collect()
}

/// The largest gap in contact, the smallest outside, and the mean, all over the range of the heights.
fn gaps(indenter: &Indenter, grid: Grid, exact: &Exact) -> [f64; 3] {
    let gap = gap(indenter, grid, exact);
    let surface = indenter.surface(grid).unwrap();
    let bounds = |f: &[f64]| f.iter().fold([f64::MAX, f64::MIN], |[a, b], &v| [a.min(v), b.max(v)]);
    let [low, high] = bounds(surface.heights());
    let nodes = gap.iter().zip(&exact.pressure).zip(surface.heights());
    let touching = nodes.filter(|&((_, &p), &h)| p > 0.0 && h > low);
    let [first, last] = bounds(&touching.map(|((g, _), _)| *g).collect::<Vec<_>>());
    let datum = 0.5 * (first + last);
    let mean = gap.iter().sum::<f64>() / gap.len() as f64;
    [0.5 * (last - first), bounds(&gap)[0] - datum, mean - datum].map(|g| g / (high - low))
}

#[test]
fn line_solutions_close_the_gap_in_contact_and_nowhere_open_it_below_zero() {
    let cases = [
        (Indenter::Sine { amplitude: 0.3 }, 0.4),
        (Indenter::Sine { amplitude: 0.3 }, 5.0),
        (Indenter::Cylinder { radius: 0.25 }, 0.2),
        (Indenter::Cylinder { radius: 0.25 }, 1.5),
        (Indenter::Wedge { slope: 0.3 }, 0.2),
        (Indenter::PowerLaw { coefficient: 1.0, exponent: 1.5 }, 0.3),
        (Indenter::PowerLaw { coefficient: 3.0, exponent: 4.0 }, 0.5),
        (Indenter::Punch { half_width: 100.5 / 4096.0, depth: 1.0 }, 0.1),
    ];
    for (indenter, mean_pressure) in cases {
        let grid = Grid::line(4096, 1.0).unwrap();
        let exact = Exact::new(&indenter, &grid, MODULUS, mean_pressure).unwrap();
        let [in_contact, smallest, mean] = gaps(&indenter, grid, &exact);
        assert!(in_contact < 1e-3, "{indenter:?}: {in_contact}");
        assert!(smallest > -1e-3, "{indenter:?}: {smallest}");
        let heights = indenter.surface(grid).unwrap();
        let range = heights.heights().iter().fold(0.0_f64, |m, h| m.max(heights.heights()[2048] - h));
        let expected = exact.mean_gap.unwrap() / range;
        assert!((mean - expected).abs() < 1e-3, "{indenter:?}: {mean} against {expected}");
        assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-3, "{indenter:?}");
    }
}

#[test]
fn isolated_solutions_close_the_gap_in_contact() {
    let cases = [
        (Indenter::Sphere { radius: 1.0 }, 0.002),
        (Indenter::Cone { slope: 0.2 }, 0.004),
        (Indenter::PowerLaw { coefficient: 1.0, exponent: 3.0 }, 0.0005),
        (Indenter::Punch { half_width: 0.1, depth: 1.0 }, 0.01),
    ];
    for (indenter, mean_pressure) in cases {
        let grid = Grid::surface([512, 512], [1.0, 1.0]).unwrap();
        let exact = Exact::new(&indenter, &grid, MODULUS, mean_pressure).unwrap();
        let [in_contact, smallest, _] = gaps(&indenter, grid, &exact);
        assert!(in_contact < 3e-3, "{indenter:?}: {in_contact}");
        assert!(smallest > -3e-3, "{indenter:?}: {smallest}");
        assert!((exact.pressure.mean().unwrap() / mean_pressure - 1.0).abs() < 2e-2, "{indenter:?}");
    }
}

#[test]
fn the_sphere_is_hertz() {
    let grid = Grid::surface([64, 64], [1.0, 1.0]).unwrap();
    let exact = Exact::new(&Indenter::Sphere { radius: 1.0 }, &grid, 1.0, 0.001).unwrap();
    let contact = hertz::sphere(1.0, 1.0);
    let a = contact.half_width(0.001);
    assert!((exact.relative_area - PI * a * a).abs() < 1e-15);
    assert_eq!(exact.max_pressure, Some(exact.pressure[[32, 32]]));
    assert!((exact.kappa_r.unwrap() - hertz::KAPPA_R_POINT).abs() < 1e-14);
}

#[test]
fn full_contact_of_the_crossed_sine() {
    let (grid, indenter) = (Grid::surface([16, 24], [1.0, 2.0]).unwrap(), Indenter::CrossedSine { amplitude: 0.1 });
    let full = crossed_full_pressure(0.1, [1.0, 2.0], MODULUS);
    assert_eq!(Exact::new(&indenter, &grid, MODULUS, 0.99 * full), None);
    let exact = Exact::new(&indenter, &grid, MODULUS, 1.5 * full).unwrap();
    assert!(gaps(&indenter, grid, &exact)[0] < 1e-14);
    assert!((exact.pressure[[8, 12]] - exact.max_pressure.unwrap()).abs() < 1e-14);
}

#[test]
fn there_is_none_where_nothing_is_known() {
    let (line, surface) = (Grid::line(64, 1.0).unwrap(), Grid::surface([16, 16], [1.0, 1.0]).unwrap());
    let none = |indenter, grid, p| assert_eq!(Exact::new(&indenter, &grid, 1.0, p), None, "{indenter:?} at {p}");
    none(Indenter::Sphere { radius: 1.0 }, surface, 10.0);
    none(Indenter::Sphere { radius: 1.0 }, line, 0.1);
    none(Indenter::Cylinder { radius: -1.0 }, line, 0.1);
    none(Indenter::Cylinder { radius: 1.0 }, line, 1e6);
    none(Indenter::PowerLaw { coefficient: 1.0, exponent: 0.5 }, line, 0.1);
    none(Indenter::PowerLaw { coefficient: 1.0, exponent: 1e300 }, surface, 0.1);
    none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, line, 1.0);
    none(Indenter::Punch { half_width: 0.2, depth: 0.1 }, surface, 1.0);
    for pressure in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        none(Indenter::Sine { amplitude: 1.0 }, line, pressure);
    }
}

/// A paraboloid of two radii that stands alone: the solver finds the ellipse, its pressure and its approach. The heights and the solver know nothing of elliptic
/// integrals.
#[test]
fn a_paraboloid_of_two_radii_has_an_elliptic_contact() {
    let grid = Grid::surface([192, 192], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    for radii in [[1.0, 0.35], [0.25, 2.0], [0.6, 0.6]] {
        let indenter = Indenter::EllipticParaboloid { radius_x: radii[0], radius_y: radii[1] };
        let theory = EllipticHertz::new(radii, MODULUS);
        let load = 1.6e-2;
        let problem =
            Problem::new(indenter.surface(grid).unwrap(), ContactModulus(MODULUS), Load::MeanPressure(load)).unwrap();
        let stop = Stop::new(1e-9, 10_000).unwrap();
        let contact = Multilevel.solve(&problem, &stop, &mut ()).unwrap().converged().unwrap();
        let near = |found: f64, expected: f64, tolerance: f64, what: &str| {
            assert!((found / expected - 1.0).abs() < tolerance, "{radii:?}: {what} {found} for {expected}");
        };
        let [ax, ay] = theory.semi_axes(load);
        near(contact.resolved().relative_area, PI * ax * ay, 4e-3, "area");
        near(
            contact.pressure.iter().fold(0.0, |a: f64, p| a.max(*p)),
            theory.max_pressure(load),
            4e-3,
            "largest pressure",
        );
        near(contact.resolved().kappa_r, theory.kappa_r(load), 1e-2, "kappa_r");
        // the peak is at height 0, above the mean, and remote points of a free surface are where the displacement is zero
        let middle = [96, 96];
        near(contact.displacement[middle], theory.approach(load), 4e-3, "approach");
        let touching = |axis: usize| {
            let at = |i: usize| if axis == 1 { contact.pressure[[96, i]] } else { contact.pressure[[i, 96]] };
            (0..192).filter(|i| at(*i) > 0.0).count() as f64 / 192.0
        };
        near(touching(1), 2.0 * ax, 0.06, "axis along x");
        near(touching(0), 2.0 * ay, 0.06, "axis along y");
    }
    let alone = |mean_pressure: f64| {
        Exact::new(&Indenter::EllipticParaboloid { radius_x: 1.0, radius_y: 0.35 }, &grid, MODULUS, mean_pressure)
    };
    assert!((alone(1.6e-2).unwrap().pressure.mean().unwrap() / 1.6e-2 - 1.0).abs() < 2e-3);
    assert!(alone(10.0).is_none(), "it does not fit the cell");
}

/// A pyramid is similar to itself at all loads, so that the area is in proportion to the load. The load is that of Bilodeau's approximation, which is an upper
/// bound within some percent: `0.7453` for the `2/pi` of the cone (J. Appl. Mech. 59:519, 1992).
#[test]
fn a_pyramid_has_a_contact_in_proportion_to_its_load() {
    let grid = Grid::surface([256, 256], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let slope = 0.2;
    let surface = Indenter::Pyramid { slope }.surface(grid).unwrap();
    let solve = |load: f64| {
        let problem = Problem::new(surface.clone(), ContactModulus(MODULUS), Load::MeanPressure(load)).unwrap();
        Multilevel.solve(&problem, &Stop::new(1e-8, 10_000).unwrap(), &mut ()).unwrap().converged().unwrap()
    };
    let [small, large] = [2e-2, 4e-2].map(solve);
    let area = large.resolved().relative_area / small.resolved().relative_area;
    assert!((area / 2.0 - 1.0).abs() < 0.02, "{area}");
    let approach = large.displacement[[128, 128]];
    let bound = 0.7453 * MODULUS * approach * approach / slope;
    assert!((0.94..1.01).contains(&(4e-2 / bound)), "{} for {bound}", 4e-2);
}
