//! A contact at a given mean gap is the contact under the mean pressure that makes this gap.

use crate::common::{relative_l2, solve};
use asperity::contact::{
    Contact, ContactModulus, Each, Gfmd, Load, Multilevel, Observables, PolonskyKeer, Problem, Solver, Step, Stop,
};
use asperity::error::{ProblemError, SolveError};
use asperity::surface::{Field, Spectrum};
use asperity::{Grid, Indenter, Surface};
use std::ops::ControlFlow;

/// The solvers that work at a mean gap.
fn solvers() -> Vec<Box<dyn Solver>> {
    vec![Box::new(PolonskyKeer), Box::new(Multilevel)]
}

const TOLERANCE: f64 = 1e-12;

fn rough(grid: Grid) -> Surface {
    let rolloff_wavelength = grid.longest_wavelength() / 2.0;
    let short_cutoff = (rolloff_wavelength / 16.0).max(1.5 * grid.shortest_wavelength());
    Surface::rough(grid, &Spectrum { hurst: 0.8, rolloff_wavelength, short_cutoff, rms_gradient: 0.1 }, 5).unwrap()
}

/// Smooth and rough surfaces on even, odd, prime and rectangular grids.
fn surfaces() -> Vec<Surface> {
    let line = |points| Grid::line(points, 2.0).unwrap();
    let surface = |shape| Grid::surface(shape, [2.0, 3.0]).unwrap();
    vec![
        Indenter::Cylinder { radius: 1.0 }.surface(line(512)).unwrap(),
        Indenter::Sine { amplitude: 0.1 }.surface(line(256)).unwrap(),
        Indenter::Sphere { radius: 1.0 }.surface(surface([48, 64])).unwrap(),
        rough(line(1 << 12)),
        rough(line(251)),
        rough(surface([128, 128])),
        rough(surface([61, 90])),
    ]
}

/// Light, medium and nearly full contact: at a reduced pressure of 0.7 the sine touches everywhere.
fn pressed() -> impl Iterator<Item = Problem> {
    let under = |surface: &Surface, load| {
        Problem::new(surface.clone(), ContactModulus(3.0), Load::ReducedPressure(load)).unwrap()
    };
    surfaces().into_iter().flat_map(move |surface| [0.01, 0.2, 0.6].map(|load| under(&surface, load)))
}

/// Nodes that are in contact in one of both only.
fn exchanged(a: &Contact, b: &Contact) -> usize {
    a.mask().iter().zip(b.mask()).filter(|(a, b)| *a != b).count()
}

#[test]
fn the_mean_gap_of_a_pressure_gives_this_pressure() {
    for solver in solvers() {
        for problem in pressed() {
            let expected = solve(solver.as_ref(), &problem, TOLERANCE);
            let gap = expected.mean_gap();
            let found = solve(solver.as_ref(), &problem.clone().with_load(Load::MeanGap(gap)).unwrap(), TOLERANCE);
            let what = format!("{} on {:?} at {gap}", solver.name(), problem.surface().grid());
            assert!(
                (found.mean_pressure() / expected.mean_pressure() - 1.0).abs() < 1e-8,
                "{what}: {}",
                found.mean_pressure() / expected.mean_pressure()
            );
            let difference = relative_l2(&found.pressure, &expected.pressure);
            assert!(difference < 1e-8, "{what}: {difference}");
            assert!(exchanged(&found, &expected) <= 1, "{what}: {}", exchanged(&found, &expected));
            assert!((found.mean_gap() / gap - 1.0).abs() < 1e-9, "{what}: {}", found.mean_gap());
            assert!(found.certificate.eta <= TOLERANCE && found.certificate.load_error <= TOLERANCE, "{what}");
            assert!(found.certificate.min_pressure >= 0.0);
        }
    }
}

