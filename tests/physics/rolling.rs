//! Steady rolling against Carter, Bentall and Johnson, and the reference output of the program CONTACT.

use asperity::contact::{ContactModulus, Load, Problem, Stop};
use asperity::error::{MotionError, ProblemError};
use asperity::history::{Rolling, RollingConditions, RollingDrive};
use asperity::surface::{Field, Surface};
use asperity::{Grid, Indenter};
use std::f64::consts::PI;

fn stop() -> Stop {
    Stop::new(1e-11, 100_000).unwrap()
}

/// The example `carter2d` of CONTACT, on elements that are `refined` times smaller.
fn carter(refined: usize) -> Rolling {
    let points = 55 * refined;
    let spacing = 0.04 / refined as f64;
    let grid = Grid::line(points, points as f64 * spacing).unwrap().with_periodic([false; 2]);
    let middle = 0.5 * (points - 1) as f64;
    let height = Field::from_shape_fn((1, points), |(_, i)| -((i as f64 - middle) * spacing).powi(2) / 1000.0);
    let modulus = 82_000.0 / (1.0 - 0.28);
    let problem =
        Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(modulus), Load::Force(35_780.0 / 200.0));
    let conditions = RollingConditions {
        friction: 0.3,
        step: 0.0401 / refined as f64,
        beta: 0.0,
        drive: RollingDrive::Creepage(-2.4e-4),
    };
    Rolling::solve(&problem.unwrap(), conditions, &stop(), &mut ()).unwrap()
}

#[test]
fn the_cylinder_of_carter_carries_the_force_of_contact_and_in_the_limit_that_of_carter() {
    let rolling = carter(1);
    let touching = rolling.contact.pressure.iter().filter(|p| **p > 0.0).count();
    assert!((rolling.ratio() / 0.6480 - 1.0).abs() < 1e-3, "{}", rolling.ratio());
    assert!((rolling.contact.max_pressure() / 113.9 - 1.0).abs() < 1e-3);
    // CONTACT says 50; the edge, at 1.00001, lies on the outermost of 51 nodes that are symmetric
    assert!((50..=51).contains(&touching), "{touching}");
    let [mut coarse, mut fine] = [0.0; 2];
    for refined in [2, 4, 8] {
        let rolling = carter(refined);
        (coarse, fine) = (fine, rolling.ratio());
    }
    // the error is of first order in the spacing
    let limit = 2.0 * fine - coarse;
    assert!((limit - 0.64).abs() < 1e-3, "{limit}");
}

/// The example `bentall` of CONTACT: creepage and highest pressure. Its tractions act on the first of its bodies, the softer one. Seen
/// with that below, `x` and the creepage would change their signs; here the second body is the solid below.
fn bentall(friction: f64, ratio: f64) -> [f64; 2] {
    let (points, spacing, radius) = (216, 0.001, 25.0);
    let [below, above] = [(82_000.0, 0.28), (23_000.0, 0.31)];
    let normal = |(g, nu): (f64, f64)| (1.0 - nu) / g;
    let tangential = |(g, nu): (f64, f64)| (1.0 - 2.0 * nu) / g;
    let modulus = 2.0 / (normal(below) + normal(above));
    let beta = 0.5 * (tangential(below) - tangential(above)) / (normal(below) + normal(above));
    let grid = Grid::line(points, points as f64 * spacing).unwrap().with_periodic([false; 2]);
    let middle = 0.5 * (points - 1) as f64;
    let height = Field::from_shape_fn((1, points), |(_, i)| -((i as f64 - middle) * spacing).powi(2) / (2.0 * radius));
    let problem =
        Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(modulus), Load::Force(16.2019)).unwrap();
    let conditions = RollingConditions { friction, step: spacing, beta, drive: RollingDrive::Ratio(ratio) };
    let rolling = Rolling::solve(&problem, conditions, &stop(), &mut ()).unwrap();
    assert!(rolling.rounds <= 10 && rolling.traction_certificate <= 1e-11 && rolling.pressure_certificate <= 1e-11);
    [rolling.creepage(), rolling.contact.max_pressure()]
}

