//! Energies of cycles, and the error in time.

use super::{fixed, problem, prony, rough, tight};
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

#[test]
fn steps_grow_under_a_held_load_and_end_at_its_points() {
    let solid = prony(&[[9.0, 1.0]]);
    let problem = problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2));
    let path = CreepPath::held(Load::ReducedPressure(0.02), 20.0).unwrap();
    let mut steps =
        CreepSteps::adaptive(Creep::new(problem.clone(), solid.clone()), path, 1e-2, &Multilevel, tight()).unwrap();
    let states: Vec<CreepState> = steps.by_ref().map(Result::unwrap).collect();
    assert_eq!((states[0].time, states.last().unwrap().time), (0.0, 20.0));
    // the first step is a twentieth of the shortest time, or less; none is longer than twice the one before
    let lengths: Vec<f64> = states.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
    assert!(lengths[0] <= 0.05 && lengths.windows(2).all(|pair| pair[1] <= 2.001 * pair[0]), "{lengths:?}");
    assert!(states.len() < 60 && states.iter().all(|state| state.time_error().unwrap() < 1e-2), "{}", states.len());
    // the effective pressure is exact in steps of any length
    let last = states.last().unwrap();
    let expected = 0.02 * problem.rms_gradient() * solid.creep(20.0);
    assert!((last.effective_pressure().mean().unwrap() / expected - 1.0).abs() < 1e-9);
}
