//! Layers in every drive: a uniform pressure displaces a layer by `c P` with `c = t (1 + nu)(1 - 2 nu)/(E (1 - nu))`, whatever displaces it.

use asperity::adhesion::{AdhesiveMethod, AdhesiveProblem, Attraction, AttractionForm};
use asperity::contact::{
    Contact, ContactModulus, Load, MonotoneSets, Multilevel, Problem, Quantity, Solver, State, Stop,
};
use asperity::elastic::{Base, Layer, Prony, PronyTerm};
use asperity::history::{AdhesiveProcess, Creep, CreepPath, CreepSteps, PathPoint, Process, cycle_losses};
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Surface};

const THICKNESS: f64 = 0.2;
const POISSON: f64 = 0.3;

/// A layer of Young's modulus 1 and the compliance of a uniform pressure in closed form.
fn layer() -> (Layer, f64) {
    let contact_modulus = 1.0 / (1.0 - POISSON * POISSON);
    let compliance = THICKNESS * (1.0 + POISSON) * (1.0 - 2.0 * POISSON) / (1.0 - POISSON);
    (Layer { contact_modulus, poisson: POISSON, thickness: THICKNESS, base: Base::Bonded }, compliance)
}

fn rough(seed: u64) -> Surface {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.5, short_cutoff: 0.1, rms_gradient: 0.05 };
    Surface::rough(Grid::line(128, 1.0).unwrap(), &spectrum, seed).unwrap()
}

fn problem(surface: Surface, load: Load) -> Problem {
    Problem::new(surface, layer().0, load).unwrap()
}

fn tight() -> Stop {
    Stop::new(1e-12, 20_000).unwrap()
}

fn solved(problem: &Problem) -> Contact {
    Multilevel.solve(problem, &tight(), &mut ()).unwrap().converged().unwrap()
}

fn is_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < tolerance, "{what}: {found} for {expected}");
}

/// The approach by the mean gap, which no uniform displacement enters, and by what displaces uniformly.
fn approach(contact: &Contact, pressure: f64) -> f64 {
    contact.problem.highest() - contact.mean_gap() + layer().1 * pressure
}

/// Loads rise, fall to zero and rise: `<p_e> = P + sum eps`, `tau eps' + eps = f P` between the points.
#[test]
fn what_a_layer_remembers_displaces_it_as_well() {
    let terms = [[4.0, 1.0], [0.7, 0.1]];
    let prony = Prony::new(terms.map(|[ratio, time]| PronyTerm { ratio, time }).to_vec()).unwrap();
    let points = [[0.0, 2e-3], [0.5, 5e-3], [1.5, 0.0], [2.0, 0.0], [3.0, 3e-3]];
    let path = points.map(|[time, load]| (time, Load::MeanPressure(load)));
    let problem = problem(rough(1), Load::MeanPressure(2e-3));
    let creep = Creep::new(problem.clone(), prony);
    let steps = CreepSteps::fixed(creep, CreepPath::new(path.to_vec()).unwrap(), 40, &Multilevel, tight()).unwrap();
    let (mut strains, mut before) = ([0.0; 2], points[0]);
    for state in steps.map(Result::unwrap) {
        let now = [state.time, state.contact.mean_pressure()];
        let (dt, from, slope) = (now[0] - before[0], before[1], (now[1] - before[1]) / (now[0] - before[0]));
        for (strain, [ratio, time]) in strains.iter_mut().zip(terms).filter(|_| dt > 0.0) {
            let follows = |s: f64| ratio * (from + slope * (s - time));
            *strain = follows(dt) + (*strain - follows(0.0)) * (-dt / time).exp();
        }
        before = now;
        // steps in which the mean effective pressure turns have an error
        let expected = approach(&state.contact, now[1] + strains.iter().sum::<f64>());
        let found = state.contact.approach().unwrap();
        assert!(
            (found - expected).abs() < 2e-3 * state.contact.problem.highest(),
            "{found} for {expected} at {}",
            state.time
        );
        let effective = state.effective_pressure().mean().unwrap();
        assert!((found - approach(&state.contact, effective)).abs() < 1e-12 * state.contact.problem.highest());
        let told = state.into_state(None);
        assert_eq!(told.value(Quantity::Approach), found);
        assert_eq!(told.value(Quantity::ReducedPressure) == 0.0, now[1] == 0.0, "{now:?}");
    }
}

