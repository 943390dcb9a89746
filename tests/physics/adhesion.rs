//! Adhesion against closed forms: Johnson's sine, JKR, Maugis, Baney and Hui.

use asperity::Grid;
use asperity::adhesion::{
    AdhesiveControl, AdhesiveMethod, AdhesiveOutcome, AdhesiveProblem, AdhesiveState, Attraction, AttractionForm,
};
use asperity::contact::{ContactModulus, Load, Problem, Quantity, ResultClaim, State, Stop};
use asperity::history::{AdhesionTotals, AdhesiveProcess, PathPoint, Process};
use asperity::surface::Indenter;
use asperity::theory::PullOff;
use std::f64::consts::PI;

const AMPLITUDE: f64 = 1.0;
const MODULUS: f64 = 1.0 / PI;

/// Johnson's sine with `E* = 1/pi`, so that `p_full = 1`: the work of adhesion has `alpha^2 = (2/pi) w/(D p_full)`.
fn sine(points: usize, alpha: f64, range: f64) -> AdhesiveProblem {
    let surface = Indenter::Sine { amplitude: AMPLITUDE }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(MODULUS), Load::MeanPressure(0.5)).unwrap();
    let attraction = Attraction::new(AttractionForm::Exponential, 0.5 * PI * alpha * alpha, range).unwrap();
    AdhesiveProblem::new(problem, attraction).unwrap()
}

fn state(problem: &AdhesiveProblem, control: AdhesiveControl, from: Option<&AdhesiveState>) -> AdhesiveState {
    match problem.solve(control, from, AdhesiveMethod::Fast, &Stop::default(), &mut ()).unwrap() {
        AdhesiveOutcome::State(state) => state,
        AdhesiveOutcome::Separated { .. } => panic!("separated at {control:?}"),
    }
}

/// The states along a path of loads.
fn follow(problem: &AdhesiveProblem, loads: &[Load], steps: usize) -> Vec<State> {
    let path = loads.iter().map(|&load| PathPoint { time: None, load, tangential: None }).collect();
    let mut states = Vec::new();
    let mut process = AdhesiveProcess::new(problem.clone(), path, steps, AdhesiveMethod::Fast, Stop::default());
    let told = process.run(&mut (), &mut |state| {
        states.push(state);
        Ok(())
    });
    told.unwrap();
    states
}

/// Johnson (1995): mean pressure and mean gap of a sine in the limit of a short range, by the half-width of the contact.
fn johnson(alpha: f64, psi: f64) -> [f64; 2] {
    let pressure = psi.sin().powi(2) - alpha * psi.tan().sqrt();
    [pressure, psi.cos().powi(2) + 2.0 * pressure * psi.sin().ln()]
}

/// The pressure at a mean gap on the branch that sticks.
fn johnson_at(alpha: f64, gap: f64) -> f64 {
    let psi = |i: usize| PI / 2.0 * (20_000.0 - i as f64) / 20_001.0;
    let place = (0..20_000).find(|&i| johnson(alpha, psi(i))[1] > gap).unwrap();
    let [[p, from], [q, to]] = [place - 1, place].map(|i| johnson(alpha, psi(i)));
    p + (q - p) * (gap - from) / (to - from)
}

#[test]
fn a_sine_at_given_mean_gaps_follows_johnson_and_converges() {
    let gaps = [0.4, 0.6, 0.8, 1.0];
    let errors = [(512, 0.1), (1024, 0.05), (4096, 0.03)].map(|(points, range)| {
        let problem = sine(points, 0.2, range);
        let mut last = None;
        let error = |gap: f64| {
            let found = state(&problem, AdhesiveControl::MeanGap(gap), last.as_ref());
            assert!(found.claim == ResultClaim::Stable && found.residual <= 1e-8 && found.method == "newton");
            assert!((found.mean_gap() / gap - 1.0).abs() < 1e-12);
            let missed = (found.mean_pressure - johnson_at(0.2, gap)).abs();
            last = Some(found);
            missed
        };
        gaps.map(error).into_iter().fold(0.0, f64::max)
    });
    let largest = johnson_at(0.2, 0.4);
    assert!(errors[2] < 3e-3 * largest && errors[1] < 0.5 * errors[0] && errors[2] < 0.5 * errors[1], "{errors:?}");
    // the figures of Carbone and Mangialardi's formula themselves
    assert!((largest - 0.218653).abs() < 1e-5 && (johnson_at(0.2, 1.0) + 0.030243).abs() < 1e-5);
}

