//! Contacts that recede and grow again: what nodes remember of the larger contact decays, and does not touch.

use super::prony;
use asperity::contact::{ContactModulus, Load, Multilevel, Solver, Stop};
use asperity::history::{Creep, CreepPath, CreepSteps};
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Problem, Surface};

const RATIO: f64 = 4.0;
const TAU: f64 = 0.1;
const TIME: f64 = 10.0;

/// In a slow cycle the solid is the relaxed one under the load of a moment ago: `u = C0 (P + eps)` with `tau eps' + eps = f P` is
/// `C0 (1 + f) P(t - tau f/(1 + f))` but for what falls as `exp(-t/tau)`. The contact is that of an elastic solve.
fn is_that_of_the_relaxed_solid(surface: &Surface, low: f64, high: f64) {
    let problem = |modulus: f64, load: f64| {
        Problem::new(surface.clone(), ContactModulus(modulus), Load::MeanPressure(load)).unwrap()
    };
    let stop = Stop::new(1e-8, 20_000).unwrap();
    let creep = Creep::new(problem(1.0, low), prony(&[[RATIO, TAU]]));
    let points =
        [low, high, low, high].into_iter().enumerate().map(|(i, load)| (TIME * i as f64, Load::MeanPressure(load)));
    let steps =
        CreepSteps::adaptive(creep, CreepPath::new(points.collect()).unwrap(), 1e-2, &Multilevel, stop).unwrap();
    let rate = (high - low) / TIME;
    let mut compared = 0;
    for state in steps.map(Result::unwrap).filter(|state| state.time > 2.0 * TIME + 8.0 * TAU) {
        let load = low + rate * (state.time - 2.0 * TIME - TAU * RATIO / (1.0 + RATIO));
        let elastic =
            Multilevel.solve(&problem(1.0 / (1.0 + RATIO), load), &stop, &mut ()).unwrap().converged().unwrap();
        let touching = |contact: &asperity::Contact| contact.pressure.iter().filter(|p| **p > 0.0).count() as f64;
        let (found, expected) = (touching(&state.contact), touching(&elastic));
        assert!(
            (found - expected).abs() <= 3.0 + 0.04 * expected,
            "t = {}: {found} nodes touch, not {expected}",
            state.time
        );
        let [area, exact] = [state.resolved().relative_area, elastic.resolved().relative_area];
        assert!((area / exact - 1.0).abs() < 0.05, "t = {}: area {area}, not {exact}", state.time);
        compared += 1;
    }
    assert!(compared > 12, "{compared}");
}

#[test]
fn a_cylinder_that_was_pressed_harder_touches_where_it_touches_now() {
    let cylinder = Indenter::Cylinder { radius: 5.0 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    is_that_of_the_relaxed_solid(&cylinder, 6e-5, 6e-3);
}

#[test]
fn a_sphere_that_was_pressed_harder_touches_where_it_touches_now() {
    let grid = Grid::surface([48, 48], [1.0, 1.0]).unwrap();
    let sphere = Indenter::Sphere { radius: 5.0 }.surface(grid).unwrap();
    is_that_of_the_relaxed_solid(&sphere, 1e-5, 5e-4);
}

#[test]
fn a_rough_line_that_was_pressed_harder_touches_where_it_touches_now() {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.06, rms_gradient: 0.05 };
    let rough = Surface::rough(Grid::line(512, 1.0).unwrap(), &spectrum, 4).unwrap();
    is_that_of_the_relaxed_solid(&rough, 1e-4, 5e-3);
}