/// A slow slide is the contact of the relaxed solid, whose approach and energy an elastic solve gives; any other is the same under its approach.
#[test]
fn a_contact_that_slides_has_the_approach_under_which_it_is_the_same() {
    let (surface, load) = (rough(2), Load::MeanPressure(2e-3));
    let slide = |load, speed| {
        let problem = problem(surface.clone(), load).sliding(speed, &[(4.0, 1.0)]).unwrap();
        MonotoneSets.solve(&problem, &tight(), &mut ()).unwrap().converged().unwrap()
    };
    let relaxed = Layer { contact_modulus: layer().0.contact_modulus / 5.0, ..layer().0 };
    let relaxed = solved(&Problem::new(surface.clone(), relaxed, load).unwrap());
    let slow = slide(load, 1e-12);
    is_near(slow.approach().unwrap(), relaxed.approach().unwrap(), 1e-6, "approach");
    is_near(slow.elastic_energy(), relaxed.elastic_energy(), 1e-6, "energy");
    for speed in [0.03, 0.5, 20.0] {
        let pressed = slide(load, speed);
        is_near(pressed.approach().unwrap(), approach(&pressed, 5.0 * pressed.mean_pressure()), 1e-9, "closed form");
        let moved = slide(Load::Approach(pressed.approach().unwrap()), speed);
        is_near(moved.mean_pressure(), pressed.mean_pressure(), 1e-6, "pressure");
        is_near(moved.elastic_energy(), pressed.elastic_energy(), 1e-6, "energy");
    }
}

/// The states of a branch under loads, at the mean gaps and at the approaches of its ends.
#[test]
fn a_branch_with_adhesion_stores_and_takes_the_same_however_it_is_driven() {
    let attraction = || Attraction::new(AttractionForm::Exponential, 2e-5, 6e-3).unwrap();
    let path = |ends: [Load; 2]| {
        let problem = AdhesiveProblem::new(problem(rough(3), Load::MeanPressure(1e-3)), attraction()).unwrap();
        let points = ends.map(PathPoint::under).to_vec();
        let mut states: Vec<State> = Vec::new();
        let mut process = AdhesiveProcess::new(problem, points, 4, AdhesiveMethod::Fast, tight());
        process
            .run(&mut (), &mut |state| {
                states.push(state);
                Ok(())
            })
            .unwrap();
        states
    };
    let pressed = path([5e-3, 15e-3].map(Load::MeanPressure));
    let ends = [&pressed[0], &pressed[pressed.len() - 1]];
    for state in ends {
        let net = state.value(Quantity::MeanPressure);
        is_near(state.value(Quantity::Approach), approach(&state.contact, net), 1e-9, "approach");
    }
    let lost = |states: &[State]| states[states.len() - 1].value(Quantity::Dissipated);
    assert_eq!(lost(&pressed), 0.0);
    let by_approach = path(ends.map(|state| Load::Approach(state.value(Quantity::Approach))));
    let by_gap = path(ends.map(|state| Load::MeanGap(state.contact.mean_gap())));
    let last = &pressed[pressed.len() - 1];
    for (name, other) in [("approach", by_approach), ("mean gap", by_gap)] {
        let reached = &other[other.len() - 1];
        is_near(reached.value(Quantity::MeanPressure), last.value(Quantity::MeanPressure), 1e-5, name);
        for quantity in [Quantity::Stored, Quantity::WorkDone, Quantity::Approach] {
            is_near(reached.value(quantity), last.value(quantity), 1e-5, &format!("{} at a {name}", quantity.name()));
        }
        assert_eq!(lost(&other), 0.0, "{name}");
    }
    // the work is that of the load on its way, by the trapezium rule
    let pairs = pressed.windows(2).map(|pair| [&pair[0], &pair[1]]);
    let work: f64 = pairs
        .map(|pair| {
            let [[p0, d0], [p1, d1]] = pair.map(|it| [it.value(Quantity::MeanPressure), it.value(Quantity::Approach)]);
            0.5 * (p0 + p1) * (d1 - d0)
        })
        .sum();
    is_near(last.value(Quantity::WorkDone), work, 0.03, "work");
}