/// The lowest pressure under which the surfaces still stick, and the energies of a closed path in the mean gap.
#[test]
fn pull_off_and_loop_of_a_sine() {
    // under a load
    let problem = sine(4096, 0.2, 0.03);
    let states = follow(&problem, &[Load::MeanPressure(0.1), Load::MeanPressure(-0.08)], 12);
    let totals = AdhesionTotals::new(&states).unwrap();
    assert!(totals.separated && states.last().unwrap().claim == ResultClaim::Separated);
    let pull_off = totals.lowest_pressure.unwrap();
    assert!((pull_off / -0.055611 - 1.0).abs() < 0.01, "{pull_off}");
    for state in states.iter().filter(|state| state.claim == ResultClaim::Separated) {
        assert_eq!(state.value(Quantity::MeanPressure), 0.0);
        assert_eq!([Quantity::Dissipated, Quantity::WorkDone].map(|it| state.get(it)), [None; 2]);
    }
    // at a mean gap the contact holds further, up to the place where Johnson's curve turns back
    let states = follow(&problem, &[Load::MeanGap(1.6), Load::MeanGap(0.4), Load::MeanGap(1.6)], 12);
    let totals = AdhesionTotals::new(&states).unwrap();
    let [snap, release] = totals.jumps.as_slice() else { panic!("{:?}", totals.jumps) };
    assert!((release.mean_gap[0] - 1.252049).abs() < 0.01, "{release:?}");
    assert!((release.mean_pressure[0] + 0.045410).abs() < 0.003 && release.relative_area[1] == 0.0);
    assert!(snap.relative_area[0] < 0.02 && snap.relative_area[1] > 0.05 && snap.mean_gap[0] < release.mean_gap[0]);
    assert!(states.iter().all(|state| state.claim == ResultClaim::Stable || state.claim == ResultClaim::Marginal));
    // the path is closed, so what the load did is what the jumps lost: at many steps the integral of the pressure over the mean gap, where the
    // pressure does not jump
    let many = follow(&problem, &[Load::MeanGap(1.6), Load::MeanGap(0.4), Load::MeanGap(1.6)], 400);
    let closed: f64 = many
        .windows(2)
        .map(|pair| {
            let [before, after] = [&pair[0], &pair[1]];
            let pressure = before.value(Quantity::MeanPressure) + after.value(Quantity::MeanPressure);
            -0.5 * pressure * (after.contact.mean_gap() - before.contact.mean_gap())
        })
        .sum();
    let error = (totals.lost_in_jumps - closed).abs();
    assert!(totals.lost_in_jumps > 0.0 && error < 0.01 * closed, "{totals:?} {closed}");
    assert!(totals.lost_error.unwrap() < 0.05 * closed && states.last().unwrap().value(Quantity::WorkDone) > 0.0);
}

/// From `alpha = ((3^(1/2)/2)^(3/2)/2^(1/2)) = 0.5699` on, a sine sticks everywhere without a load.
#[test]
fn a_sine_that_sticks_everywhere_needs_no_load() {
    let area = |alpha: f64| state(&sine(2048, alpha, 0.1), AdhesiveControl::MeanPressure(0.0), None).relative_area();
    let [below, above] = [0.53, 0.61].map(area);
    assert!(below < 0.6 && above == 1.0, "{below} {above}");
}

