//! What a certificate bounds: held against solutions, and against states that it must tell from them.

use asperity::contact::{Certificate, Contact, ContactModulus, Each, Load, Multilevel, PolonskyKeer, Solver, Step};
use asperity::elastic::{Base, Layer};
use asperity::surface::Spectrum;
use asperity::{Grid, Indenter, Problem, Stop, Surface};
use std::ops::ControlFlow;

fn sine(points: usize) -> Surface {
    Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(points, 1.0).unwrap()).unwrap()
}

fn rough(grid: Grid) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 1.0 / 16.0, rms_gradient: 0.1 };
    Surface::rough(grid, &spectrum, 3).unwrap()
}

/// Lines and surfaces under a light load, a medium one, and one that closes the gap.
fn pressed() -> impl Iterator<Item = Problem> {
    let surfaces = [sine(256), rough(Grid::line(251, 1.0).unwrap()), rough(Grid::surface([48, 48], [1.0; 2]).unwrap())];
    let under = |surface: &Surface, load| {
        Problem::new(surface.clone(), ContactModulus(2.0), Load::ReducedPressure(load)).unwrap()
    };
    surfaces.into_iter().flat_map(move |surface| [1e-3, 0.1, 1.0].map(|load| under(&surface, load)))
}

fn solved(problem: &Problem) -> Contact {
    Multilevel.solve(problem, &Stop::new(1e-13, 10_000).unwrap(), &mut ()).unwrap().converged().unwrap()
}

/// The states on the way to the solution of a problem, each with its certificate.
fn states(problem: &Problem) -> Vec<(Vec<f64>, Certificate)> {
    let mut states = Vec::new();
    let mut watch = Each(|step: &Step<'_>| {
        states.push((step.pressure().to_vec(), *step.certificate().unwrap()));
        ControlFlow::Continue(())
    });
    PolonskyKeer.solve(problem, &Stop::new(1e-10, 10_000).unwrap(), &mut watch).unwrap();
    states
}

/// `<p u(p)>`.
fn square(problem: &Problem, pressure: &[f64]) -> f64 {
    let mut u = vec![0.0; pressure.len()];
    problem.response().displacement(pressure, &mut u);
    pressure.iter().zip(u).map(|(p, u)| p * u).sum::<f64>() / pressure.len() as f64
}

fn energy(problem: &Problem, pressure: &[f64]) -> f64 {
    let lift: f64 = pressure.iter().zip(problem.height()).map(|(p, h)| p * h).sum();
    0.5 * square(problem, pressure) - lift / pressure.len() as f64
}

#[test]
fn energy_pressure_and_mean_gap_are_bounded_all_the_way() {
    for problem in pressed() {
        let solution = solved(&problem);
        let exact: Vec<f64> = solution.pressure.iter().copied().collect();
        let (least, unit) = (energy(&problem, &exact), solution.mean_pressure() * problem.rms_height());
        for (pressure, certificate) in states(&problem) {
            let above = (energy(&problem, &pressure) - least) / unit;
            assert!(above <= certificate.eta + 1e-13, "{above} {certificate:?}");
            let wrong: Vec<f64> = pressure.iter().zip(&exact).map(|(p, q)| p - q).collect();
            let error = (square(&problem, &wrong).max(0.0) / square(&problem, &pressure).max(0.0)).sqrt();
            assert!(error.is_nan() || error <= certificate.pressure_error_bound + 1e-6, "{error} {certificate:?}");
            let gap = mean_gap(&problem, &pressure);
            let missed = (gap - solution.mean_gap()).abs() / problem.rms_height();
            assert!(missed <= certificate.mean_gap_error_bound + 1e-9, "{missed} {certificate:?}");
        }
    }
}

/// The mean gap of a pressure, at which `<p g> = 0`.
fn mean_gap(problem: &Problem, pressure: &[f64]) -> f64 {
    let mut u = vec![0.0; pressure.len()];
    problem.response().displacement(pressure, &mut u);
    let load: f64 = pressure.iter().sum();
    (0..u.len()).map(|i| pressure[i] * (problem.height()[i] - u[i])).sum::<f64>() / load
}

