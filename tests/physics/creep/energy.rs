//! Energies of cycles, and the error in time.

use super::{fixed, problem, prony, rough, tight};
use crate::common::relative_l2;
use asperity::contact::{ContactModulus, Load, Multilevel, Problem};
use asperity::elastic::{Base, ElasticSolid, Layer};
use asperity::history::{Creep, CreepPath, CreepState, CreepSteps};
use asperity::{Grid, Indenter};
use std::sync::Arc;

/// Pressed, held, released, and left alone until nothing is remembered.
fn cycle(load: impl Fn(f64) -> Load, value: f64) -> Vec<(f64, Load)> {
    [(0.0, 0.0), (1.0, 1.0), (1.5, 1.0), (2.5, 0.0), (40.0, 0.0)].map(|(t, part)| (t, load(part * value))).to_vec()
}

/// The relative difference of work and loss over the cycle.
fn off(problem: &Problem, path: &[(f64, Load)], count: usize) -> f64 {
    let states = fixed(problem, &prony(&[[3.0, 1.0], [1.0, 0.1]]), path.to_vec(), count);
    let energy = states.last().unwrap().energy;
    assert!(energy.stored < 1e-12 * energy.lost, "{energy:?}");
    assert!(states.windows(2).all(|pair| pair[1].energy.lost >= pair[0].energy.lost));
    energy.work / energy.lost - 1.0
}

#[test]
fn the_work_of_a_closed_cycle_is_what_the_dashpots_take_up() {
    let rough = problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2));
    let layer: Arc<dyn ElasticSolid> =
        Layer { contact_modulus: 1.0, poisson: 0.3, thickness: 0.2, base: Base::Bonded }.into();
    let sine = Indenter::Sine { amplitude: 1e-3 }.surface(Grid::line(128, 1.0).unwrap()).unwrap();
    let layered = Problem::new(sine, layer, Load::Approach(1e-3)).unwrap();
    let free = Grid::surface([24, 24], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(free).unwrap();
    let sphere = Problem::new(sphere, ContactModulus(1.0), Load::Force(1e-3)).unwrap();
    let gap = |part: f64| Load::MeanGap(rough.highest() * (1.0 - 0.6 * part));
    for (name, problem, path) in [
        ("pressure", &rough, cycle(Load::ReducedPressure, 0.05)),
        ("gap", &rough, cycle(gap, 1.0)),
        ("approach", &layered, cycle(Load::Approach, 2e-3)),
        ("pressure on a layer", &layered, cycle(Load::MeanPressure, 5e-3)),
        ("force", &sphere, cycle(Load::Force, 1e-3)),
    ] {
        let [coarse, fine] = [40, 160].map(|count| off(problem, &path, count));
        assert!(coarse.abs() < 0.1 && fine.abs() < 0.4 * coarse.abs() && fine.abs() < 0.03, "{name}: {coarse} {fine}");
    }
}

/// Against a history whose steps are a twentieth.
#[test]
fn the_error_in_time_is_estimated_honestly() {
    let solid = prony(&[[9.0, 1.0], [1.0, 10.0]]);
    let problem = problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2));
    let load = |part: f64| Load::ReducedPressure(0.03 * part);
    let path = CreepPath::new(vec![(0.0, load(0.5)), (1.0, load(1.0)), (2.0, load(0.3)), (5.0, load(0.3))]).unwrap();
    let creep = || Creep::new(problem.clone(), solid.clone());
    let mut found = Vec::new();
    for tolerance in [1e-2, 1e-3] {
        let steps = CreepSteps::adaptive(creep(), path.clone(), tolerance, &Multilevel, tight()).unwrap();
        let states: Vec<CreepState> = steps.map(Result::unwrap).collect();
        let times: Vec<f64> = states.iter().map(|state| state.time).collect();
        let finer = times
            .windows(2)
            .flat_map(|t| (1..=20).map(|i| t[0] + (t[1] - t[0]) * f64::from(i) / 20.0).collect::<Vec<_>>());
        let finer = CreepSteps::at_times(creep(), path.clone(), finer.collect(), &Multilevel, tight()).unwrap();
        let exact: Vec<CreepState> = finer.map(Result::unwrap).collect();
        let mut largest = [0.0f64; 2];
        for state in &states[1..] {
            let exact = exact.iter().min_by(|a, b| (a.time - state.time).abs().total_cmp(&(b.time - state.time).abs()));
            let off = relative_l2(&state.effective_pressure(), &exact.unwrap().effective_pressure());
            assert!(off < 1.5 * state.time_error + 1e-6, "{off} against {} at {}", state.time_error, state.time);
            largest = [largest[0].max(off), largest[1].max(state.time_error)];
        }
        assert!(states.iter().any(|state| state.time == 1.0) && states.iter().any(|state| state.time == 2.0));
        // it is not idly large either
        assert!(largest[1] < 20.0 * largest[0], "{largest:?}");
        found.push((states.len(), largest[0]));
    }
    assert!(found[1].1 < 0.6 * found[0].1 && found[1].0 > found[0].0, "{found:?}");
}

#[test]
fn steps_grow_under_a_held_load_and_end_at_its_points() {
    let solid = prony(&[[9.0, 1.0]]);
    let problem = problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2));
    let path = CreepPath::held(Load::ReducedPressure(0.02), 20.0).unwrap();
    let mut steps = CreepSteps::adaptive(Creep::new(problem, solid.clone()), path, 1e-3, &Multilevel, tight()).unwrap();
    let states: Vec<CreepState> = steps.by_ref().map(Result::unwrap).collect();
    assert_eq!((states[0].time, states[2].time), (0.0, 0.05));
    assert_eq!(states.last().unwrap().time, 20.0);
    // steps of any length are exact here, so that each doubles
    assert!(states.len() < 25 && steps.rejected() == 0, "{}", states.len());
    assert!(states.iter().all(|state| state.time_error < 1e-6));
}