/// Chaudhury, Weaver, Hui and Kramer (1996): pull-off force `-3 (pi E* w^2 R/16)^(1/3)` of a cylinder in the limit of a short range, on a cell
/// that is wide beside the contact.
#[test]
fn a_cylinder_lets_go_at_the_force_of_the_short_range() {
    let work = work_of(0.02);
    let exact = -3.0 * (PI * work * work / 16.0).cbrt();
    let errors = [8192, 32768].map(|points| pull_off_of_cylinder(work, points, exact) / exact - 1.0);
    // the pull-off is told to a thousandth of the step of the path
    assert!(errors.iter().all(|error| error.abs() < 2e-3), "{errors:?}");
    let [told, free] = [Grid::line(64, 1.0).unwrap(), free_line(64, 1.0)].map(|grid| jkr(&grid, work));
    assert!((free / exact - 1.0).abs() < 1e-12 && (told / exact - 1.0).abs() < 1e-3, "{told} {free} {exact}");
}

/// The same in a cell with contacts that feel their neighbours: each alone would let go at less.
#[test]
fn a_cylinder_in_a_narrow_cell_lets_go_at_the_force_of_the_short_range() {
    let work = work_of(0.1);
    let told = jkr(&Grid::line(64, 1.0).unwrap(), work);
    let alone = -3.0 * (PI * work * work / 16.0).cbrt();
    let found = pull_off_of_cylinder(work, 8192, told);
    assert!((found / told - 1.0).abs() < 2e-3 && told / alone > 1.01, "{found} {told} {alone}");
}

/// A cylinder that would stick to all of its cell has no pull-off in theory, nor has a sphere that its cell has no room for.
#[test]
fn what_does_not_fit_the_cell_has_no_pull_off_in_theory() {
    let line = Grid::line(64, 1.0).unwrap();
    let surface = Grid::surface([64; 2], [1.0; 2]).unwrap();
    let of_sphere = |work: f64| PullOff::new(&Indenter::Sphere { radius: 1.0 }, &surface, 1.0, work);
    assert_eq!(PullOff::new(&Indenter::Cylinder { radius: 1.0 }, &line, 1.0, 1.0), None);
    assert_eq!(of_sphere(1.0), None);
    // force over pi w R, with the area of the cell 1
    let PullOff { jkr, dmt } = of_sphere(1e-4).unwrap();
    assert!((jkr / (PI * 1e-4) + 1.5).abs() < 1e-12 && (dmt.unwrap() / (PI * 1e-4) + 2.0).abs() < 1e-12);
}

/// The work of adhesion with which a cylinder of radius 1 lets go at a half-width, alone.
fn work_of(half_width: f64) -> f64 {
    PI / 2.0 * half_width.powi(3)
}

/// The pull-off of a cylinder of radius 1 in theory.
fn jkr(grid: &Grid, work: f64) -> f64 {
    PullOff::new(&Indenter::Cylinder { radius: 1.0 }, grid, 1.0, work).unwrap().jkr
}

/// The pull-off of a cylinder of radius 1 in a cell of length 1, whose attraction has the shortest range that the grid resolves.
fn pull_off_of_cylinder(work: f64, points: usize, expected: f64) -> f64 {
    let surface = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(points, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(1e-3)).unwrap();
    let range = (PI * work * 4.5 / points as f64).sqrt();
    let attraction = Attraction::new(AttractionForm::Exponential, work, range).unwrap();
    let problem = AdhesiveProblem::new(problem, attraction).unwrap();
    let states = follow(&problem, &[Load::MeanPressure(-0.5 * expected), Load::MeanPressure(1.3 * expected)], 8);
    AdhesionTotals::new(&states).unwrap().lowest_pressure.unwrap()
}

