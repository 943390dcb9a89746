//! Partial slip of lines with a history, against Cattaneo and Mindlin, and Masing's rule.

use asperity::contact::{ContactModulus, Load, Multilevel, PolonskyKeer, Problem, Solver, Stop};
use asperity::error::SlipError;
use asperity::history::{SlipHistory, SlipState, Zone};
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Surface};
use std::f64::consts::PI;

const MU: f64 = 0.3;

fn stop(tolerance: f64) -> Stop {
    Stop::new(tolerance, 100_000).unwrap()
}

/// A cylinder with a contact of the half-width 1 on a free line of 2.4, as in the closed forms.
struct Cylinder {
    problem: Problem,
    load: Load,
    /// The force per length, which is the mean pressure times the length.
    force: f64,
    length: f64,
}

impl Cylinder {
    fn new(points: usize) -> Self {
        let (radius, length) = (4.0, 2.4 * points as f64 / (points - 1) as f64);
        let force = PI / (4.0 * radius);
        let grid = Grid::line(points, length).unwrap().with_periodic([false; 2]);
        let load = Load::Force(force);
        let surface = Indenter::Cylinder { radius }.surface(grid).unwrap();
        Self { problem: Problem::new(surface, ContactModulus(1.0), load).unwrap(), load, force, length }
    }

    /// The states at the ends of a path through shares of the sliding load, each in some steps.
    fn path(&self, solver: &dyn Solver, turns: &[f64], steps: usize, tolerance: f64) -> Vec<Vec<SlipState>> {
        let mut history = SlipHistory::new(self.problem.clone(), MU, solver, stop(tolerance)).unwrap();
        let mut from = 0.0;
        let mut way = |&to: &f64| {
            let share = |step: usize| from + (to - from) * step as f64 / steps as f64;
            let states =
                (1..=steps).map(|step| history.step(self.load, share(step) * MU * self.force, &mut ()).unwrap());
            let states = states.collect();
            from = to;
            states
        };
        turns.iter().map(&mut way).collect()
    }

    /// Energy per length that friction dissipates on a way.
    fn dissipated(&self, way: &[SlipState]) -> f64 {
        way.iter().map(|state| state.dissipated).sum::<f64>() * self.length
    }

    /// The closed form for a cycle between `+x` and `-x` of the sliding load: twice the difference of two Hertzian approaches,
    /// integrated round the loop (skeleton curve and Masing's rule).
    fn cycle(&self, x: f64) -> f64 {
        let y = 1.0 - x;
        2.0 * (MU * self.force).powi(2) / PI * (1.0 - y * y + 2.0 * y * y.ln())
    }
}

#[test]
fn a_cycle_of_a_cylinder_dissipates_as_in_closed_form_and_converges() {
    for x in [0.5, 0.875] {
        let errors = [801, 3201].map(|points| {
            let cylinder = Cylinder::new(points);
            let ways = cylinder.path(&Multilevel, &[x, -x, x], 1, 1e-12);
            let cycle = cylinder.dissipated(&ways[1]) + cylinder.dissipated(&ways[2]);
            let first = cylinder.dissipated(&ways[0]);
            assert!((4.0 * first / cycle - 1.0).abs() < 1e-2, "first loading {first}, cycle {cycle}");
            let stick = ways[0][0].stick_share();
            assert!((stick - (1.0 - x).sqrt()).abs() < 4.0 / points as f64, "{stick}");
            (cycle / cylinder.cycle(x) - 1.0).abs()
        });
        assert!(errors[0] < 1e-3 && errors[1] < 0.5 * errors[0], "{errors:?}");
    }
}

#[test]
fn steps_along_a_path_in_one_sense_do_not_matter() {
    let cylinder = Cylinder::new(801);
    for solver in [&Multilevel as &dyn Solver, &PolonskyKeer] {
        let [one, four] = [1, 4].map(|steps| cylinder.path(solver, &[0.875, -0.875, 0.875], steps, 1e-15));
        for (one, four) in one.iter().zip(&four) {
            let [once, often] = [one, four].map(|way| cylinder.dissipated(way));
            assert!((once / often - 1.0).abs() < 1e-12, "{}: {once:e} against {often:e}", solver.name());
            let [a, b] = [&one[0].traction, &four[3].traction];
            let most = b.iter().fold(0.0f64, |most, tau| most.max(tau.abs()));
            let apart = (a - b).iter().fold(0.0f64, |most, tau| most.max(tau.abs()));
            assert!(apart <= 1e-9 * most, "{}: {apart:e} of {most:e}", solver.name());
        }
    }
}