/// At a given approach the mean gap is part of the solution, and its bound holds on the way to it.
#[test]
fn the_mean_gap_at_an_approach_is_bounded_all_the_way() {
    let line = Grid::line(128, 1.0).unwrap();
    let layer = |base| Layer { contact_modulus: 1.0, poisson: 0.3, thickness: 0.3, base };
    let square = Grid::surface([24, 24], [1.0; 2]).unwrap().with_periodic([false; 2]);
    let ball = Indenter::Sphere { radius: 1.0 }.surface(square).unwrap();
    let on = |surface: Surface, base| Problem::new(surface, layer(base), Load::Approach(0.02)).unwrap();
    let mut far = 0;
    for problem in [
        on(rough(line), Base::Bonded),
        on(rough(line), Base::Sliding),
        on(rough(Grid::surface([36, 40], [1.0; 2]).unwrap()), Base::Bonded),
        Problem::new(ball, ContactModulus(1.0), Load::Approach(0.03)).unwrap(),
    ] {
        let solution = Multilevel.solve(&problem, &Stop::new(1e-12, 10_000).unwrap(), &mut ()).unwrap();
        let exact = solution.converged().unwrap();
        for (pressure, certificate) in states(&problem) {
            let mut u = vec![0.0; pressure.len()];
            problem.response().displacement(&pressure, &mut u);
            let Some(datum) = problem.datum() else { continue };
            let height = problem.height();
            let gap = (0..u.len()).map(|i| u[i] - height[i] + datum).sum::<f64>() / u.len() as f64;
            let missed = (gap - exact.mean_gap()).abs() / problem.rms_height();
            assert!(missed <= certificate.mean_gap_error_bound + 1e-9, "{missed} {certificate:?}");
            far += usize::from(missed > 1e-3);
        }
        assert!(exact.certificate.mean_gap_error_bound < 1e-4);
    }
    assert!(far > 5, "{far} states were off");
}

/// At the solution the bounds close in on it: no slack that grows as the errors fall.
#[test]
fn bounds_vanish_at_the_solution() {
    for problem in pressed() {
        let Certificate { pressure_error_bound, mean_gap_error_bound, .. } = solved(&problem).certificate;
        assert!(pressure_error_bound < 2e-5 && mean_gap_error_bound < 2e-5, "{pressure_error_bound}");
    }
}

/// The bound of the pressure is the root of the duality gap over `<p u>`, not twice that gap.
#[test]
fn the_pressure_is_bounded_by_the_duality_gap_itself() {
    for problem in pressed() {
        let is_bounded = |it: &Certificate| it.eta > 1e-9 && it.pressure_error_bound.is_finite();
        for (pressure, certificate) in states(&problem).iter().filter(|(_, certificate)| is_bounded(certificate)) {
            let gap = certificate.eta * problem.rms_height() * pressure.iter().sum::<f64>() / pressure.len() as f64;
            let expected = (gap / square(&problem, pressure)).sqrt();
            assert!((certificate.pressure_error_bound / expected - 1.0).abs() < 1e-5, "{expected} {certificate:?}");
        }
    }
}

/// What rounding adds leaves the goals of ordinary scenes attainable, and never falls to nothing.
#[test]
fn rounding_is_in_the_bounds_and_small() {
    for problem in pressed() {
        let exact: Vec<f64> = solved(&problem).pressure.iter().copied().collect();
        let flattened = Certificate::from_displacement(&problem, &exact, problem.height());
        // a displacement that is the heights leaves no gap at all: what is left is rounding
        assert!(flattened.eta > 0.0 && flattened.eta < 1e-17, "{}", flattened.eta);
        let apart = problem.clone().with_load(Load::MeanGap(1e-3 * problem.rms_height())).unwrap();
        let mut lowered: Vec<f64> = problem.height().to_vec();
        lowered.iter_mut().for_each(|u| *u -= 1e-3 * problem.rms_height());
        let flattened = Certificate::from_displacement(&apart, &exact, &lowered);
        assert!(flattened.eta > 1e-16 && flattened.eta < 1e-13, "{}", flattened.eta);
    }
}

