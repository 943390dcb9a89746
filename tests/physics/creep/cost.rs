//! What a step costs from the last state, in transforms.

use super::{problem, prony, rough};
use asperity::Grid;
use asperity::contact::{Load, Multilevel, Solver, Stop};
use asperity::history::{Creep, CreepPath, CreepRule, CreepSteps};

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
fn small_steps_from_the_last_states_cost_a_third_of_a_solve_from_nothing_on_lines_and_less_than_half_on_surfaces() {
    let line = (Grid::line(1 << 14, 1.0).unwrap(), [0.33, 0.56, 1.0]);
    let surface = (Grid::surface([512, 512], [1.0, 1.0]).unwrap(), [0.46, 0.65, 1.07]);
    for (grid, most) in [line, surface] {
        for is_ramp in [false, true] {
            // the load by which large steps differ is as good as another contact
            for (dt, most) in [0.0005, 0.005, 0.05].into_iter().zip(most) {
                let [warm, cold] = transforms(grid, dt, is_ramp);
                assert!(warm as f64 <= most * cold as f64, "{warm} against {cold} at {dt}");
            }
        }
    }
}

/// Under the rule of constant pressure the memory of a single term is displaced without transforms.
#[test]
fn displacements_are_those_of_the_memory_and_the_pressure_after_many_steps() {
    for terms in [vec![[9.0, 1.0]], vec![[4.0, 0.3], [5.0, 2.0]]] {
        for rule in [CreepRule::ConstantPressure, CreepRule::LinearPressure] {
            let problem = problem(rough(Grid::line(1 << 10, 1.0).unwrap(), 0.8, 3));
            let mut creep = Creep::new(problem.clone(), prony(&terms)).with_rule(rule);
            let mut state = creep.start();
            // pressed, held apart, and at a given mean gap, whose displacement keeps the mean
            let gap = |times: f64| Load::MeanGap(times * problem.highest());
            let pressed = Load::ReducedPressure(0.02);
            for load in [pressed, Load::MeanPressure(0.0), gap(0.5), gap(2.0), pressed] {
                for dt in [0.0, 1e-3, 1e-3, 0.1] {
                    state = creep.step(&state, dt, load, &Multilevel, &Stop::default(), &mut ()).unwrap();
                    let mut expected = vec![0.0; problem.nodes()];
                    let effective = state.effective_pressure().into_raw_vec_and_offset().0;
                    state.contact.problem.response().displacement(&effective, &mut expected);
                    let found = &state.contact.displacement;
                    let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(error < 1e-12 * problem.rms_height(), "{error} under {load:?}");
                }
            }
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