/// The forces of both signs are not mirror images: the material runs through the contact in one direction.
#[test]
fn dissimilar_cylinders_creep_as_bentall_and_johnson_and_contact_say() {
    let cases = [
        (1e-4, 0.0, 5.260e-4, 103.1),
        (0.05, 0.0, 4.294e-4, 103.6),
        (10.0, 0.0, 3.591e-4, 103.8),
        (0.05, 0.75, 2.108e-4, 103.2),
        (0.05, -0.75, 5.392e-4, 103.3),
    ];
    for (friction, ratio, creepage, highest) in cases {
        let [found, pressure] = bentall(friction, ratio);
        assert!((found / creepage - 1.0).abs() < 1e-3, "{friction} {ratio}: {found:e} against {creepage:e}");
        assert!((pressure / highest - 1.0).abs() < 1e-3, "{friction} {ratio}: {pressure} against {highest}");
    }
}

/// The heights are those given, and the displacement is that by pressure and traction, by sums over strips.
#[test]
fn different_bodies_have_their_heights_and_the_whole_displacement() {
    let (n, dx, beta) = (300, 0.6 / 300.0, 0.2);
    let problem = cylinder(n, false);
    let conditions = RollingConditions { beta, ..conditions(&problem, RollingDrive::Ratio(0.4)) };
    let rolling = Rolling::solve(&problem, conditions, &stop(), &mut ()).unwrap();
    assert!(rolling.rounds > 1 && rolling.contact.is_converged());
    assert!(rolling.contact.problem.surface().height() == problem.surface().height());
    let primitive = |x: f64| if x == 0.0 { 0.0 } else { x * x.abs().ln() - x };
    let displaced = |i: usize| -> f64 {
        let at = |j: usize| {
            let x = (i as f64 - j as f64) * dx;
            let across = if i == j { 0.0 } else { dx * x.signum() };
            let along = -2.0 / PI * (primitive(x + 0.5 * dx) - primitive(x - 0.5 * dx));
            rolling.contact.pressure[[0, j]] * along + beta * rolling.traction[[0, j]] * across
        };
        (0..n).map(at).sum()
    };
    let whole: Vec<f64> = (0..n).map(displaced).collect();
    let spread = |of: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = (0..n).map(of).collect();
        values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
    };
    let (contact, deepest) = (&rolling.contact, spread(&|i| whole[i]));
    let apart = spread(&|i| contact.displacement[[0, i]] - whole[i]);
    let gap = spread(&|i| contact.gap[[0, i]] - (contact.displacement[[0, i]] - problem.height()[i]));
    assert!(apart < 1e-10 * deepest && gap < 1e-12 * deepest, "{apart:e} {gap:e} of {deepest:e}");
}

fn cylinder(points: usize, is_periodic: bool) -> Problem {
    let grid = Grid::line(points, 0.6).unwrap().with_periodic([is_periodic; 2]);
    let surface = Indenter::Cylinder { radius: 1.0 }.surface(grid).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::Force(0.01)).unwrap()
}

fn conditions(problem: &Problem, drive: RollingDrive) -> RollingConditions {
    RollingConditions { friction: 0.3, step: problem.surface().grid().spacing()[1], beta: 0.0, drive }
}

/// `xi = -(mu a/R) (1 - sqrt(1 - Fx/(mu Fn)))` and the same with all signs turned.
#[test]
fn the_creepage_of_a_force_is_that_of_carter_and_goes_back_to_the_force() {
    let problem = cylinder(1200, false);
    let a = (4.0 * 0.01 / PI).sqrt();
    for ratio in [-0.7, 0.2, 0.9] {
        let by_force =
            Rolling::solve(&problem, conditions(&problem, RollingDrive::Ratio(ratio)), &stop(), &mut ()).unwrap();
        let exact = -0.3 * a * (1.0 - (1.0 - f64::abs(ratio)).sqrt()) * ratio.signum();
        assert!((by_force.creepage() / exact - 1.0).abs() < 2e-3, "{} against {exact}", by_force.creepage());
        assert!((by_force.ratio() - ratio).abs() < 1e-9);
        let drive = RollingDrive::Creepage(by_force.creepage());
        let back = Rolling::solve(&problem, conditions(&problem, drive), &stop(), &mut ()).unwrap();
        assert!((back.ratio() - ratio).abs() < 1e-4, "{} against {ratio}", back.ratio());
        // it sticks where material enters, at +x
        let sticks = back.sticks();
        let touching: Vec<usize> = (0..sticks.len()).filter(|&i| back.contact.pressure[[0, i]] > 0.0).collect();
        assert!(sticks[touching[touching.len() - 2]] && !sticks[touching[0]]);
        let directions = back.slip_directions();
        assert!(touching.iter().all(|&i| sticks[i] || f64::from(directions[i]) == -ratio.signum()));
    }
}