/// In full contact only the uniform mode of a layer moves. A slow cycle of a load between `P - S` and `P + S` in time `T` each way loses
/// `2 c f k^2 T (1 - (2 tau/T) tanh(T/2 tau))` with the rate `k = 2 S/T` times `tau`, from `tau eps' + eps = f P`. The way from the sudden first load is none.
#[test]
fn only_cycles_that_close_are_told() {
    let (ratio, tau, period): (f64, f64, f64) = (4.0, 1.0, 12.0);
    let (low, high) = (2e-3, 1e-2);
    let surface = Indenter::Sine { amplitude: 1e-6 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let prony = Prony::new(vec![PronyTerm { ratio, time: tau }]).unwrap();
    let loads = [low, high, low, high, low, high];
    let points: Vec<(f64, Load)> =
        loads.iter().enumerate().map(|(i, load)| (period * i as f64, Load::MeanPressure(*load))).collect();
    let creep = Creep::new(problem(surface, Load::MeanPressure(low)), prony);
    let path = CreepPath::new(points.clone()).unwrap();
    let steps = CreepSteps::adaptive(creep, path, 1e-3, &Multilevel, tight()).unwrap();
    let states: Vec<State> = steps
        .map(|state| {
            let state = state.unwrap();
            let point = points.iter().position(|(time, _)| *time == state.time);
            state.into_state(point)
        })
        .collect();
    let path: Vec<PathPoint> =
        points.iter().map(|(time, load)| PathPoint { time: Some(*time), ..PathPoint::under(*load) }).collect();
    let losses = cycle_losses(&path, &states);
    let rate = (high - low) / period;
    let exact =
        2.0 * layer().1 * ratio * rate * rate * tau * period * (1.0 - 2.0 * tau / period * (0.5 * period / tau).tanh());
    assert_eq!(losses.len(), 2, "{losses:?}");
    for loss in losses {
        is_near(loss.energy, exact, 1e-3, "a cycle");
        let told = loss.error.unwrap();
        // steps along straight loads are exact in full contact, but for rounding
        let off = (loss.energy - exact).abs();
        assert!(off <= told.max(1e-9 * exact) && told < 1e-2 * exact, "{off:e} off, {told:e} told");
    }
}

/// The error of the loss of a slow cycle covers what much shorter steps change of it. Twice as long steps lose more on one way and less on the other,
/// so that the difference at the ends of the cycle is too small.
#[test]
fn the_error_of_the_loss_of_a_cycle_covers_what_shorter_steps_change() {
    let surface = Indenter::Sine { amplitude: 0.01 }.surface(Grid::line(128, 1.0).unwrap()).unwrap();
    let prony = Prony::new(vec![PronyTerm { ratio: 9.0, time: 1.0 }]).unwrap();
    let loads = [2e-4, 1e-3, 2e-4, 1e-3, 2e-4].map(Load::MeanPressure);
    let points: Vec<(f64, Load)> = loads.into_iter().enumerate().map(|(i, load)| (30.0 * i as f64, load)).collect();
    let losses = |tolerance: f64| {
        let problem = Problem::new(surface.clone(), ContactModulus(4.0 / 3.0), loads[0]).unwrap();
        let creep = Creep::new(problem, prony.clone());
        let path = CreepPath::new(points.clone()).unwrap();
        let steps = CreepSteps::adaptive(creep, path, tolerance, &Multilevel, tight()).unwrap();
        let states: Vec<State> = steps
            .map(|state| {
                let state = state.unwrap();
                let point = points.iter().position(|(time, _)| *time == state.time);
                state.into_state(point)
            })
            .collect();
        let path = points.iter().map(|(time, load)| PathPoint { time: Some(*time), ..PathPoint::under(*load) });
        cycle_losses(&path.collect::<Vec<_>>(), &states)
    };
    let exact = losses(1e-4);
    for tolerance in [1e-2, 3e-3, 1e-3] {
        let found = losses(tolerance);
        assert_eq!(found.len(), exact.len());
        for (found, exact) in found.iter().zip(&exact) {
            let (off, told) = ((found.energy - exact.energy).abs(), found.error.unwrap());
            assert!(
                off <= told && told < 0.15 * exact.energy,
                "{tolerance}: {off:e} off, {told:e} told, of {:e}",
                exact.energy
            );
        }
    }
}
