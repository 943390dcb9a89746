//! Random histories in adaptive steps against the same ones in very short steps: the stated errors in time, and energies.

use super::{prony, rough};
use asperity::Grid;
use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Stop};
use asperity::elastic::Prony;
use asperity::history::{Creep, CreepPath, CreepState, CreepSteps};
use asperity::surface::Field;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

/// Every step of a history is divided into this many steps of the exact one, and the first one of these into as many that double: transients after
/// a turn of the load may be much shorter than the step.
const FINER: i32 = 16;
/// Errors of solves, and differences that are rounding, relative to the size of a quantity in the history.
const SOLVED: f64 = 1e-7;
/// The same for energies: the errors of many solves in short steps add up in them.
const SOLVED_ENERGY: f64 = 1e-6;

struct RandomHistory {
    name: String,
    problem: Problem,
    solid: Prony,
    path: CreepPath,
}

impl RandomHistory {
    fn new(seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let is_free = rng.random_range(0..3) == 0;
        let grid = match rng.random_range(0..2) {
            0 => Grid::line(128, 1.0).unwrap(),
            _ => Grid::surface([24, 20], [1.0, 0.8]).unwrap(),
        };
        let grid = if is_free { grid.with_periodic([false; 2]) } else { grid };
        let problem =
            Problem::new(rough(grid, rng.random_range(0.2..0.9), seed), ContactModulus(2.0), Load::MeanPressure(1e-3));
        let problem = problem.unwrap();
        let terms: Vec<[f64; 2]> = (0..rng.random_range(1..5))
            .map(|_| [10f64.powf(rng.random_range(-1.5..1.5)), 10f64.powf(rng.random_range(-4.0..4.0))])
            .collect();
        let kind = if rng.random_range(0..3) == 0 { 0 } else { 1 + u32::from(is_free) };
        let load = |part: f64| match kind {
            0 => Load::MeanPressure(0.1 * problem.rms_gradient() * 2.0 * part),
            1 => Load::MeanGap(problem.highest() * (1.05 - 0.9 * part)),
            _ => Load::Approach(problem.highest() * (1.4 * part - 0.1)),
        };
        let shape = rng.random_range(0..6);
        let mut part = if shape == 1 { 1.0 } else { rng.random_range(0.0..0.3f64) * f64::from(rng.random_range(0..2)) };
        // slow cycles turn with transients that are short beside their steps
        let slow = if shape == 5 { 10f64.powf(rng.random_range(0.0..3.0)) } else { 1.0 };
        let (mut time, mut points) = (0.0, vec![(0.0, load(part))]);
        for i in 0..rng.random_range(1..6) {
            let share = rng.random_range(0.05..1.0f64);
            part = match shape {
                0 => part + (1.0 - part) * share,
                1 => part * share,
                2 => [share, 0.0][i % 2],
                3 => part,
                5 => [0.8, 0.2][i % 2],
                _ => share,
            };
            let is_jump = (shape == 3 && i == 0) || (shape != 5 && rng.random_range(0..4) == 0);
            part = if shape == 3 && i % 2 == 0 { share } else { part };
            time += if is_jump { 0.0 } else { slow * 10f64.powf(rng.random_range(-1.0..1.0)) };
            points.push((time, load(part)));
        }
        let name = format!("{seed}: {:?} free {is_free} {terms:?} {points:?}", grid.shape());
        Self { name, problem, solid: prony(&terms), path: CreepPath::new(points).unwrap() }
    }

    fn creep(&self) -> Creep {
        Creep::new(self.problem.clone(), self.solid.clone())
    }
}

/// A true error over the stated one, where the true one is above the error of the solves.
struct Ratio {
    quantity: &'static str,
    true_error: f64,
    stated: f64,
}

impl Ratio {
    fn value(&self) -> f64 {
        if self.true_error > 0.0 { self.true_error / self.stated } else { 0.0 }
    }
}

fn rms(field: &Field) -> f64 {
    (field.iter().map(|x| x * x).sum::<f64>() / field.len() as f64).sqrt()
}

/// What a history has to show: all ratios, and how many states missed the tolerance.
struct Findings {
    ratios: Vec<Ratio>,
    states: usize,
    missed: usize,
}

const TOLERANCE: f64 = 1e-3;

fn adaptive(history: &RandomHistory, stop: Stop) -> Vec<CreepState> {
    let steps = CreepSteps::adaptive(history.creep(), history.path.clone(), TOLERANCE, &Multilevel, stop).unwrap();
    steps.map(|state| state.unwrap_or_else(|error| panic!("{}: {error}", history.name))).collect()
}