/// Close to closure and to first touch, a hundredfold load is all but free: the error in energy does not tell it from the
/// solution, the one over what is left of the gap does.
#[test]
fn a_hundredfold_load_is_told_from_the_solution_at_both_ends_of_the_gap() {
    let tolerance = Stop::default();
    for problem in pressed().filter(|problem| problem.load() == Load::ReducedPressure(0.1)) {
        let closed = problem.clone().with_load(Load::MeanGap(1e-9 * problem.rms_height())).unwrap();
        let touching = problem.clone().with_load(Load::MeanGap(problem.highest() * (1.0 - 1e-9))).unwrap();
        for apart in [closed, touching] {
            for solver in [&Multilevel as &dyn Solver, &PolonskyKeer] {
                let contact = solver.solve(&apart, &tolerance, &mut ()).unwrap().converged().unwrap();
                let heights = problem.height();
                let mut pull = vec![0.0; heights.len()];
                problem.response().pressure(heights, &mut pull);
                // near closure that of full contact and a uniform pressure, near touch the solution a hundred times
                let load = 100.0 * contact.mean_pressure();
                let garbage: Vec<f64> = match apart.mean_gap() {
                    Some(gap) if gap < problem.rms_height() => pull.iter().map(|p| p + load).collect(),
                    _ => contact.pressure.iter().map(|p| 100.0 * p).collect(),
                };
                let told = Certificate::new(&apart, &garbage);
                assert!(told.eta < 1e-6, "energy alone does tell it: {told:?}");
                assert!(told.eta_gap > 0.5 && !tolerance.is_met(&told), "{told:?}");
                assert!(contact.certificate.eta_gap <= tolerance.gap_tolerance(), "{:?}", contact.certificate);
            }
        }
    }
}

#[test]
fn nothing_is_bounded_without_a_feasible_pressure() {
    let pressed = Problem::new(sine(16), ContactModulus(1.0), Load::MeanPressure(0.5)).unwrap();
    let apart = pressed.clone().with_load(Load::MeanGap(0.5)).unwrap();
    let with = |value: f64| [[1.0; 15].as_slice(), &[value]].concat();
    let bounds = |it: Certificate| [it.eta, it.eta_gap, it.pressure_error_bound, it.mean_gap_error_bound];
    for problem in [pressed, apart] {
        let nothing = Certificate::new(&problem, &[0.0; 16]);
        assert_eq!(bounds(nothing), [f64::INFINITY; 4]);
        assert_eq!([nothing.load_error, nothing.penetration], [f64::INFINITY; 2]);
        assert_eq!(nothing.min_pressure, 0.0);
        for value in [f64::NAN, f64::INFINITY, -1e-3, -100.0] {
            assert_eq!(bounds(Certificate::new(&problem, &with(value))), [f64::INFINITY; 4], "{value}");
        }
        let displaced = Certificate::from_displacement(&problem, &with(1.0), &[f64::NAN; 16]);
        assert_eq!(bounds(displaced), [f64::INFINITY; 4]);
        assert!(Certificate::new(&problem, &with(1.0)).eta.is_finite());
    }
}

#[test]
fn penetration_is_that_of_the_deepest_node() {
    let pressed = Problem::new(sine(16), ContactModulus(1.0), Load::MeanPressure(1.0)).unwrap();
    // under a uniform pressure nothing is displaced: the highest peak lies its height below the mean plane, less the gap
    let found = Certificate::new(&pressed, &[1.0; 16]);
    assert!((found.penetration - found.eta).abs() < 1e-13 && (found.eta - 2f64.sqrt()).abs() < 1e-12);
    assert_eq!(found.pressure_error_bound, f64::INFINITY);
    let apart = pressed.with_load(Load::MeanGap(0.25)).unwrap();
    let found = Certificate::new(&apart, &[1.0; 16]);
    assert!((found.penetration - 0.75 * 2f64.sqrt()).abs() < 1e-12 && found.eta > found.penetration);
}

/// A uniform pressure of any size deforms nothing except for rounding, and bounds nothing.
#[test]
fn a_pressure_that_deforms_nothing_bounds_no_pressure() {
    for points in [16, 255, 1021] {
        for load in [1e-6, 0.7, 1e9] {
            let problem = Problem::new(sine(points), ContactModulus(1.0), Load::MeanPressure(load)).unwrap();
            let found = Certificate::new(&problem, &vec![load; points]);
            assert_eq!(found.pressure_error_bound, f64::INFINITY, "{points} {load}");
        }
    }
}
