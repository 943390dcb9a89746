//! Under a load that never falls, the effective pressure is the pressure of the elastic contact under the load `int J dP` (Lee &
//! Radok, J. Appl. Mech. 27, 438, 1960), on rough surfaces as on smooth ones, for steps of any length.

use super::{fixed, problem, prony, rough, tight};
use crate::common::relative_l2;
use asperity::contact::{Contact, Load, Multilevel, Problem, Solver};
use asperity::elastic::Prony;
use asperity::history::{Creep, CreepState};
use asperity::{Grid, Indenter};
use std::f64::consts::PI;

fn elastic(problem: &Problem, mean_pressure: f64) -> Contact {
    let problem = problem.clone().with_load(Load::MeanPressure(mean_pressure)).unwrap();
    Multilevel.solve(&problem, &tight(), &mut ()).unwrap()
}

/// The state has the elastic contact under `mean_pressure` for its effective pressure.
fn check(state: &CreepState, problem: &Problem, mean_pressure: f64, tolerance: f64) {
    let (effective, elastic) = (state.effective_pressure(), elastic(problem, mean_pressure));
    let off = relative_l2(effective, &elastic.pressure);
    assert!(off < tolerance, "{off} at {}", state.time);
    assert_eq!(state.contact.mask(), elastic.mask(), "nodes differ at {}", state.time);
    assert!(relative_l2(&state.contact.gap, &elastic.gap) < tolerance.max(1e-8));
    let (resolved, expected) = (state.resolved(), elastic.resolved());
    assert!((resolved.relative_area / expected.relative_area - 1.0).abs() < 1e-6);
    assert!((resolved.kappa_r / expected.kappa_r - 1.0).abs() < 1e-6);
    // the bound is one, and small
    assert!(state.error_bound() < 1e-4, "{}", state.error_bound());
}

fn grids() -> [Grid; 2] {
    [Grid::line(4096, 1.0).unwrap(), Grid::surface([128, 128], [1.0, 1.0]).unwrap()]
}

#[test]
fn a_rough_contact_under_a_held_load_is_elastic_under_a_growing_one() {
    for solid in [prony(&[[9.0, 1.0]]), prony(&[[2.0, 0.5], [7.0, 3.0]])] {
        for (grid, hurst) in [(grids()[0], 0.2), (grids()[0], 0.8), (grids()[1], 0.8)] {
            let problem = problem(rough(grid, hurst, 3));
            let load = 0.01 * problem.rms_gradient();
            for count in [2, 4, 20] {
                let states = fixed(&problem, &solid, held(load, 2.0), count);
                assert_eq!(states.len(), count + 1);
                for state in [&states[0], &states[1], &states[count / 2], &states[count]] {
                    check(state, &problem, load * solid.creep(state.time), 1e-9);
                }
            }
        }
    }
}

fn held(load: f64, time: f64) -> Vec<(f64, Load)> {
    vec![(0.0, Load::MeanPressure(load)), (time, Load::MeanPressure(load))]
}

/// `int J(t - s) ds` over a part of the past.
fn integrated_creep(solid: &Prony, now: f64, [from, to]: [f64; 2]) -> f64 {
    let term = |it: &asperity::elastic::PronyTerm| {
        let left = |time: f64| ((time - now) / it.time).exp();
        it.ratio * ((to - from) - it.time * (left(to) - left(from)))
    };
    (to - from) + solid.terms().iter().map(term).sum::<f64>()
}

#[test]
fn ramps_of_a_growing_load_add_up_by_the_age_of_each() {
    for solid in [prony(&[[9.0, 1.0]]), prony(&[[3.0, 0.05], [6.0, 2.0]])] {
        for grid in grids() {
            let problem = problem(rough(grid, 0.8, 4));
            let load = 0.005 * problem.rms_gradient();
            let mut creep = Creep::new(problem.clone(), solid.clone());
            let (mut state, mut ramps) = (creep.start(), Vec::new());
            let mut now = 0.0;
            for (dt, growth) in [(0.1, 1.0), (1.0, 0.5), (0.3, 0.0), (0.01, 2.0), (3.0, 0.7)] {
                now += growth * load;
                let from = state.time;
                state = creep.step(&state, dt, Load::MeanPressure(now), &Multilevel, &tight(), &mut ()).unwrap();
                ramps.push(([from, state.time], growth * load / dt));
                let effective: f64 =
                    ramps.iter().map(|(span, rate)| rate * integrated_creep(&solid, state.time, *span)).sum();
                check(&state, &problem, effective, 1e-9);
                assert!((state.effective_modulus() * effective / now - 1.0).abs() < 1e-9);
            }
        }
    }
}

/// Half-width or radius in units of the cell, from the resolved area.
fn sizes(problem: &Problem, solid: &Prony, load: f64, size: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let states = fixed(problem, solid, held(load, 2.0), 4);
    states.iter().map(|state| (state.time, size(state.resolved().relative_area))).collect()
}

#[test]
fn a_cylinder_and_a_sphere_sink_in_as_the_compliance_grows() {
    let solid = prony(&[[9.0, 1.0]]);
    let line = Indenter::Cylinder { radius: 1.0 }.surface(Grid::line(4096, 2.0).unwrap()).unwrap();
    let load = 2e-5;
    for (time, a) in sizes(&problem(line), &solid, load, |area| area) {
        // a^2 = (4R/pi) P J, with the force P on a cell of length 2, half-width a
        let expected = (4.0 / PI * 2.0 * load * solid.creep(time)).sqrt();
        assert!((a / expected - 1.0).abs() < 3e-3, "{a} against {expected} at {time}");
    }
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([256, 256], [1.0, 1.0]).unwrap()).unwrap();
    let load = 1e-4;
    for (time, a) in sizes(&problem(sphere), &solid, load, |area| (area / PI).sqrt()) {
        let expected = (0.75 * load * solid.creep(time)).cbrt();
        assert!((a / expected - 1.0).abs() < 1e-2, "{a} against {expected} at {time}");
    }
}