/// Baney & Hui, J. Appl. Phys. 82, 3910 (1997): a cylinder with Dugdale's attraction. The error is of first order in the spacing, as nodes are
/// within reach or not; two grids extrapolate it.
#[test]
fn a_cylinder_with_dugdales_attraction_follows_baney_and_hui() {
    for (lambda, pull_off, unloaded) in [(2.0, -1.18011, 1.40265), (5.0, -1.19016, 1.54096)] {
        let found = [1024, 2048].map(|points| {
            let (radius, work, modulus) = (1.0, 0.05, 10.0);
            let strength = lambda * f64::cbrt(PI * PI * modulus * modulus * work / radius) / 4.0;
            let half_width = 2.0 * f64::cbrt(work * radius * radius / (PI * modulus));
            let force = f64::cbrt(PI * modulus * work * work * radius);
            let length = 4.0 * half_width;
            let surface = Indenter::Cylinder { radius }.surface(free_line(points, length)).unwrap();
            let problem = Problem::new(surface, ContactModulus(modulus), Load::Force(1.0)).unwrap();
            let attraction = Attraction::new(AttractionForm::Dugdale, work, work / strength).unwrap();
            let problem = AdhesiveProblem::new(problem, attraction).unwrap();
            let states = follow(&problem, &[Load::Force(0.0), Load::Force(-1.1 * force), Load::Force(-1.5 * force)], 8);
            assert!(states[0].claim == ResultClaim::Stationary);
            let lowest = AdhesionTotals::new(&states).unwrap().lowest_pressure.unwrap();
            [lowest * length / force, states[0].value(Quantity::RelativeArea) * length / 2.0 / half_width]
        });
        let [p, a]: [f64; 2] = [0, 1].map(|i| 2.0 * found[1][i] - found[0][i]);
        assert!((p / pull_off - 1.0).abs() < 0.01 && (a / unloaded - 1.0).abs() < 0.01, "{found:?}: {p} {a}");
    }
}

fn free_line(points: usize, length: f64) -> Grid {
    Grid::line(points, length).unwrap().with_periodic([false; 2])
}

/// Maugis, J. Colloid Interface Sci. 150, 243 (1992): pull-off force over `pi w R`, and the radius of the contact without load. As for the
/// cylinder, two grids extrapolate the force; the area counts nodes.
#[test]
fn a_sphere_with_dugdales_attraction_follows_maugis() {
    for (lambda, size, points, pull_off, unloaded) in
        [(0.1, 10.0, 40, -1.95059, 1.33618), (0.5, 6.0, 64, -1.71825, 1.51738), (1.0, 6.0, 96, -1.60073, 1.63609)]
    {
        let found = [points, 2 * points].map(|points| {
            let (radius, work, modulus) = (1.0, 0.05, 10.0);
            let stiff = 4.0 / 3.0 * modulus;
            let strength = 0.5 * lambda * f64::cbrt(PI * work * stiff * stiff / radius);
            let unit = f64::cbrt(PI * work * radius * radius / stiff);
            let grid = Grid::surface([points; 2], [size * unit; 2]).unwrap().with_periodic([false; 2]);
            let area = grid.area();
            let problem = Problem::new(
                Indenter::Sphere { radius }.surface(grid).unwrap(),
                ContactModulus(modulus),
                Load::Force(1.0),
            );
            let attraction = Attraction::new(AttractionForm::Dugdale, work, work / strength).unwrap();
            let problem = AdhesiveProblem::new(problem.unwrap(), attraction).unwrap();
            assert!((problem.scales().maugis.unwrap() / lambda - 1.0).abs() < 1e-3);
            let force = PI * work * radius;
            let states = follow(&problem, &[Load::Force(0.0), Load::Force(-1.4 * force), Load::Force(-2.1 * force)], 8);
            let lowest = AdhesionTotals::new(&states).unwrap().lowest_pressure.unwrap();
            let told = problem.scales().grid_error.unwrap();
            if lambda >= 0.5 {
                // a contact of many spacings: the error of the pull-off is that of its edges
                let error = lowest * area / force / pull_off - 1.0;
                assert!(error > 0.5 * told && error < 2.0 * told, "{lambda}, {points} points: {error} {told}");
            }
            [lowest * area / force, (states[0].value(Quantity::RelativeArea) / PI).sqrt() * size]
        });
        let (p, a): (f64, f64) = (2.0 * found[1][0] - found[0][0], found[1][1]);
        assert!((p / pull_off - 1.0).abs() < 0.01 && (a / unloaded - 1.0).abs() < 0.01, "{found:?}: {p} {a}");
    }
}