/// The states of the same history in much shorter steps.
fn finer<'a>(history: &RandomHistory, states: &[CreepState], stop: Stop) -> CreepSteps<'a> {
    let between = |pair: &[CreepState]| {
        let [from, to] = [pair[0].time, pair[1].time];
        let step = (to - from) / f64::from(FINER);
        let begin = (1 - FINER..0).map(|i| from + step * 2f64.powi(i));
        begin.chain((1..FINER).map(|i| from + step * f64::from(i))).chain([to]).collect::<Vec<_>>()
    };
    let times = states.windows(2).flat_map(between).collect();
    CreepSteps::at_times(history.creep(), history.path.clone(), times, &Multilevel, stop).unwrap()
}

/// The size of each quantity in a state: pressure, mean pressure, mean gap, area and energy.
fn sizes(state: &CreepState) -> [f64; 5] {
    let turnover = state.energy.stored.max(state.energy.lost);
    [rms(&state.contact.pressure), state.contact.mean_pressure(), state.contact.mean_gap(), 1.0, turnover]
}

/// The true errors of a state beside the stated ones; the sizes in the whole history decide what is rounding.
fn compared(state: &CreepState, exact: &CreepState, sizes: &[f64; 5]) -> Vec<Ratio> {
    let stated = state.time_errors.expect("steps are adaptive");
    let [energy, true_energy] = [state.energy, exact.energy];
    let off = |of: fn(&CreepState) -> f64| (of(state) - of(exact)).abs();
    let work = (energy.work - true_energy.work).abs().max((energy.stored - true_energy.stored).abs());
    let balance = (energy.work - energy.stored - energy.lost).abs();
    [
        ("pressure", sizes[0], rms(&(&state.contact.pressure - &exact.contact.pressure)), stated.pressure),
        ("mean pressure", sizes[1], off(|it| it.contact.mean_pressure()), stated.mean_pressure),
        ("mean gap", sizes[2], off(|it| it.contact.mean_gap()), stated.mean_gap),
        ("area", sizes[3], off(CreepState::relative_area), stated.relative_area),
        ("lost", sizes[4], off(|it| it.energy.lost), stated.lost),
        ("work", sizes[4], work, stated.work),
        ("balance", sizes[4], balance, stated.work + stated.lost),
    ]
    .map(|(quantity, size, error, stated)| {
        let solved = if ["lost", "work", "balance"].contains(&quantity) { SOLVED_ENERGY } else { SOLVED };
        let true_error = if error > solved * size { error } else { 0.0 };
        Ratio { quantity, true_error, stated }
    })
    .into()
}

fn findings(history: &RandomHistory) -> Findings {
    let stop = Stop::new(1e-11, 20_000).unwrap();
    let states = adaptive(history, stop);
    let mut finer = finer(history, &states, stop).map(Result::unwrap);
    let mut at = |state: &CreepState| finer.find(|it| it.time == state.time && it.load == state.load).expect("a state");
    let exact: Vec<CreepState> = states.iter().map(&mut at).collect();
    let largest_of = |i: usize| exact.iter().map(|it| sizes(it)[i]).fold(0.0, f64::max);
    let sizes = std::array::from_fn(largest_of);
    let largest = states.iter().map(|it| rms(&it.contact.pressure)).fold(0.0, f64::max);
    let misses =
        |it: &&CreepState| it.time_errors.unwrap().pressure > TOLERANCE * rms(&it.contact.pressure).max(1e-2 * largest);
    let missed = states.iter().filter(misses).count();
    let ratios = states.iter().zip(&exact).flat_map(|(state, exact)| compared(state, exact, &sizes)).collect();
    Findings { ratios, states: states.len(), missed }
}

/// Asserts that true errors are below three times the stated ones in 99 % of the states, and never above ten times.
fn survey(seeds: std::ops::Range<u64>) {
    let found: Vec<Findings> = seeds.map(|seed| findings(&RandomHistory::new(seed))).collect();
    let [states, missed] =
        [|it: &Findings| it.states, |it: &Findings| it.missed].map(|of| found.iter().map(of).sum::<usize>());
    println!("{} histories, {states} states, of which {missed} state more than the tolerance", found.len());
    for quantity in ["pressure", "mean pressure", "mean gap", "area", "lost", "work", "balance"] {
        let of = found.iter().flat_map(|it| &it.ratios).filter(|it| it.quantity == quantity);
        let mut values: Vec<f64> = of.map(Ratio::value).collect();
        values.sort_by(f64::total_cmp);
        let at = |part: f64| values[((values.len() - 1) as f64 * part) as usize];
        let [median, most, worst] = [at(0.5), at(0.99), at(1.0)];
        println!("true over stated {quantity:>14}: median {median:.2}, 99 % below {most:.2}, largest {worst:.1}");
        assert!(most < 3.0, "{quantity}: {most}");
        assert!(worst <= 10.0, "{quantity}: {worst}");
    }
}

#[test]
fn errors_of_random_histories_are_stated() {
    survey(400..412);
}

#[test]
#[ignore = "takes minutes"]
fn errors_of_three_hundred_random_histories_are_stated() {
    survey(0..300);
}