#[test]
fn the_mean_pressure_of_a_gap_gives_this_gap() {
    for solver in solvers() {
        for surface in surfaces() {
            let highest = surface.heights().iter().fold(0.0, |most: f64, &h| most.max(h));
            for share in [0.05, 0.5, 0.95] {
                let apart = Problem::new(surface.clone(), ContactModulus(3.0), Load::MeanGap(share * highest)).unwrap();
                let expected = solve(solver.as_ref(), &apart, TOLERANCE);
                let problem = apart.with_load(Load::MeanPressure(expected.mean_pressure())).unwrap();
                let found = solve(solver.as_ref(), &problem, TOLERANCE);
                let what = format!("{} on {:?} at {share}", solver.name(), surface.grid());
                assert!((found.mean_gap() / (share * highest) - 1.0).abs() < 1e-9, "{what}: {}", found.mean_gap());
                let difference = relative_l2(&found.pressure, &expected.pressure);
                assert!(difference < 1e-7, "{what}: {difference}");
            }
        }
    }
}

#[test]
fn the_further_apart_the_less_pressure_and_area() {
    for solver in solvers() {
        for surface in surfaces() {
            let highest = surface.heights().iter().fold(0.0, |most: f64, &h| most.max(h));
            let at = |share: f64| {
                let problem =
                    Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanGap(share * highest)).unwrap();
                let contact = solve(solver.as_ref(), &problem, 1e-9);
                (contact.mean_pressure(), contact.counted().relative_area)
            };
            let found: Vec<_> = [0.01, 0.1, 0.3, 0.6, 0.9, 0.999].map(at).into();
            for pair in found.windows(2) {
                assert!(pair[1].0 < pair[0].0 && pair[1].1 <= pair[0].1, "{:?}: {found:?}", surface.grid());
            }
        }
    }
}

#[test]
fn lengths_scale_the_gap_and_moduli_the_pressure() {
    let at = |[length, modulus]: [f64; 2]| {
        let grid = Grid::line(512, 2.0 * length).unwrap();
        Problem::new(
            Indenter::Cylinder { radius: length }.surface(grid).unwrap(),
            ContactModulus(modulus),
            Load::MeanGap(0.05 * length),
        )
        .unwrap()
    };
    for solver in solvers() {
        let expected = solve(solver.as_ref(), &at([1.0, 1.0]), TOLERANCE);
        for units in [[2f64.powi(40), 2f64.powi(-40)], [2f64.powi(-100), 2f64.powi(100)]] {
            let found = solve(solver.as_ref(), &at(units), TOLERANCE);
            assert_eq!(found.pressure, &expected.pressure * units[1], "{units:?}");
            assert_eq!(found.gap, &expected.gap * units[0], "{units:?}");
            assert_eq!(found.certificate, expected.certificate, "{units:?}");
        }
        for units in [[1e-6, 1e9], [1e10, 1e-10]] {
            let found = solve(solver.as_ref(), &at(units), TOLERANCE);
            assert!(relative_l2(&(&found.pressure / units[1]), &expected.pressure) < 1e-9, "{units:?}");
        }
    }
}

/// From any start: that of another gap, a pressure that all lifts off, and one far too low.
#[test]
fn the_start_does_not_matter() {
    for solver in solvers() {
        for surface in surfaces() {
            let highest = surface.heights().iter().fold(0.0, |most: f64, &h| most.max(h));
            let problem = Problem::new(surface.clone(), ContactModulus(1.0), Load::MeanGap(0.6 * highest)).unwrap();
            let expected = solve(solver.as_ref(), &problem, TOLERANCE);
            let mut lone = expected.pressure.mapv(|_| 0.0);
            lone[[0, 0]] = 1e-6;
            for start in [expected.pressure.mapv(|p| 1e3 * p), expected.pressure.mapv(|_| 1e-9), lone] {
                let stop = Stop::new(TOLERANCE, 100_000).unwrap();
                let found = solver.solve_from(Some(&start), &problem, &stop, &mut ()).unwrap().converged().unwrap();
                let difference = relative_l2(&found.pressure, &expected.pressure);
                assert!(difference < 1e-7, "{} on {:?}: {difference}", solver.name(), surface.grid());
            }
        }
    }
}

