//! Slip under normal loads that vary, close to sliding, and under weak pulls.
//!
//! The exact solutions rest on two facts. Where all nodes stick, a traction that is `c` times a change of the pressure displaces the
//! contact by `c` times the approach. So each traction along `x` is a sum of changes of the pressure of normal contacts, with a factor `c(P)`
//! between `-mu` and `mu` for each load `P` (Jäger 1993). A growing load adds changes with `c = dQ/dP`, a falling load takes them away,
//! and what friction does not carry so replaces the factors by `mu` or `-mu`, from the largest load on.

use asperity::contact::{
    Contact, ContactModulus, Load, Multilevel, Problem, Quantity, ResultClaim, Solver, State, Stop,
};
use asperity::history::{PathPoint, Process, SlipHistory, SlipPace, SlipProcess};
use asperity::surface::Field;
use asperity::{Grid, Indenter, Surface};
use std::f64::consts::TAU;

fn stop(tolerance: f64) -> Stop {
    Stop::new(tolerance, 100_000).unwrap()
}

/// The states at the points of a path, a normal and a tangential load each, of bodies of the ratio `m`.
fn states(problem: &Problem, [mu, m]: [f64; 2], path: &[[f64; 2]], pace: SlipPace, tolerance: f64) -> Vec<State> {
    let history = SlipHistory::sheared(problem.clone(), mu, m, &Multilevel, stop(tolerance)).unwrap();
    let point = |[load, tangential]: &[f64; 2]| PathPoint {
        tangential: Some(*tangential),
        ..PathPoint::under(Load::MeanPressure(*load))
    };
    let mut process = SlipProcess::new(history, path.iter().map(point).collect(), pace);
    let mut states = Vec::new();
    while let Some(state) = process.next(&mut ()) {
        states.push(state.unwrap());
    }
    assert!(states.iter().all(|state| state.contact.is_converged()));
    states.into_iter().filter(|state| state.point.is_some()).collect()
}

fn pressed(problem: &Problem, load: f64) -> Contact {
    let problem = problem.clone().with_load(Load::MeanPressure(load)).unwrap();
    Multilevel.solve(&problem, &stop(1e-13), &mut ()).unwrap()
}

/// `A p - h` where the surfaces touch: the approach except for a constant.
fn approach(contact: &Contact) -> f64 {
    let (pressure, height) = (contact.pressure.as_slice().unwrap(), contact.problem.height());
    let most = (0..height.len()).max_by(|&i, &j| pressure[i].total_cmp(&pressure[j])).unwrap();
    contact.displacement.as_slice().unwrap()[most] - height[most]
}

/// The factors `c(P)`: the load up to which each of them holds, and the factor.
struct Factors(Vec<[f64; 2]>);

impl Factors {
    fn below(&self, i: usize) -> f64 {
        if i == 0 { 0.0 } else { self.0[i - 1][0] }
    }

    /// One small step of both loads; `from` is the normal load before.
    fn step(&mut self, mu: f64, [from, to]: [f64; 2], pulled: f64) {
        let mut left = pulled;
        if to > from {
            let factor = (pulled / (to - from)).clamp(-mu, mu);
            self.0.push([to, factor]);
            left = if factor.abs() < mu { 0.0 } else { pulled - factor * (to - from) };
        }
        while self.0.last().is_some_and(|last| last[0] > to) {
            let (i, last) = (self.0.len() - 1, self.0.last_mut().unwrap());
            let [end, factor] = *last;
            last[0] = to;
            left += factor * (end - to.max(self.below(i)));
            if self.below(i) >= to {
                self.0.pop();
            }
        }
        let limit = mu.copysign(left);
        let mut begin = to;
        while left != 0.0 {
            let [end, factor] = self.0.pop().expect("friction carries the load");
            let below = self.0.last().map_or(0.0, |it| it[0]);
            let gain = (limit - factor) * (end - below);
            if gain.abs() > left.abs() {
                begin = end - left / (limit - factor);
                self.0.push([begin, factor]);
                break;
            }
            (begin, left) = (below, left - gain);
        }
        if begin < to {
            self.0.push([to, limit]);
        }
    }

