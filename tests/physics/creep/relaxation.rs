//! At a held gap the pressure relaxes by the same part everywhere, and the contact stays: `p(t) = p(0) E(t)/E_0` and
//! `p + eps = p(0)` are a solution of all conditions, for any contact.

use super::{fixed, problem, prony, rough, tight};
use crate::common::relative_l2;
use asperity::contact::{ContactModulus, Load, Multilevel, Problem};
use asperity::elastic::{Base, ElasticSolid, Layer, Prony};
use asperity::history::{Creep, CreepPath, CreepRule, CreepState, CreepSteps};
use asperity::{Grid, Indenter};
use std::sync::Arc;

/// The part of the pressure that is left at the end of equal steps, by the rule of constant pressure for numbers.
fn left(solid: &Prony, dt: f64, count: usize) -> f64 {
    let mut memory = vec![0.0; solid.terms().len()];
    let mut pressure = 1.0;
    for _ in 0..count {
        let terms = solid.terms().iter().map(|term| (term.ratio, (-dt / term.time).exp()));
        let kept: f64 = terms.clone().zip(&memory).map(|((_, e), eps)| e * eps).sum();
        pressure = (1.0 - kept) / (1.0 + terms.clone().map(|(f, e)| f * (1.0 - e)).sum::<f64>());
        memory = terms.zip(memory).map(|((f, e), eps)| e * eps + f * (1.0 - e) * pressure).collect();
    }
    pressure
}

fn check(states: &[CreepState], solid: &Prony, dt: f64) {
    let first = &states[0].contact;
    for (count, state) in states.iter().enumerate() {
        let part = left(solid, dt, count);
        let off = relative_l2(&state.contact.pressure, &first.pressure.mapv(|p| p * part));
        assert!(off < 1e-7, "{off} at {}", state.time);
        assert!(relative_l2(&state.effective_pressure(), &first.pressure) < 1e-8);
        assert_eq!(state.contact.mask(), first.mask());
        // the rule is of first order in the step
        let shortest = solid.to_relaxation().iter().map(|term| term.time).fold(f64::MAX, f64::min);
        assert!((part - solid.relaxation(state.time)).abs() < dt / shortest);
    }
}

#[test]
fn rough_contacts_at_a_held_mean_gap_relax_by_the_same_part_everywhere() {
    let solid = prony(&[[2.0, 1.0], [3.0, 0.2]]);
    for grid in [Grid::line(1024, 1.0).unwrap(), Grid::surface([64, 64], [1.0, 1.0]).unwrap()] {
        let problem = problem(rough(grid, 0.8, 2));
        let gap = Load::MeanGap(0.5 * problem.rms_height());
        check(&fixed(&problem, &solid, vec![(0.0, gap), (0.2, gap)], 10), &solid, 0.02);
    }
}

#[test]
fn a_sine_in_full_contact_on_a_layer_relaxes_at_a_held_approach() {
    let solid = prony(&[[9.0, 1.0]]);
    let layer: Arc<dyn ElasticSolid> =
        Layer { contact_modulus: 1.0, poisson: 0.3, thickness: 0.2, base: Base::Bonded }.into();
    let sine = Indenter::Sine { amplitude: 1e-3 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    let approach = Load::Approach(0.02);
    let problem = Problem::new(sine, layer, approach).unwrap();
    let states = fixed(&problem, &solid, vec![(0.0, approach), (1.0, approach)], 100);
    assert!(states[100].contact.pressure.iter().all(|&p| p > 0.0));
    check(&states, &solid, 0.01);
}

#[test]
fn a_free_sphere_at_a_held_approach_relaxes() {
    let solid = prony(&[[4.0, 1.0]]);
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
    let approach = Load::Approach(0.05);
    let problem = Problem::new(sphere, ContactModulus(1.0), approach).unwrap();
    check(&fixed(&problem, &solid, vec![(0.0, approach), (1.0, approach)], 20), &solid, 0.05);
}

#[test]
fn the_linear_rule_is_of_second_order() {
    let (solid, problem) = (prony(&[[4.0, 1.0]]), problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2)));
    let gap = Load::MeanGap(0.5 * problem.rms_height());
    let off = |count: usize| {
        let creep = Creep::new(problem.clone(), solid.clone()).with_rule(CreepRule::LinearPressure);
        // the first step is of first order, so it is short
        let dt = 1.0 / count as f64;
        let times = (0..=count).map(|i| dt * (dt + i as f64)).collect();
        let path = CreepPath::held(gap, 1.0).unwrap();
        let steps = CreepSteps::at_times(creep, path, times, &Multilevel, tight()).unwrap();
        let states: Vec<_> = steps.map(Result::unwrap).collect();
        let part = states.last().unwrap().contact.mean_pressure() / states[0].contact.mean_pressure();
        (part / solid.relaxation(1.0) - 1.0).abs()
    };
    let [coarse, fine] = [off(20), off(40)];
    assert!(coarse < 0.03 && coarse / fine > 3.0, "{coarse} and {fine}");
}

#[test]
fn surfaces_out_of_reach_do_not_touch_and_the_solid_recovers() {
    let (solid, problem) = (prony(&[[9.0, 1.0]]), problem(rough(Grid::line(512, 1.0).unwrap(), 0.8, 2)));
    let mut creep = Creep::new(problem.clone(), solid);
    let stop = tight();
    let [near, far] = [0.5 * problem.highest(), 2.0 * problem.highest()].map(Load::MeanGap);
    let mut step =
        |state: &CreepState, dt: f64, load| creep.step(state, dt, load, &Multilevel, &stop, &mut ()).unwrap();
    let rest = Creep::new(problem.clone(), prony(&[[9.0, 1.0]])).start();
    let pressed = step(&rest, 1.0, near);
    assert!(pressed.contact.mean_pressure() > 0.0);
    // just apart: the solid lies below where it was touched
    for load in [far, Load::MeanGap(0.99 * problem.highest()), Load::MeanPressure(0.0)] {
        let apart = step(&pressed, 0.5, load);
        assert!(apart.contact.is_converged() && apart.contact.mean_pressure() == 0.0, "{load}");
        assert!(apart.contact.gap.iter().all(|&gap| gap >= 0.0) && apart.error_bound() < 1e-3);
        let expected = pressed.memory[0].mapv(|eps| eps * (-0.5f64).exp());
        assert!(relative_l2(&apart.memory[0], &expected) < 1e-14);
        if let Load::MeanGap(gap) = load {
            assert!((apart.contact.mean_gap() / gap - 1.0).abs() < 1e-12);
        }
        let again = step(&apart, 0.1, near);
        assert!(again.contact.mean_pressure() > 0.0 && again.contact.is_converged());
    }
}