/// The energy falls to its minimum, and the certificate bounds what is left of it.
#[test]
fn the_certificate_bounds_the_energy() {
    for solver in solvers() {
        for surface in [rough(Grid::line(512, 2.0).unwrap()), rough(Grid::surface([48, 48], [2.0, 2.0]).unwrap())] {
            let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanGap(0.01)).unwrap();
            let mut steps = Vec::new();
            let mut watch = Each(|step: &Step<'_>| {
                let pressure = step.pressure().iter().sum::<f64>() / step.pressure().len() as f64;
                if let (Some(eta), 0) = (step.certificate().map(|it| it.eta), step.phase().level) {
                    steps.push((step.energy().value(), eta, pressure / problem.expected_mean_pressure()));
                }
                ControlFlow::Continue(())
            });
            let stop = Stop::new(TOLERANCE, 100_000).unwrap();
            solver.solve(&problem, &stop, &mut watch).unwrap().converged().unwrap();
            let (least, _, load) = *steps.last().unwrap();
            for &(energy, eta, pressure) in &steps {
                assert!(energy - least >= -1e-11 * least.abs(), "{energy} below {least}");
                assert!(energy - least <= eta * pressure.max(load) + 1e-11 * least.abs(), "{energy} {least} {eta}");
            }
            assert!(steps[0].1 > 1e6 * TOLERANCE, "the first certified state is no solution: {}", steps[0].1);
        }
    }
}

/// The solution at another gap touches as it should but misses the gap: by that alone its certificate tells it apart.
#[test]
fn the_certificate_tells_how_far_the_gap_is_missed() {
    for solver in solvers() {
        for surface in surfaces() {
            let problem = Problem::new(surface, ContactModulus(3.0), Load::ReducedPressure(0.1)).unwrap();
            let pressed = solve(solver.as_ref(), &problem, TOLERANCE);
            let missed = 0.1 * pressed.mean_gap();
            let apart = problem.with_load(Load::MeanGap(pressed.mean_gap() + missed)).unwrap();
            let mut at_once = Each(|_: &Step<'_>| ControlFlow::Break(()));
            let start = solver.solve_from(Some(&pressed.pressure), &apart, &Stop::default(), &mut at_once).unwrap();
            let expected = missed / apart.rms_height();
            for found in [start.certificate.eta, start.certificate.load_error] {
                assert!((found / expected - 1.0).abs() < 1e-9, "{:?}: {found}", apart.surface().grid());
            }
        }
    }
}

/// Heights may keep a mean of rounding, up to 1e-12 of the largest. Where hardly more than that is left of the gap, the load must not depend
/// on it by more than the certificate says.
#[test]
fn heights_that_keep_a_mean_of_rounding_are_pressed_alike() {
    let heights = |mean: f64| {
        let wave = |(_, x): (usize, usize)| (2.0 * std::f64::consts::PI * x as f64 / 256.0).cos() + mean;
        Surface::new(Grid::line(256, 1.0).unwrap(), Field::from_shape_fn((1, 256), wave)).unwrap()
    };
    for solver in solvers() {
        let pressed = |mean: f64| {
            let problem = Problem::new(heights(mean), ContactModulus(1.0), Load::MeanGap(1.0 - 1e-10)).unwrap();
            // a gap that is known to the rounding of the heights has no better load
            solve(solver.as_ref(), &problem, 1e-7)
        };
        let centred = pressed(0.0);
        for mean in [8e-13, -8e-13] {
            let found = pressed(mean);
            let apart = (found.mean_pressure() / centred.mean_pressure() - 1.0).abs();
            let bound = found.certificate.eta_gap + centred.certificate.eta_gap;
            assert!(apart < bound && bound < 1e-3, "{} at {mean}: {apart} above {bound}", solver.name());
            assert!((found.mean_gap() - (1.0 - 1e-10)).abs() < 1e-15, "{}", found.mean_gap());
        }
    }
}

#[test]
fn gaps_with_nothing_to_solve_are_refused() {
    let sine = || Indenter::Sine { amplitude: 0.5 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let refusal = |gap| Problem::new(sine(), ContactModulus(1.0), Load::MeanGap(gap)).unwrap_err();
    for gap in [0.51, 3.0] {
        assert!(matches!(refusal(gap), ProblemError::NothingTouches { mean_gap, highest }
            if mean_gap == gap && (highest - 0.5).abs() < 1e-12));
    }
    for gap in [0.0, -0.1] {
        assert!(matches!(refusal(gap), ProblemError::EverythingTouches { mean_gap, .. } if mean_gap == gap));
    }
    for gap in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(refusal(gap), ProblemError::NotPositive { name: "mean gap", .. }));
    }
    assert!(Problem::new(sine(), ContactModulus(1.0), Load::MeanGap(0.499)).is_ok());
}

