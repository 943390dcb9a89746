//! Damped motion with adhesion: its end is a state like any other, and its frames lead there.

use asperity::adhesion::{
    AdhesiveControl, AdhesiveMethod, AdhesiveMotion, AdhesiveOutcome, AdhesiveProblem, AdhesiveState, Attraction,
    AttractionForm,
};
use asperity::contact::{ContactModulus, Each, Load, Problem, Quantity, ResultClaim, State, Stop};
use asperity::error::AdhesionError;
use asperity::history::{AdhesionTotals, AdhesiveProcess, PathPoint, Process};
use asperity::surface::{Indenter, Spectrum};
use asperity::{Grid, Surface};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The range of the attraction of the sine, in amplitudes.
const RANGE: f64 = 0.1;

/// Johnson's sine with `alpha = 0.2`, where `p_full = 1` and the amplitude is 1.
fn sine() -> AdhesiveProblem {
    let surface = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(256, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0 / PI), Load::MeanPressure(0.5)).unwrap();
    let attraction = Attraction::new(AttractionForm::Exponential, 0.02 * PI, RANGE).unwrap();
    AdhesiveProblem::new(problem, attraction).unwrap()
}

/// A rough line whose attraction has a process zone of 4.5 spacings.
fn rough(seed: u64) -> AdhesiveProblem {
    let (points, work) = (256, 3e-5);
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.0625, rms_gradient: 0.1 };
    let surface = Surface::rough(Grid::line(points, 1.0).unwrap(), &spectrum, seed).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap();
    let range = (PI * work * 4.5 / points as f64).sqrt();
    let form = [AttractionForm::Exponential, AttractionForm::Cubic][(seed % 2) as usize];
    AdhesiveProblem::new(problem, Attraction::new(form, work, range).unwrap()).unwrap()
}

fn move_from(problem: &AdhesiveProblem, control: AdhesiveControl, from: Option<&AdhesiveState>) -> AdhesiveMotion {
    problem.motion(control, from, &Stop::default(), &mut ()).unwrap()
}

fn state(outcome: AdhesiveOutcome) -> AdhesiveState {
    match outcome {
        AdhesiveOutcome::State(state) => state,
        AdhesiveOutcome::Separated { .. } => panic!("the surfaces have parted"),
    }
}

fn fast(problem: &AdhesiveProblem, control: AdhesiveControl) -> AdhesiveState {
    state(problem.solve(control, None, AdhesiveMethod::Fast, &Stop::default(), &mut ()).unwrap())
}

fn follow(problem: &AdhesiveProblem, loads: &[Load], steps: usize, method: AdhesiveMethod) -> Vec<State> {
    let path = loads.iter().map(|&load| PathPoint { time: None, load, tangential: None }).collect();
    let mut states = Vec::new();
    let told = AdhesiveProcess::new(problem.clone(), path, steps, method, Stop::default()).run(&mut (), &mut |state| {
        states.push(state);
        Ok(())
    });
    told.unwrap();
    states
}

/// The surface comes to rest where the energy is stationary and stable: nearly always in the state of the fast method.
#[test]
fn a_motion_ends_in_a_stable_state_mostly_that_of_the_fast_method() {
    let of_sine = [0.4, 0.8, 1.1].map(AdhesiveControl::MeanGap);
    let loaded = [0.3, 0.0].map(AdhesiveControl::MeanPressure);
    let mut cases: Vec<_> = of_sine.into_iter().chain(loaded).map(|control| (sine(), control)).collect();
    for seed in 1..=6 {
        let problem = rough(seed);
        let gap = problem.problem().highest() * [0.9, 0.6, 0.3][(seed % 3) as usize];
        cases.extend(
            [AdhesiveControl::MeanGap(gap), AdhesiveControl::MeanPressure(0.002)].map(|it| (problem.clone(), it)),
        );
    }
    let mut different = 0;
    for (problem, control) in &cases {
        let [ended, fast] = [state(move_from(problem, *control, None).outcome), fast(problem, *control)];
        let range = problem.attraction().range();
        let apart = (&ended.contact.gap - &fast.contact.gap).iter().fold(0.0f64, |most, it| most.max(it.abs())) / range;
        println!("{control:?}: {} steps, {} transforms, {apart:.1e} ranges", ended.steps, ended.work.transforms);
        for found in [&ended, &fast] {
            assert!(found.claim == ResultClaim::Stable && found.residual <= 1e-8, "{control:?}: {:?}", found.claim);
        }
        assert_eq!(ended.method, "gfmd");
        different += usize::from(apart > 1e-5);
    }
    println!("{different} of {} differ", cases.len());
    assert!(different <= 3, "{different} of {} differ", cases.len());
}