    /// The shift, from the approach of the highest peak before it touches on.
    fn shift(&self, approach: &dyn Fn(f64) -> f64) -> f64 {
        self.0.iter().enumerate().map(|(i, it)| it[1] * (approach(it[0]) - approach(self.below(i)))).sum()
    }
}

/// A rough line, periodic or free, by the number of a case.
fn line(case: usize) -> Problem {
    let (points, is_periodic) = ([48, 64, 96][case % 3], case.is_multiple_of(2));
    let grid = Grid::line(points, 1.0).unwrap().with_periodic([is_periodic; 2]);
    let wave = |k: usize, x: f64| (TAU * k as f64 * x + (k * (case + 3)) as f64).cos() / (k * k) as f64;
    let height = Field::from_shape_fn((1, points), |(_, i)| {
        let x = i as f64 / points as f64 - 0.5;
        let form = if is_periodic { 0.04 * (TAU * x).cos() } else { -0.6 * x * x };
        form + if case % 4 < 2 { 0.01 * (2..7).map(|k| wave(k, x)).sum::<f64>() } else { 0.0 }
    });
    Problem::new(Surface::new(grid, height).unwrap(), ContactModulus(1.0), Load::MeanPressure(0.01)).unwrap()
}

/// Paths of the loads over their largest normal load, the tangential one over `mu` times that: growing and falling loads, turns, and loads that
/// are left small.
const PATHS: [&[[f64; 2]]; 4] = [
    &[[0.3, 0.0], [1.0, 0.8], [0.4, -0.1], [1.0, 0.2]],
    &[[1.0, 0.7], [0.05, 0.03], [0.8, -0.6], [0.8, 0.5]],
    &[[0.2, 0.1], [0.6, -0.4], [0.5, 0.45], [0.1, -0.08], [0.9, 0.6]],
    &[[0.5, -0.4], [1.0, 0.3], [0.3, 0.29], [0.6, 0.0]],
];

#[test]
fn shift_and_loss_under_varying_normal_loads_are_those_of_superposed_contacts() {
    let (mu, steps, table) = (0.4, 4000, 600);
    for (case, path) in PATHS.iter().enumerate().map(|(i, path)| (2 * i + i / 2, path)) {
        let problem = line(case);
        let highest = problem.height().iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let most = 0.03;
        let path: Vec<[f64; 2]> = path.iter().map(|[p, q]| [most * p, most * mu * q]).collect();
        let at = |k: usize| most * (k as f64 / table as f64).powi(2);
        let approaches: Vec<f64> =
            (0..=table).map(|k| if k == 0 { -highest } else { approach(&pressed(&problem, at(k))) }).collect();
        let interpolated = |load: f64| {
            let k = ((load / most).sqrt() * table as f64).min(table as f64 - 1.0) as usize;
            approaches[k] + (load - at(k)) / (at(k + 1) - at(k)) * (approaches[k + 1] - approaches[k])
        };
        let direct = |load: f64| if load == 0.0 { -highest } else { approach(&pressed(&problem, load)) };
        let found = states(&problem, [mu, 0.0], &path, SlipPace::Tolerance(1e-2), 1e-8);
        let largest = found.iter().map(|state| state.value(Quantity::Shift).abs()).fold(0.0, f64::max);
        let (mut factors, mut last, mut work, mut before) =
            (Factors(vec![[path[0][0], 0.0]]), [path[0][0], 0.0], 0.0, 0.0);
        for (to, state) in path.iter().zip(&found) {
            let from = last;
            for k in 1..=steps {
                let next = [0, 1].map(|i| from[i] + (to[i] - from[i]) * f64::from(k) / f64::from(steps));
                factors.step(mu, [last[0], next[0]], next[1] - last[1]);
                let shift = factors.shift(&interpolated);
                work += 0.5 * (last[1] + next[1]) * (shift - before);
                (before, last) = (shift, next);
            }
            last = *to;
            // no energy is lost but by slip: the work of the pull less what is stored
            let lost = work - state.value(Quantity::Stored);
            let told = [Quantity::ShiftPathError, Quantity::DissipatedPathError].map(|it| state.value(it));
            let shift = factors.shift(&direct);
            let off = (state.value(Quantity::Shift) - shift).abs();
            assert!(off <= 1e-6 * largest, "{case}: {} for {shift}, {off:e}", state.value(Quantity::Shift));
            let off = (state.value(Quantity::Dissipated) - lost).abs();
            assert!(
                off <= 1.5 * told[1] + 2e-4 * lost.max(1e-2 * state.value(Quantity::Stored)),
                "{case}: {off:e} of {lost:e}, told {told:?}"
            );
            assert!(
                told[1] <= 2e-2 * state.value(Quantity::Dissipated).max(1e-2 * state.value(Quantity::Stored)),
                "{told:?} of {lost:e}"
            );
        }
    }
}

