//! Loose solves against tight ones of the same steps, and a hardness.

use super::{problem, prony, rough, tight};
use asperity::Grid;
use asperity::contact::{Law, Load, Multilevel, PolonskyKeer, Problem, Solver, Stop};
use asperity::elastic::{Prony, Response};
use asperity::history::{Creep, CreepState};
use asperity::surface::Field;

/// `sqrt <x A x>`.
fn length(problem: &Problem, x: &Field) -> f64 {
    let mut u = vec![0.0; x.len()];
    Response::from_compliance(std::sync::Arc::new(problem.compliance().clone()))
        .displacement(x.as_slice().unwrap(), &mut u);
    (x.iter().zip(&u).map(|(x, u)| x * u).sum::<f64>() / u.len() as f64).max(0.0).sqrt()
}

const STEPS: [(f64, f64); 9] =
    [(0.0, 1.0), (0.1, 1.0), (0.4, 2.0), (0.05, 2.0), (0.0, 0.3), (0.3, 0.3), (2.0, 0.1), (0.01, 0.5), (0.02, 1.5)];

fn states(problem: &Problem, solid: &Prony, solver: &dyn Solver, stop: &Stop) -> Vec<CreepState> {
    let mut creep = Creep::new(problem.clone(), solid.clone());
    let mut state = creep.start();
    let step = |&(dt, part): &(f64, f64)| {
        state = creep.step(&state, dt, Load::ReducedPressure(0.02 * part), solver, stop, &mut ()).unwrap();
        state.clone()
    };
    STEPS.iter().map(step).collect()
}

#[test]
fn errors_of_loose_solves_stay_below_the_running_bound() {
    for solid in [prony(&[[9.0, 1.0]]), prony(&[[9.0, 1.0], [3.0, 0.02], [20.0, 50.0]])] {
        for grid in [Grid::line(512, 1.0).unwrap(), Grid::surface([32, 32], [1.0, 1.0]).unwrap()] {
            let problem = problem(rough(grid, 0.8, 6));
            let exact = states(&problem, &solid, &Multilevel, &tight());
            for (solver, tolerance) in
                [(&Multilevel as &dyn Solver, 1e-2), (&PolonskyKeer, 1e-3), (&PolonskyKeer, 1e-5)]
            {
                let loose = states(&problem, &solid, solver, &Stop::new(tolerance, 10_000).unwrap());
                for (loose, exact) in loose.iter().zip(&exact) {
                    let effective = loose.effective_pressure();
                    let off = length(&problem, &(effective - exact.effective_pressure()));
                    let [off, size] = [off, length(&problem, effective)];
                    let bound = loose.error_bound() + exact.error_bound();
                    assert!(off <= bound * size, "{off} above {bound} of {size} at {}", loose.time);
                }
            }
        }
    }
}

/// The errors of earlier solves fade: after many steps the bound is that of a few.
#[test]
fn the_running_bound_does_not_grow_with_the_number_of_steps() {
    let problem = problem(rough(Grid::line(256, 1.0).unwrap(), 0.8, 6));
    let mut creep = Creep::new(problem, prony(&[[9.0, 1.0]]));
    let (stop, load) = (Stop::new(1e-6, 10_000).unwrap(), Load::ReducedPressure(0.02));
    let mut state = creep.step(&creep.start(), 0.0, load, &Multilevel, &stop, &mut ()).unwrap();
    let mut bounds = Vec::new();
    for _ in 0..200 {
        state = creep.step(&state, 0.1, load, &Multilevel, &stop, &mut ()).unwrap();
        bounds.push(state.error_bound());
    }
    // what each solve adds is at most the root of its tolerance times a factor, and fades within the time of the solid
    assert!(bounds.iter().all(|&bound| bound < 0.05), "{bounds:?}");
}

#[test]
fn a_hardness_limits_the_pressure_and_holds_in_every_node() {
    let grid = Grid::line(512, 1.0).unwrap();
    let hardness = 0.005;
    let problem = problem(rough(grid, 0.8, 6)).with_law(Law::Hardness(hardness)).unwrap();
    let mut creep = Creep::new(problem.clone(), prony(&[[9.0, 1.0]]));
    let stop = Stop::new(1e-10, 20_000).unwrap();
    let (mut state, mut yielding) = (creep.start(), Vec::new());
    for (dt, part) in [(0.0, 1.0), (0.3, 1.0), (1.0, 1.0), (3.0, 1.0), (0.5, 0.2)] {
        let load = Load::MeanPressure(0.2 * hardness * part);
        state = creep.step(&state, dt, load, &Multilevel, &stop, &mut ()).unwrap();
        let contact = &state.contact;
        assert!(contact.is_converged() && (contact.mean_pressure() / load.value() - 1.0).abs() < 1e-9);
        let allowed = 1e-8 * problem.rms_height();
        for (&p, &gap) in contact.pressure.iter().zip(&contact.gap) {
            assert!((0.0..=hardness).contains(&p));
            let is_free = p > 1e-6 * hardness && p < hardness * (1.0 - 1e-6);
            assert!(!is_free || gap.abs() < allowed, "{gap} at {p}");
            assert!(p > 0.0 || gap > -allowed);
            assert!(p < hardness || gap < allowed);
        }
        yielding.push(contact.plasticity().area);
    }
    // the load is shared by more and more nodes, until none yields
    assert!(yielding[0] > 0.0 && yielding[3] < yielding[0], "{yielding:?}");
}