/// From far, the sine jumps into contact: the frames lead there, and lose the energy of the jump.
#[test]
fn the_frames_of_a_jump_lead_into_contact() {
    let problem = sine();
    let far = fast(&problem, AdhesiveControl::MeanGap(1.3));
    assert_eq!(far.relative_area(), 0.0);
    for control in [AdhesiveControl::MeanGap(1.1), AdhesiveControl::MeanPressure(0.0)] {
        let AdhesiveMotion { frames, outcome } = move_from(&problem, control, Some(&far));
        let near = state(outcome);
        let areas: Vec<f64> = frames.iter().chain([&near]).map(AdhesiveState::relative_area).collect();
        let potentials: Vec<f64> = frames.iter().chain([&near]).map(AdhesiveState::potential).collect();
        println!("{control:?}: {} frames, {} steps, {areas:?} {potentials:?}", frames.len(), near.steps);
        assert!(frames.len() > 5 && frames.len() < AdhesiveMotion::MOST_FRAMES);
        assert!(areas[0] == 0.0 && *areas.last().unwrap() > 0.09 && areas.is_sorted(), "{areas:?}");
        assert!(near.potential() < potentials[0] - 0.03 * problem.attraction().work(), "{potentials:?}");
        let rises = potentials.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(rises < 0.01 * (potentials[0] - near.potential()), "{potentials:?}");
        for pair in frames.windows(2) {
            assert!(pair[0].steps < pair[1].steps && pair[0].work.transforms < pair[1].work.transforms);
        }
        for frame in &frames {
            assert!(frame.claim == ResultClaim::Moving && frame.residual > 1e-8 && frame.least_curvature.is_none());
            assert!(frame.contact.gap.iter().all(|gap| *gap >= 0.0));
        }
    }
}

/// A path that is ten thousand ranges long has few frames all the same.
#[test]
fn a_long_motion_has_a_bounded_number_of_frames() {
    let surface = Indenter::Sine { amplitude: 1.0 }.surface(Grid::line(64, 1.0).unwrap()).unwrap();
    let problem = Problem::new(surface, ContactModulus(1.0 / PI), Load::MeanPressure(0.5)).unwrap();
    // a weak attraction: the solid sinks by many of its ranges
    let attraction = Attraction::new(AttractionForm::Exponential, 1e-8, 2e-4).unwrap();
    let problem = AdhesiveProblem::new(problem, attraction).unwrap();
    let touching = fast(&problem, AdhesiveControl::MeanPressure(0.0));
    let motion = move_from(&problem, AdhesiveControl::MeanPressure(0.8), Some(&touching));
    let moved = touching.mean_gap() - state(motion.outcome).mean_gap();
    assert!(moved > 500.0 * problem.attraction().range(), "{moved}");
    let frames = motion.frames.len();
    assert!((20..AdhesiveMotion::MOST_FRAMES).contains(&frames), "{frames}");
}

/// Under a load, down to pull-off: the same pressure as that of the fast method.
#[test]
fn a_history_of_motions_parts_at_the_same_pull() {
    let path = [Load::MeanPressure(0.1), Load::MeanPressure(-0.08)];
    let [fast, moving] = [AdhesiveMethod::Fast, AdhesiveMethod::Gfmd].map(|method| follow(&sine(), &path, 6, method));
    let [lowest, of_motion] = [&fast, &moving].map(|it| AdhesionTotals::new(it).unwrap().lowest_pressure.unwrap());
    println!("{lowest} {of_motion}, {} and {} states", fast.len(), moving.len());
    assert!(lowest < 0.0 && (of_motion / lowest - 1.0).abs() < 0.01, "{lowest} {of_motion}");
    // the frames lead from the last contact away, all under the pull that is not held
    let parted = moving.iter().position(|state| state.claim == ResultClaim::Separated).unwrap();
    let frames: Vec<&State> = moving.iter().filter(|state| state.claim == ResultClaim::Moving).collect();
    let begin = moving.iter().position(|state| state.claim == ResultClaim::Moving).unwrap();
    assert!(frames.len() > 5 && begin + frames.len() == parted && parted > 1);
    assert!(frames.windows(2).all(|pair| pair[1].contact.mean_gap() > pair[0].contact.mean_gap()));
    assert!(
        moving[begin - 1].value(Quantity::RelativeArea) > 0.0
            && frames.last().unwrap().value(Quantity::RelativeArea) == 0.0
    );
    assert!(frames.iter().all(|it| it.value(Quantity::MeanPressure) < of_motion && it.get(Quantity::Jump).is_none()));
}