/// The normal load grows so fast that friction carries the pull: in one step, without loss, by `dQ/dP` times the approach.
#[test]
fn nothing_slips_where_the_normal_load_grows_faster_than_the_pull() {
    let grid = Grid::line(1024, 1.0).unwrap();
    let cylinder = Indenter::Cylinder { radius: 1.0 }.surface(grid).unwrap();
    let problem = Problem::new(cylinder, ContactModulus(1.0), Load::MeanPressure(1e-3)).unwrap();
    let found = states(&problem, [0.3, 0.0], &[[1e-6, 0.0], [1e-3, 0.25e-3]], SlipPace::Tolerance(1e-2), 1e-10);
    let last = &found[1];
    assert_eq!(last.value(Quantity::StickShare), 1.0);
    assert!(last.value(Quantity::Dissipated) < 1e-9 * last.value(Quantity::Stored));
    assert_eq!((last.claim, last.value(Quantity::DissipatedPathError)), (ResultClaim::Solution, 0.0));
    let factor = 0.25e-3 / (1e-3 - 1e-6);
    let shift = factor * (approach(&pressed(&problem, 1e-3)) - approach(&pressed(&problem, 1e-6)));
    assert!((last.value(Quantity::Shift) / shift - 1.0).abs() < 1e-6, "{} for {shift}", last.value(Quantity::Shift));
    // steps that are given are kept, and their error is not known
    let given = states(&problem, [0.3, 0.0], &[[1e-3, 0.2e-3], [0.5e-3, 0.1e-3]], SlipPace::Count(2), 1e-8);
    assert_eq!(given.iter().map(|it| it.claim).collect::<Vec<_>>(), [ResultClaim::Solution, ResultClaim::GivenSteps]);
    assert_eq!(given[1].get(Quantity::ShiftPathError), None);
}

/// Close to sliding the nodes stick that touch under `P - Q/mu`, and the shift is `mu` times the difference of both approaches.
#[test]
fn close_to_sliding_the_nodes_of_the_lighter_contact_stick() {
    let mu = 0.3;
    for case in 0..6 {
        let (problem, load) = (line(case), 0.02);
        let full = pressed(&problem, load);
        for left in [1e-2, 1e-4, 1e-6, 1e-9] {
            let lighter = pressed(&problem, load * left);
            let shares = [&lighter, &full].map(|it| it.pressure.iter().filter(|p| **p > 0.0).count() as f64);
            let path = [[load, mu * load * (1.0 - left)]];
            let state = &states(&problem, [mu, 0.0], &path, SlipPace::Tolerance(1e-2), 1e-8)[0];
            let sticks = state.value(Quantity::StickShare);
            assert!((sticks - shares[0] / shares[1]).abs() < 1e-12, "{case} {left}: {sticks} for {shares:?}");
            let shift = mu * (approach(&full) - approach(&lighter));
            assert!((state.value(Quantity::Shift) / shift - 1.0).abs() < 1e-6, "{case} {left}");
        }
    }
}