fn rough(points: usize, hurst: f64, seed: u64) -> Problem {
    let spectrum = Spectrum { hurst, rolloff_wavelength: 0.125, short_cutoff: 0.01, rms_gradient: 0.1 };
    let surface = Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, seed).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap()
}

/// On any profile a reversal follows the first curve at half of the load, doubled (Masing), as the first curve itself is the
/// difference of two normal approaches.
#[test]
fn masings_rule_holds_on_rough_lines() {
    for (hurst, seed) in [(0.3, 1), (0.8, 2)] {
        let (problem, load, limit) = (rough(2048, hurst, seed), Load::MeanPressure(0.01), MU * 0.01);
        let shift = |pulls: &[f64]| {
            let mut history = SlipHistory::new(problem.clone(), MU, &Multilevel, stop(1e-13)).unwrap();
            pulls.iter().fold(0.0, |_, pull| history.step(load, pull * limit, &mut ()).unwrap().shift)
        };
        let gap = |load: f64| {
            let problem = problem.clone().with_load(Load::MeanPressure(load)).unwrap();
            Multilevel.solve(&problem, &stop(1e-13), &mut ()).unwrap().mean_gap()
        };
        for pull in [0.2, 0.6, 0.9] {
            let [first, back] = [shift(&[pull]), shift(&[0.95, 0.95 - 2.0 * pull.min(0.95)])];
            assert!((back / (-2.0 * first) - 1.0).abs() < 1e-6, "{back} against {first} at {pull}");
            // compliances are the same on lines, and the gap falls by the approach
            let skeleton = MU * (gap(0.01 * (1.0 - pull)) - gap(0.01));
            assert!((first / skeleton - 1.0).abs() < 1e-6, "{first} against {skeleton}");
        }
    }
}

/// Traction and stick area of the first pull are those of the difference of two normal contacts.
#[test]
fn the_first_pull_is_the_difference_of_two_normal_contacts() {
    let (problem, load) = (rough(4096, 0.8, 5), Load::MeanPressure(0.01));
    let pull = 0.7 * MU * 0.01;
    let state = SlipHistory::new(problem.clone(), MU, &Multilevel, stop(1e-13)).unwrap().step(load, pull, &mut ());
    let state = state.unwrap();
    let pressed = Multilevel.solve(&problem, &stop(1e-13), &mut ()).unwrap();
    let friction = asperity::contact::Friction { coefficient: MU, tangential: pull };
    let slip = asperity::contact::PartialSlip::solve(pressed, friction, &Multilevel, &stop(1e-13), &mut ()).unwrap();
    let apart = (&state.traction - &slip.traction()).iter().fold(0.0f64, |most, it| most.max(it.abs()));
    let most = state.traction.iter().fold(0.0f64, |most, it| most.max(it.abs()));
    assert!(apart < 1e-6 * most, "{apart:e} of {most:e}");
    let differ = state.sticks().iter().zip(slip.sticks().iter()).filter(|(a, b)| a != b).count();
    assert!(differ <= 2, "{differ} nodes");
}

/// A larger normal load keeps the traction and adds what sticks; a smaller one loses it where the solid is left.
#[test]
fn a_normal_load_that_varies_keeps_coulombs_law() {
    let problem = rough(1024, 0.5, 3);
    let mut history = SlipHistory::new(problem, MU, &Multilevel, stop(1e-12)).unwrap();
    let path = [(0.01, 0.5), (0.02, 0.9), (0.005, -0.3), (0.001, 0.0), (0.03, -0.99), (0.03, 0.99)];
    for (p, share) in path {
        let state = history.step(Load::MeanPressure(p), share * MU * p, &mut ()).unwrap();
        assert!(state.is_converged() && state.certificate.eta < 1e-9, "{:?}", state.certificate);
        assert!((state.traction.mean().unwrap() - share * MU * p).abs() < 1e-12 * MU * p);
        let open = state.traction.iter().zip(&state.contact.pressure).filter(|(tau, p)| **p == 0.0 && **tau != 0.0);
        assert_eq!(open.count(), 0);
    }
}