/// Carter's `xi = -(mu a/R) x/(1 + sqrt(1 - x))` with `x = Fx/(mu Fn)`: the relative error does not depend on how weak the drive is.
#[test]
fn weak_drives_are_as_exact_as_strong_ones() {
    let a = (4.0 * 0.01 / PI).sqrt();
    let mut slopes = Vec::new();
    for ratio in [1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 0.1, 0.3, 0.6, 0.9, 0.999] {
        let exact = -0.3 * a * ratio / (1.0 + (1.0f64 - ratio).sqrt());
        let found = [600, 1200].map(|points| {
            let problem = cylinder(points, false);
            let by_force = Rolling::solve(&problem, conditions(&problem, RollingDrive::Ratio(ratio)), &stop(), &mut ());
            let by_force = by_force.unwrap();
            assert!(by_force.contact.is_converged() && (by_force.ratio() / ratio - 1.0).abs() < 1e-9, "{ratio}");
            let drive = RollingDrive::Creepage(by_force.creepage());
            let back = Rolling::solve(&problem, conditions(&problem, drive), &stop(), &mut ()).unwrap();
            assert!((back.ratio() / ratio - 1.0).abs() < 1e-4, "{} against {ratio}", back.ratio());
            by_force.creepage() / exact
        });
        println!("{ratio:e}: {found:?} of the creepage of Carter");
        // where the edge lies between two nodes matters: 426 nodes touch
        assert!((found[1] - 1.0).abs() < 1e-2, "{ratio}: {found:?}");
        slopes.push(found[1]);
    }
    // as long as no node slips, the creepage is proportional to the force
    assert!((slopes[0] / slopes[1] - 1.0).abs() < 1e-8 && (slopes[0] / slopes[2] - 1.0).abs() < 1e-5, "{slopes:?}");
}

/// Coulomb's law and the slip, both by sums over the elements that share no code with the solver.
#[test]
fn slip_and_traction_obey_coulomb_by_direct_sums() {
    let problem = cylinder(300, false);
    let rolling = Rolling::solve(&problem, conditions(&problem, RollingDrive::Ratio(0.5)), &stop(), &mut ()).unwrap();
    let (n, dx) = (300, 0.6 / 300.0);
    let primitive = |x: f64| if x == 0.0 { 0.0 } else { x * x.abs().ln() - x };
    let kernel = |x: f64| -2.0 / PI * (primitive(x + 0.5 * dx) - primitive(x - 0.5 * dx));
    let displacement = |at: f64| (0..n).map(|j| rolling.traction[[0, j]] * kernel(at - j as f64 * dx)).sum::<f64>();
    let slips: Vec<f64> = (0..n)
        .map(|i| {
            let x = i as f64 * dx;
            rolling.creepage() * dx + displacement(x) - displacement(x + dx)
        })
        .collect();
    let most = slips.iter().fold(0.0, |most: f64, s| most.max(s.abs()));
    for (i, &s) in slips.iter().enumerate() {
        let (p, tau) = (rolling.contact.pressure[[0, i]], rolling.traction[[0, i]]);
        assert!(tau.abs() <= 0.3 * p * (1.0 + 1e-12));
        if p > 0.0 && rolling.sticks()[i] {
            assert!(s.abs() < 1e-4 * most, "{i}: {s} of {most}");
        } else if p > 0.0 {
            assert!(s * tau <= 1e-4 * most * tau.abs(), "{i}: {s} {tau}");
        }
        assert!((s - rolling.slip[[0, i]]).abs() < 1e-9 * most);
    }
}

