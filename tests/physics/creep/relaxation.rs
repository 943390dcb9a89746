//! At a held gap the pressure relaxes by the same part everywhere, and the contact stays: `p(t) = p(0) E(t)/E_0` and
//! `p + eps = p(0)` are a solution of all conditions, for any contact.

use super::{fixed, problem, prony, rough, tight};
use crate::common::relative_l2;
use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Solver};
use asperity::elastic::{Base, ElasticSolid, Layer, Prony};
use asperity::history::{Creep, CreepState};
use asperity::{Grid, Indenter};
use std::sync::Arc;

fn check(states: &[CreepState], solid: &Prony) {
    let first = &states[0].contact;
    for state in states {
        let part = solid.relaxation(state.time);
        let off = relative_l2(&state.contact.pressure, &first.pressure.mapv(|p| p * part));
        assert!(off < 1e-7, "{off} at {}", state.time);
        assert!(relative_l2(state.effective_pressure(), &first.pressure) < 1e-8);
        assert_eq!(state.contact.mask(), first.mask());
    }
}

#[test]
fn rough_contacts_at_a_held_mean_gap_relax_by_the_same_part_everywhere() {
    let solid = prony(&[[2.0, 1.0], [3.0, 0.2]]);
    for grid in [Grid::line(1024, 1.0).unwrap(), Grid::surface([64, 64], [1.0, 1.0]).unwrap()] {
        let problem = problem(rough(grid, 0.8, 2));
        let gap = Load::MeanGap(0.5 * problem.rms_height());
        for count in [1, 10] {
            check(&fixed(&problem, &solid, vec![(0.0, gap), (2.0, gap)], count), &solid);
        }
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
    let states = fixed(&problem, &solid, vec![(0.0, approach), (1.0, approach)], 3);
    assert!(states[3].contact.pressure.iter().all(|&p| p > 0.0));
    check(&states, &solid);
}

#[test]
fn a_free_sphere_at_a_held_approach_relaxes() {
    let solid = prony(&[[4.0, 1.0]]);
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
    let approach = Load::Approach(0.05);
    let problem = Problem::new(sphere, ContactModulus(1.0), approach).unwrap();
    check(&fixed(&problem, &solid, vec![(0.0, approach), (1.0, approach)], 3), &solid);
}

/// A sphere that is pressed at a constant speed: `P(t) = int E(t - s) dP_e(s)` with the elastic `P_e ~ delta^(3/2)` (Ting, J. Appl. Mech. 33,
/// 845, 1966), here with the elastic forces of the same grid.
#[test]
fn a_sphere_pressed_at_a_constant_speed_meets_tings_integral_to_second_order() {
    let solid = prony(&[[4.0, 1.0], [2.0, 0.2]]);
    let grid = Grid::surface([32, 32], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
    let problem = Problem::new(sphere, ContactModulus(1.0), Load::Approach(0.05)).unwrap();
    let elastic = |approach: f64| {
        let problem = problem.clone().with_load(Load::Approach(approach)).unwrap();
        Multilevel.solve(&problem, &tight(), &mut ()).unwrap().mean_pressure()
    };
    // the midpoint rule in P_e
    let (count, end) = (400, 1.0);
    let forces: Vec<f64> =
        (0..=count).map(|i| if i == 0 { 0.0 } else { elastic(0.05 * f64::from(i) / f64::from(count)) }).collect();
    let age = |i: usize| end * (1.0 - (i as f64 + 0.5) / f64::from(count));
    let exact: f64 =
        forces.windows(2).enumerate().map(|(i, pair)| solid.relaxation(age(i)) * (pair[1] - pair[0])).sum();
    let path = vec![(0.0, Load::Approach(0.0)), (end, Load::Approach(0.05))];
    let off = |steps: usize| {
        let found = fixed(&problem, &solid, path.clone(), steps).last().unwrap().contact.mean_pressure();
        (found / exact - 1.0).abs()
    };
    let [coarse, fine] = [off(10), off(40)];
    assert!(coarse < 2e-2 && fine < 2e-3 && coarse > 6.0 * fine, "{coarse} {fine}");
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
    let strains = pressed.effective_pressure() - &pressed.contact.pressure;
    // just apart: the solid lies below where it was touched
    for load in [far, Load::MeanGap(0.99 * problem.highest()), Load::MeanPressure(0.0)] {
        let freed = step(&pressed, 0.0, load);
        assert!(relative_l2(freed.effective_pressure(), &strains) < 1e-12);
        let apart = step(&freed, 0.5, load);
        assert!(apart.contact.is_converged() && apart.contact.mean_pressure() == 0.0, "{load}");
        assert!(apart.contact.gap.iter().all(|&gap| gap >= 0.0) && apart.error_bound() < 1e-3);
        let expected = strains.mapv(|eps| eps * (-0.5f64).exp());
        assert!(relative_l2(apart.effective_pressure(), &expected) < 1e-12);
        if let Load::MeanGap(gap) = load {
            assert!((apart.contact.mean_gap() / gap - 1.0).abs() < 1e-12);
        }
        let again = step(&apart, 0.1, near);
        assert!(again.contact.mean_pressure() > 0.0 && again.contact.is_converged());
    }
}