#[test]
fn gfmd_says_that_it_needs_a_pressure() {
    let sine = Indenter::Sine { amplitude: 0.5 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let problem = Problem::new(sine, ContactModulus(1.0), Load::MeanGap(0.1)).unwrap();
    let refused = Gfmd::default().solve(&problem, &Stop::default(), &mut ()).unwrap_err();
    assert!(matches!(refused, SolveError::NeedsPressure { solver } if solver == "gfmd"));
}

/// Contact stiffness of a sine in closed form: `k = pi E* / (2 L ln(1 / sin psi))` from Westergaard's load and mean gap at half
/// the width `psi`.
#[test]
fn the_stiffness_of_a_sine_is_that_of_its_closed_form() {
    for points in [256, 1024, 4096] {
        let sine = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(points, 2.0).unwrap()).unwrap();
        for psi in [0.2_f64, 0.6, 1.2] {
            let full = 3.0 * std::f64::consts::PI * 0.01 / 2.0;
            let load = Load::MeanPressure(full * psi.sin().powi(2));
            let contact = solve(&Multilevel, &Problem::new(sine.clone(), ContactModulus(3.0), load).unwrap(), 1e-12);
            let log = (1.0 / psi.sin()).ln();
            let error = contact.stiffness() / (3.0 * std::f64::consts::PI / (4.0 * log)) - 1.0;
            // the set of nodes ends within a spacing of the edge
            let per_spacing = std::f64::consts::PI / points as f64 / psi.tan() / log;
            assert!(error.abs() < per_spacing, "{error} of {per_spacing} for {psi} on {points}");
        }
    }
}

/// The elastic energy `U` is what the load does on the way: `<p> = -dU/dD`, and the stiffness is `-d<p>/dD`.
#[test]
fn pressure_and_stiffness_are_the_derivatives_of_the_energy() {
    for problem in pressed().filter(|problem| problem.load() != Load::ReducedPressure(0.6)) {
        let gap = solve(&Multilevel, &problem, TOLERANCE).mean_gap();
        let step = 1e-3 * gap;
        let [wide, middle, close] = [gap + step, gap, gap - step].map(|gap| {
            let apart = problem.clone().with_load(Load::MeanGap(gap)).unwrap();
            solve(&Multilevel, &apart, TOLERANCE)
        });
        let energy = |it: &Contact| (&it.pressure * &it.displacement).mean().unwrap() / 2.0;
        let pressure = (energy(&close) - energy(&wide)) / (2.0 * step);
        let what = format!("{:?} under {:?}", problem.surface().grid(), problem.load());
        assert!((pressure / middle.mean_pressure() - 1.0).abs() < 1e-4, "{what}: {pressure}");
        let stiffness = (close.mean_pressure() - wide.mean_pressure()) / (2.0 * step);
        let error = middle.stiffness() / stiffness - 1.0;
        assert!(error.abs() < 1e-2, "{what}: {error}");
    }
}

/// The forward error of the load, by the stiffness, is that of a state on the way, within a factor of order one.
#[test]
fn the_error_of_the_load_is_foretold() {
    for surface in surfaces() {
        for share in [1e-4, 0.3, 0.999] {
            let gap = share * surface.heights().iter().fold(0.0, |most: f64, &h| most.max(h));
            let problem = Problem::new(surface.clone(), ContactModulus(3.0), Load::MeanGap(gap)).unwrap();
            let exact = solve(&Multilevel, &problem, 1e-12).mean_pressure();
            let rough = Multilevel.solve(&problem, &Stop::new(1e-5, 1000).unwrap(), &mut ()).unwrap();
            rough.stiffness();
            let told = Observables::new(&rough).mean_pressure_error;
            let error = (rough.mean_pressure() / exact - 1.0).abs();
            assert!(error <= 3.0 * told + 1e-9, "{:?} at {share}: {error} {told}", surface.grid());
        }
    }
}
