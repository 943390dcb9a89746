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
fn small_steps_from_the_last_states_cost_a_third_of_a_solve_from_nothing_on_lines_and_less_than_half_on_surfaces() {
    let line = (Grid::line(1 << 14, 1.0).unwrap(), [0.33, 0.56, 1.0]);
    let surface = (Grid::surface([512, 512], [1.0, 1.0]).unwrap(), [0.46, 0.65, 1.07]);
    for (grid, most) in [line, surface] {
        for is_ramp in [false, true] {
            // the load by which large steps differ is as good as another contact
            for (dt, most) in [0.0005, 0.005, 0.05].into_iter().zip(most) {
                // a ramp is followed through the step, so that its load is another one than that of a step under its last load
                let most = if is_ramp { 1.02 * most } else { most };
                let [warm, cold] = transforms(grid, dt, is_ramp);
                assert!(warm as f64 <= most * cold as f64, "{warm} against {cold} at {dt}");
            }
        }
    }
}

/// The memory is displaced without transforms.
#[test]
fn displacements_are_those_of_the_memory_and_the_pressure_after_many_steps() {
    for terms in [vec![[9.0, 1.0]], vec![[4.0, 0.3], [5.0, 2.0]]] {
        let problem = problem(rough(Grid::line(1 << 10, 1.0).unwrap(), 0.8, 3));
        let mut creep = Creep::new(problem.clone(), prony(&terms));
        let mut state = creep.start();
        // pressed, held apart, and at a given mean gap, whose displacement keeps the mean
        let gap = |times: f64| Load::MeanGap(times * problem.highest());
        let pressed = Load::ReducedPressure(0.02);
        for load in [pressed, Load::MeanPressure(0.0), gap(0.5), gap(2.0), pressed] {
            for dt in [0.0, 1e-3, 1e-3, 0.1] {
                state = creep.step(&state, dt, load, &Multilevel, &Stop::default(), &mut ()).unwrap();
                let mut expected = vec![0.0; problem.nodes()];
                let effective = state.effective_pressure().as_slice().unwrap();
                state.contact.problem.response().displacement(effective, &mut expected);
                let found = &state.contact.displacement;
                let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(error < 1e-12 * problem.rms_height(), "{error} under {load:?}");
            }
        }
    }
}

/// Beside each two steps goes one of twice the length: it starts from their states, as they start from its end.
#[test]
fn the_estimate_of_the_error_in_time_costs_half_as_much_as_the_steps() {
    for grid in [Grid::line(1 << 12, 1.0).unwrap(), Grid::surface([128, 128], [1.0, 1.0]).unwrap()] {
        let problem = problem(rough(grid, 0.8, 3));
        let path = || CreepPath::held(Load::ReducedPressure(0.02), 10.0).unwrap();
        let creep = || Creep::new(problem.clone(), prony(&[[9.0, 1.0]]));
        let mut steps = CreepSteps::adaptive(creep(), path(), 1e-2, &Multilevel, Stop::default()).unwrap();
        let times: Vec<f64> = steps.by_ref().map(|state| state.unwrap().time).collect();
        // the same steps without an estimate
        let halves = times.windows(2).flat_map(|pair| [0.5 * (pair[0] + pair[1]), pair[1]]).collect();
        let mut given = CreepSteps::at_times(creep(), path(), halves, &Multilevel, Stop::default()).unwrap();
        given.by_ref().for_each(|state| assert!(state.unwrap().contact.is_converged()));
        let [with, without] = [steps.transforms(), given.transforms()];
        println!("{:?}: {} states, {} repeated, {with} against {without}", grid.shape(), times.len(), steps.rejected());
        let repeated = 1.0 + steps.rejected() as f64 / times.len() as f64;
        assert!(with as f64 <= 1.5 * repeated * without as f64, "{with} against {without}");
    }
}
