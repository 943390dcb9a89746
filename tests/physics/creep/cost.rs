//! What a step costs from the last state, in transforms.

use super::{problem, prony, rough};
use asperity::Grid;
use asperity::contact::{Load, Multilevel, Solver, Stop};
use asperity::history::{Creep, CreepPath, CreepSteps};

/// Transforms of eight steps, and of eight elastic contacts from nothing under their effective loads.
fn transforms(grid: Grid, dt: f64, is_ramp: bool) -> [u64; 2] {
    let (problem, stop) = (problem(rough(grid, 0.8, 3)), Stop::default());
    let mut creep = Creep::new(problem.clone(), prony(&[[9.0, 1.0]]));
    let load = |i: usize| Load::ReducedPressure(if is_ramp { 0.02 * (1.0 + 2.0 * dt * i as f64) } else { 0.02 });
    let mut state = creep.step(&creep.start(), 0.0, load(0), &Multilevel, &stop, &mut ()).unwrap();
    let [mut warm, mut cold] = [0, 0];
    for i in 1..=8 {
        state = creep.step(&state, dt, load(i), &Multilevel, &stop, &mut ()).unwrap();
        warm += state.contact.work.transforms;
        let effective = Load::MeanPressure(state.effective_pressure().mean().unwrap());
        let problem = problem.clone().with_load(effective).unwrap();
        cold += Multilevel.solve(&problem, &stop, &mut ()).unwrap().work.transforms;
    }
    println!("{:?} dt {dt} ramp {is_ramp}: {warm} against {cold}", grid.shape());
    [warm, cold]
}

#[test]
fn small_steps_from_the_last_state_cost_half_of_a_solve_from_nothing() {
    for grid in [Grid::line(1 << 14, 1.0).unwrap(), Grid::surface([512, 512], [1.0, 1.0]).unwrap()] {
        for is_ramp in [false, true] {
            // the memory adds a pair to each step; large steps are as good as solves from nothing
            let [warm, cold] = transforms(grid, 0.05, is_ramp);
            assert!(warm as f64 <= 1.15 * cold as f64, "{warm} against {cold}");
            let [warm, cold] = transforms(grid, 0.0005, is_ramp);
            assert!(warm as f64 <= 0.62 * cold as f64, "{warm} against {cold}");
        }
    }
}

/// Steps are doubled to control their error: the whole step tells the halves where to start.
#[test]
fn second_halves_of_adaptive_steps_under_a_held_load_cost_a_pair_or_two() {
    for grid in [Grid::line(1 << 14, 1.0).unwrap(), Grid::surface([512, 512], [1.0, 1.0]).unwrap()] {
        let creep = Creep::new(problem(rough(grid, 0.8, 3)), prony(&[[9.0, 1.0]]));
        let path = CreepPath::held(Load::ReducedPressure(0.02), 10.0).unwrap();
        let mut steps = CreepSteps::adaptive(creep, path, 1e-3, &Multilevel, Stop::default()).unwrap();
        let counts: Vec<u64> = steps.by_ref().map(|state| state.unwrap().contact.work.transforms).collect();
        println!("{:?}: {counts:?}, {} in all", grid.shape(), steps.transforms());
        let cold = counts[0];
        let halves: Vec<u64> = counts[2..].iter().copied().step_by(2).collect();
        assert!(halves.iter().all(|&count| 3 * count < cold), "{counts:?}");
        // of each step, the whole one, the first half and the second one
        let solves = 1 + 3 * halves.len() as u64;
        assert!(steps.transforms() as f64 <= 0.8 * (cold * solves) as f64, "{} in {solves} solves", steps.transforms());
    }
}
