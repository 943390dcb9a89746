//! Results are dimensionless: units of length and pressure, and the zero of heights, do not matter.

use asperity::contact::{ContactModulus, Counted, Dynamics, Gfmd, Load, Masses, PolonskyKeer, Solver};
use asperity::surface::Spectrum;
use asperity::{Contact, Grid, Indenter, Problem, Stop, Surface};

/// Units of length and pressure: small and large, alone and together.
const DECIMAL: [[f64; 2]; 8] =
    [[1e-10, 1.0], [1e10, 1.0], [1.0, 1e-10], [1.0, 1e10], [1e-10, 1e10], [1e10, 1e-10], [1e-6, 1e9], [1e10, 1e10]];

/// Units that only change exponents of numbers, far beyond any use, so that nothing at all is rounded anew.
const BINARY: [[i32; 2]; 4] = [[-33, 33], [33, -33], [100, 100], [-100, -100]];

/// A contact: surface and pressure over modulus, in any unit of length.
struct Case {
    name: &'static str,
    surface: fn(f64) -> Surface,
    strain: f64,
}

const CASES: [Case; 5] = [
    Case { name: "cylinder", surface: cylinder, strain: 0.02 },
    Case { name: "sphere", surface: sphere, strain: 0.01 },
    Case { name: "power law", surface: power_law, strain: 0.01 },
    Case { name: "rough line", surface: rough_line, strain: 0.008 },
    Case { name: "rough surface", surface: rough_surface, strain: 0.008 },
];

fn cylinder(unit: f64) -> Surface {
    Indenter::Cylinder { radius: unit }.surface(Grid::line(128, 4.0 * unit).unwrap()).unwrap()
}

fn sphere(unit: f64) -> Surface {
    let grid = Grid::surface([32, 24], [4.0 * unit, 3.0 * unit]).unwrap();
    Indenter::Sphere { radius: unit }.surface(grid).unwrap()
}

/// A height of one unit of length at a distance of one.
fn power_law(unit: f64) -> Surface {
    let indenter = Indenter::PowerLaw { coefficient: 1.0 / (unit * unit), exponent: 3.0 };
    indenter.surface(Grid::line(100, 2.0 * unit).unwrap()).unwrap()
}

fn spectrum(unit: f64) -> Spectrum {
    Spectrum { hurst: 0.8, rolloff_wavelength: 0.5 * unit, short_cutoff: 0.1 * unit, rms_gradient: 0.1 }
}

fn rough_line(unit: f64) -> Surface {
    Surface::rough(Grid::line(256, unit).unwrap(), &spectrum(unit), 5).unwrap()
}

fn rough_surface(unit: f64) -> Surface {
    Surface::rough(Grid::surface([40, 48], [unit, 1.2 * unit]).unwrap(), &spectrum(unit), 5).unwrap()
}

impl Case {
    fn problem(&self, [length, modulus]: [f64; 2]) -> Problem {
        Problem::new((self.surface)(length), ContactModulus(modulus), Load::MeanPressure(self.strain * modulus))
            .unwrap()
    }
}

fn solvers() -> [Box<dyn Solver>; 3] {
    let fire = Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, ..Gfmd::default() };
    [Box::new(PolonskyKeer), Box::new(Gfmd::default()), Box::new(fire)]
}

/// So far converged that iterations which differ by rounding end at the same place.
fn solve(solver: &dyn Solver, problem: &Problem) -> (Contact, Counted) {
    let contact = solver.solve(problem, &Stop::new(1e-12, 50_000).unwrap(), &mut ()).unwrap().converged().unwrap();
    let measures = contact.counted();
    (contact, measures)
}

/// Largest difference of two fields in their units, over the largest value.
fn difference(a: &ndarray::Array2<f64>, unit_a: f64, b: &ndarray::Array2<f64>, unit_b: f64) -> f64 {
    let largest = b.iter().fold(0.0, |m: f64, v| m.max((v / unit_b).abs()));
    a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a / unit_a - b / unit_b).abs())) / largest
}

#[test]
fn units_do_not_matter_over_twenty_decades() {
    for case in CASES {
        for solver in solvers() {
            let problem = case.problem([1.0, 1.0]);
            let (expected, measures) = solve(solver.as_ref(), &problem);
            for units in DECIMAL {
                let (found, scaled) = solve(solver.as_ref(), &case.problem(units));
                let what = format!("{} by {} in units {units:?}", case.name, solver.name());
                assert_eq!(scaled.relative_area, measures.relative_area, "{what}");
                assert!((scaled.kappa_r / measures.kappa_r - 1.0).abs() < 1e-10, "{what}: {}", scaled.kappa_r);
                let pressure = difference(&found.pressure, units[1], &expected.pressure, 1.0);
                let gap = difference(&found.gap, units[0], &expected.gap, 1.0);
                assert!(pressure < 1e-9 && gap < 1e-9, "{what}: pressure {pressure:e}, gap {gap:e}");
            }
        }
    }
}

#[test]
fn units_that_are_powers_of_two_change_not_a_single_bit() {
    for case in CASES {
        for solver in solvers() {
            let (expected, measures) = solve(solver.as_ref(), &case.problem([1.0, 1.0]));
            for powers in BINARY {
                let units = powers.map(|power| 2f64.powi(power));
                let (found, scaled) = solve(solver.as_ref(), &case.problem(units));
                let what = format!("{} by {} in units 2^{powers:?}", case.name, solver.name());
                assert_eq!(scaled, measures, "{what}");
                assert_eq!(found.certificate, expected.certificate, "{what}");
                assert_eq!(found.pressure, &expected.pressure * units[1], "{what}");
                assert_eq!(found.gap, &expected.gap * units[0], "{what}");
            }
        }
    }
}

#[test]
fn a_reduced_pressure_poses_the_same_problem_in_any_units() {
    for units in DECIMAL {
        let problem =
            Problem::new(rough_surface(units[0]), ContactModulus(units[1]), Load::ReducedPressure(0.05)).unwrap();
        let strain = problem.expected_mean_pressure() / units[1];
        assert!((strain / (0.05 * 0.1) - 1.0).abs() < 1e-12, "{units:?}: {strain}");
    }
}

#[test]
fn the_zero_of_heights_does_not_matter() {
    for case in CASES {
        for solver in solvers() {
            let problem = case.problem([1.0, 1.0]);
            let (expected, measures) = solve(solver.as_ref(), &problem);
            for offset in [1e3, -1e3] {
                let lifted = problem.surface().height() + offset * problem.rms_height();
                let surface = Surface::new(*problem.surface().grid(), lifted).unwrap();
                let (found, moved) = solve(
                    solver.as_ref(),
                    &Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(case.strain)).unwrap(),
                );
                let what = format!("{} by {} lifted by {offset:e}", case.name, solver.name());
                assert_eq!(moved.relative_area, measures.relative_area, "{what}");
                assert!((moved.kappa_r / measures.kappa_r - 1.0).abs() < 1e-8, "{what}: {}", moved.kappa_r);
                let pressure = difference(&found.pressure, 1.0, &expected.pressure, 1.0);
                let gap = difference(&found.gap, 1.0, &expected.gap, 1.0);
                assert!(pressure < 1e-8 && gap < 1e-8, "{what}: pressure {pressure:e}, gap {gap:e}");
            }
        }
    }
}