#[test]
fn what_friction_cannot_carry_is_refused_and_leaves_the_history_as_it_was() {
    let (problem, load) = (rough(256, 0.5, 3), Load::MeanPressure(0.01));
    let history = |mu| SlipHistory::new(problem.clone(), mu, &Multilevel, stop(1e-10));
    assert!(matches!(history(f64::NAN), Err(SlipError::Coefficient { .. })));
    assert!(matches!(history(-0.1), Err(SlipError::Coefficient { .. })));
    let mut slip = history(0.2).unwrap();
    let first = slip.step(load, 1e-3, &mut ()).unwrap();
    assert!(matches!(slip.step(load, 2e-3, &mut ()), Err(SlipError::Sliding { .. })));
    assert!(matches!(slip.step(load, f64::NAN, &mut ()), Err(SlipError::Sliding { .. })));
    assert!(matches!(slip.step(Load::MeanGap(0.01), 1e-3, &mut ()), Err(SlipError::NeedsPressure { .. })));
    let again = slip.step(load, 1e-3, &mut ()).unwrap();
    assert!(again.shift.abs() < 1e-8 * first.shift && again.dissipated < 1e-6 * first.dissipated);
    // without friction there is no traction, and no tangential load but zero
    let mut smooth = history(0.0).unwrap();
    assert!(smooth.step(load, 1e-9, &mut ()).is_err());
    assert!(smooth.step(load, 0.0, &mut ()).unwrap().traction.iter().all(|tau| *tau == 0.0));
}

/// The influence of a strip of a free line on another one, by the integral of the logarithm: a sum over all pairs of nodes, with
/// no transform and nothing of the solver.
fn displaced(traction: &[f64], spacing: f64, length: f64) -> Vec<f64> {
    let integral = |s: f64| if s == 0.0 { 0.0 } else { s * ((s.abs() / length).ln() - 1.0) };
    let influence = |x: f64| -2.0 / PI * (integral(x + 0.5 * spacing) - integral(x - 0.5 * spacing));
    let at = |i: usize| traction.iter().enumerate().map(|(j, t)| t * influence((i as f64 - j as f64) * spacing)).sum();
    (0..traction.len()).map(at).collect()
}

/// Random normal and tangential loads on free rough lines; each state is checked by direct sums.
#[test]
fn random_histories_obey_equilibrium_bounds_and_coulombs_law() {
    let mut state = 12345u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut steps, mut slipped) = (0, 0);
    for case in 0..80 {
        let (points, mu) = (128 + 64 * (case % 3), 10f64.powf(-3.0 + 4.0 * random()));
        let spectrum =
            Spectrum { hurst: 0.2 + 0.7 * random(), rolloff_wavelength: 0.25, short_cutoff: 0.03, rms_gradient: 0.1 };
        let grid = Grid::line(points, 1.0).unwrap();
        let heights = Surface::rough(grid, &spectrum, case as u64).unwrap().height().clone();
        let surface = Surface::new(grid.with_periodic([false; 2]), heights).unwrap();
        let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
        let mut history = SlipHistory::new(problem, mu, &Multilevel, stop(1e-11)).unwrap();
        let (mut p_mean, mut before) = (0.01, vec![0.0; points]);
        for _ in 0..8 {
            if random() < 0.4 {
                p_mean = 10f64.powf(-4.0 + 3.0 * random());
            }
            let pull = (2.0 * random() - 1.0) * 0.999 * mu * p_mean;
            let found = history.step(Load::MeanPressure(p_mean), pull, &mut ()).unwrap();
            assert!(found.is_converged(), "case {case}");
            let tau: Vec<f64> = found.traction.iter().copied().collect();
            let p: Vec<f64> = found.contact.pressure.iter().copied().collect();
            let limit = mu * p_mean;
            assert!((tau.iter().sum::<f64>() / points as f64 - pull).abs() < 1e-11 * limit, "case {case}");
            let change: Vec<f64> = tau.iter().zip(&before).map(|(now, before)| now - before).collect();
            let moved = displaced(&change, 1.0 / points as f64, 1.0);
            let largest = moved.iter().fold(0.0f64, |most, u| most.max((u - found.shift).abs()));
            let mut missed = 0.0;
            for i in 0..points {
                assert!(tau[i].abs() <= mu * p[i] * (1.0 + 1e-13), "case {case}");
                let slip = moved[i] - found.shift;
                // the energy that is not dissipated although it could be: zero where Coulomb's law holds
                missed += (mu * p[i] * slip.abs() + tau[i] * slip) / points as f64;
            }
            assert!(missed <= 1e-6 * limit * largest, "case {case}: {missed:e} of {:e}", limit * largest);
            slipped += found.zones.iter().filter(|zone| matches!(zone, Zone::Forward | Zone::Backward)).count();
            (steps, before) = (steps + 1, tau);
        }
    }
    assert!(steps == 640 && slipped > 1000, "{slipped} nodes slipped");
}