/// Under weak pulls all nodes but those at the edges stick, and the shift is proportional to the pull: to that by which the approach grows with the
/// load while the same nodes touch. After a pull, weak changes of it are as exact.
#[test]
fn shifts_of_weak_pulls_are_proportional_to_them() {
    let (mu, load) = (0.3, 0.02);
    for case in 0..6 {
        let problem = line(case);
        let [below, above] = [1.0 - 1e-7, 1.0 + 1e-7].map(|part| approach(&pressed(&problem, part * load)));
        let compliance = (above - below) / (2e-7 * load);
        for pull in [1e-13, 1e-9, 1e-6] {
            let path = [[load, pull * load], [load, -pull * load]];
            let found = states(&problem, [mu, 0.0], &path, SlipPace::Tolerance(1e-2), 1e-8);
            let shifts = [0, 1].map(|i| found[i].value(Quantity::Shift) / (pull * load));
            assert!((shifts[0] / compliance - 1.0).abs() < 1e-3, "{case} {pull:e}: {shifts:?} for {compliance}");
            assert!((shifts[1] / compliance + 1.0).abs() < 1e-3, "{case} {pull:e}: {shifts:?} for {compliance}");
        }
        let back =
            states(&problem, [mu, 0.0], &[[load, 0.1 * load], [load, (0.1 - 1e-7) * load]], SlipPace::Count(1), 1e-8);
        let shift = (back[0].value(Quantity::Shift) - back[1].value(Quantity::Shift)) / (1e-7 * load);
        assert!((shift / compliance - 1.0).abs() < 1e-3, "{case}: {shift} for {compliance}");
        assert!(back[1].value(Quantity::StickShare) > back[0].value(Quantity::StickShare));
    }
    // along both axes: the value of an own dense solution
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(Grid::surface([16, 16], [1.0, 1.0]).unwrap()).unwrap();
    let problem = Problem::new(sphere, ContactModulus(1.0), Load::MeanPressure(0.02)).unwrap();
    let per_pull = |pull: f64| {
        let path = [[0.02, pull * 0.02], [0.02, -pull * 0.02]];
        let found = states(&problem, [mu, 0.4], &path, SlipPace::Tolerance(1e-2), 1e-8);
        [0, 1].map(|i| found[i].value(Quantity::Shift) / (pull * 0.02))
    };
    let [strong, weak] = [1e-4, 1e-9].map(per_pull);
    assert!(
        (weak[0] / strong[0] - 1.0).abs() < 1e-2 && (weak[1] / strong[1] - 1.0).abs() < 1e-2,
        "{strong:?} {weak:?}"
    );
}

/// A sphere under a load that falls and grows: the told errors hold against what 32 and 64 steps of the plain law tend to.
#[test]
fn errors_of_spheres_hold_against_many_steps() {
    let grid = Grid::surface([16, 16], [1.0, 1.0]).unwrap().with_periodic([false; 2]);
    let sphere = Indenter::Sphere { radius: 1.0 }.surface(grid).unwrap();
    let problem = Problem::new(sphere, ContactModulus(1.0), Load::MeanPressure(0.02)).unwrap();
    let path = [[0.02, 0.004], [0.008, -0.001], [0.02, -0.003]];
    let given = |steps: usize| states(&problem, [0.3, 0.4], &path, SlipPace::Count(steps), 1e-10);
    let (coarse, fine) = (given(32), given(64));
    let told = states(&problem, [0.3, 0.4], &path, SlipPace::Tolerance(1e-2), 1e-8);
    for ((told, coarse), fine) in told.iter().zip(&coarse).zip(&fine) {
        let pairs =
            [(Quantity::Shift, Quantity::ShiftPathError), (Quantity::Dissipated, Quantity::DissipatedPathError)];
        for (quantity, error) in pairs {
            let [coarse, fine] = [coarse, fine].map(|state| state.value(quantity));
            // given steps are of first order
            let (limit, unsure) = (2.0 * fine - coarse, 0.3 * (fine - coarse).abs());
            let off = (told.value(quantity) - limit).abs();
            let error = told.value(error);
            let allowed = 1.5 * error + unsure + 1e-5 * limit.abs();
            assert!(off <= allowed, "{quantity:?}: {off:e} of {limit:e}, told {error:e}");
            assert!(error <= 0.03 * limit.abs().max(0.003), "{quantity:?}: {error:e} of {limit:e}");
        }
        assert_eq!(told.claim, ResultClaim::PathSteps);
    }
}