/// At given mean gaps, in and out: jumps and lost energies are those of the fast method.
#[test]
fn a_loop_of_motions_loses_the_same_energy_in_the_same_jumps() {
    let path = [Load::MeanGap(1.4), Load::MeanGap(0.8), Load::MeanGap(1.4)];
    let [fast, moving] = [AdhesiveMethod::Fast, AdhesiveMethod::Gfmd].map(|method| follow(&sine(), &path, 6, method));
    let [expected, found] = [&fast, &moving].map(|states| AdhesionTotals::new(states).unwrap());
    println!("{expected:?}\n{found:?}");
    assert!(expected.jumps.len() == 2 && found.jumps.len() == 2);
    let agree = |a: f64, b: f64| (a / b - 1.0).abs() < 0.02;
    assert!(agree(found.lost_in_jumps, expected.lost_in_jumps) && expected.lost_in_jumps > 0.0);
    assert!(agree(found.lowest_pressure.unwrap(), expected.lowest_pressure.unwrap()));
    for (found, expected) in found.jumps.iter().zip(&expected.jumps) {
        assert!(agree(found.energy, expected.energy));
        assert!((0..2).all(|i| agree(found.mean_gap[i], expected.mean_gap[i])));
        assert!((0..2).all(|i| (found.relative_area[i] - expected.relative_area[i]).abs() <= 2.0 / 256.0));
        // the state before the jump stands before its frames
        let before = moving[..found.state - 1].iter().rposition(|state| state.claim != ResultClaim::Moving).unwrap();
        assert!(found.state - 1 - before > 3, "few frames before state {}", found.state);
        assert_eq!(found.mean_pressure[0], moving[before].value(Quantity::MeanPressure));
    }
    // beside the frames, both histories have the same states
    let calm = moving.iter().filter(|state| state.claim != ResultClaim::Moving);
    assert!(calm.clone().count().abs_diff(fast.len()) <= 2);
    assert!(calm.clone().all(|state| matches!(state.claim, ResultClaim::Stable | ResultClaim::Marginal)));
    assert!(moving.iter().all(|state| state.contact.work.transforms > 0));
}

#[test]
fn a_pull_above_the_strength_parts_the_surfaces() {
    let problem = sine();
    let pull = AdhesiveControl::MeanPressure(-1.01 * problem.attraction().strength());
    let touching = fast(&problem, AdhesiveControl::MeanPressure(0.2));
    for from in [None, Some(&touching)] {
        assert!(matches!(move_from(&problem, pull, from).outcome, AdhesiveOutcome::Separated { .. }));
    }
    // a weak pull parts surfaces that are far from each other, and not those that stick
    let weak = AdhesiveControl::MeanPressure(-0.02);
    let far = fast(&problem, AdhesiveControl::MeanGap(2.0));
    assert!(matches!(move_from(&problem, weak, Some(&far)).outcome, AdhesiveOutcome::Separated { .. }));
    let held = state(move_from(&problem, weak, Some(&touching)).outcome);
    assert!(held.claim == ResultClaim::Stable && held.relative_area() > 0.05);
}

#[test]
fn a_motion_needs_a_periodic_boundary_and_can_be_stopped() {
    let grid = Grid::line(256, 1.0).unwrap().with_periodic([false; 2]);
    let surface = Indenter::Cylinder { radius: 1.0 }.surface(grid).unwrap();
    let free = Problem::new(surface, ContactModulus(1.0), Load::Force(0.01)).unwrap();
    let free = AdhesiveProblem::new(free, sine().attraction().clone()).unwrap();
    let pressure = AdhesiveControl::MeanPressure(0.0);
    let refused = free.solve(pressure, None, AdhesiveMethod::Gfmd, &Stop::default(), &mut ());
    assert!(matches!(refused, Err(AdhesionError::FreeMotion)));
    // steps beyond the first contact, which is that without adhesion
    let mut seen = 0;
    let mut watch = Each(|_: &asperity::contact::Step<'_>| {
        seen += 1;
        if seen == 40 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let stopped = sine().motion(pressure, None, &Stop::default(), &mut watch);
    assert!(matches!(stopped, Err(AdhesionError::Stopped)) && seen == 40);
    // the iterations are those of the whole state, with the first contact
    let few = sine().motion(pressure, None, &Stop::new(1e-8, 20).unwrap(), &mut ()).unwrap();
    let few = state(few.outcome);
    assert!(few.claim == ResultClaim::NotConverged && few.steps == 20 && few.residual > 1e-8, "{}", few.residual);
}