#[test]
fn periodic_lines_roll_as_free_ones_do() {
    let [free, periodic] = [false, true].map(|is_periodic| {
        let problem = cylinder(600, is_periodic);
        Rolling::solve(&problem, conditions(&problem, RollingDrive::Ratio(0.5)), &stop(), &mut ()).unwrap()
    });
    assert!((free.creepage() / periodic.creepage() - 1.0).abs() < 0.15, "{} {}", free.creepage(), periodic.creepage());
}

#[test]
fn what_cannot_roll_is_refused() {
    let problem = cylinder(64, false);
    let solve = |problem: &Problem, conditions| Rolling::solve(problem, conditions, &stop(), &mut ()).unwrap_err();
    let base = conditions(&problem, RollingDrive::Ratio(0.5));
    let slides = solve(&problem, RollingConditions { drive: RollingDrive::Ratio(1.0), ..base });
    assert!(matches!(slides, MotionError::Slides { ratio: 1.0 }), "{slides}");
    let friction = solve(&problem, RollingConditions { friction: 0.0, ..base });
    assert!(matches!(friction, MotionError::NotPositive { .. }), "{friction}");
    let beta = solve(&problem, RollingConditions { beta: 0.6, ..base });
    assert!(matches!(beta, MotionError::Beta { .. }), "{beta}");
    let step = solve(&problem, RollingConditions { step: -1.0, ..base });
    assert!(matches!(step, MotionError::Problem(ProblemError::NotPositive { .. })), "{step}");
}

/// A rough free line that rolls, to a tolerance.
fn rough(case: usize, creepage: f64, step: f64, tolerance: f64) -> Rolling {
    let points = 96;
    let grid = Grid::line(points, 1.0).unwrap().with_periodic([false; 2]);
    let wave = |k: usize, x: f64| (2.0 * PI * k as f64 * x + (k * (case + 2)) as f64).cos() / (k * k) as f64;
    let height = Field::from_shape_fn((1, points), |(_, i)| {
        let x = i as f64 / points as f64 - 0.5;
        -0.5 * x * x + 0.01 * (2..9).map(|k| wave(k, x)).sum::<f64>()
    });
    let problem = Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(1.0), Load::MeanPressure(0.02));
    let conditions = RollingConditions { friction: 0.2, step, beta: 0.0, drive: RollingDrive::Creepage(creepage) };
    Rolling::solve(&problem.unwrap(), conditions, &Stop::new(tolerance, 100_000).unwrap(), &mut ()).unwrap()
}

/// Close to full sliding, and beyond it, the nodes that stick do not depend on the tolerance.
#[test]
fn nodes_that_stick_do_not_depend_on_the_tolerance_close_to_sliding() {
    for case in 0..4 {
        for creepage in [-0.01, -0.04, -0.08, -0.12, -0.2, -0.5] {
            let [usual, fine] = [1e-8, 1e-12].map(|tolerance| rough(case, creepage, 1.0 / 96.0, tolerance));
            let differ = usual.sticks().iter().zip(fine.sticks()).filter(|(a, b)| **a != *b).count();
            assert!(differ <= 1, "{case} {creepage}: {differ} nodes");
        }
        let slides = rough(case, -5.0, 1.0 / 96.0, 1e-8);
        assert!(slides.sticks().iter().all(|sticks| !sticks) && (slides.ratio() - 1.0).abs() < 1e-12);
    }
}

/// In a step of two spacings a traction that alternates from node to node displaces nothing. Such steps give what their neighbours give.
#[test]
fn steps_of_pairs_of_spacings_converge_like_their_neighbours() {
    for pairs in 1..=5 {
        let ratios = [0.999, 1.0, 1.001].map(|part| {
            let rolling = rough(1, -0.01, part * 2.0 * f64::from(pairs) / 96.0, 1e-8);
            assert!(rolling.contact.is_converged(), "{pairs} {part}: {:?}", rolling.contact.status);
            rolling.ratio()
        });
        let middle = 0.5 * (ratios[0] + ratios[2]);
        assert!((ratios[1] / middle - 1.0).abs() < 2e-3, "{pairs}: {ratios:?}");
    }
}
