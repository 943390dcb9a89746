//! Random histories, checked by sums over the whole history of the effective pressure and direct sums over all nodes.

use super::{prony, rough};
use asperity::Grid;
use asperity::contact::{ContactModulus, Load, Multilevel, Problem, Stop};
use asperity::elastic::{Prony, PronyTerm, direct};
use asperity::history::{Creep, CreepState};
use asperity::surface::Field;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

/// A change of the effective pressure, linear from one time to the next.
struct Change {
    from: f64,
    to: f64,
    change: Field,
}

/// `1 - (1 - exp(-a))/a`-like means over a step: the mean of `exp(-(now - s)/time)` for `s` between `from` and `to`.
fn mean_left(term: &PronyTerm, now: f64, change: &Change) -> f64 {
    let [late, early] = [change.to, change.from].map(|time| (now - time) / term.time);
    if late == early { (-late).exp() } else { -(-late).exp() * (late - early).exp_m1() / (early - late) }
}

/// `int E(t - s) dp_e(s) / E_0` over all changes.
fn contact_pressure(solid: &Prony, changes: &[Change], now: f64, shape: [usize; 2]) -> Field {
    let terms = solid.to_relaxation();
    changes.iter().fold(Field::zeros(shape), |mut sum, it| {
        let weight = 1.0 - terms.iter().map(|term| term.ratio * (1.0 - mean_left(term, now, it))).sum::<f64>();
        sum.scaled_add(weight, &it.change);
        sum
    })
}

/// Asserts all conditions of contact.
fn check(problem: &Problem, state: &CreepState, name: &str) {
    let (contact, load) = (&state.contact, state.load.unwrap());
    let pressure = state.effective_pressure();
    let grid = problem.surface().grid();
    let u = direct::displacement(grid, problem.solid().as_ref(), pressure.as_slice().unwrap());
    let h = problem.surface().heights();
    let largest = u.iter().fold(problem.rms_height(), |most, u| most.max(u.abs()));
    let allowed = 1e-9 * problem.rms_height() + 1e-12 * largest;
    assert!(contact.is_converged(), "{name}: {} {:?}", contact.status, contact.certificate);
    assert!(contact.pressure.iter().all(|&p| p >= 0.0), "{name}");
    // the datum: given, or where the pressure lies
    let mean = contact.pressure.mean().unwrap();
    let datum = match load {
        Load::MeanGap(gap) => gap,
        Load::Approach(approach) => problem.highest() - approach,
        _ => {
            assert!(mean == load.value() || (mean / load.value() - 1.0).abs() < 1e-9, "{name}: {mean} under {load}");
            let touching = contact.pressure.iter().zip(&u).zip(h).filter(|((p, _), _)| **p > 0.0);
            let found = touching.map(|((_, u), h)| h - u).fold(f64::NAN, f64::max);
            if found.is_nan() { h.iter().zip(&u).fold(f64::MIN, |most, (h, u)| most.max(h - u)) } else { found }
        }
    };
    let mut product = 0.0;
    for (i, p) in contact.pressure.iter().enumerate() {
        let gap = u[i] - h[i] + datum;
        assert!(gap >= -allowed, "{name}: gap {gap:e} at {i}");
        product += p * gap / h.len() as f64;
        let told = contact.gap.as_slice().unwrap()[i];
        assert!((told - gap).abs() <= 2.0 * allowed, "{name}: {told:e} is told for {gap:e}");
    }
    assert!(product <= mean * allowed, "{name}: {product:e} for {:e}", mean * allowed);
}

/// A load of one kind for the whole history.
fn random_load(rng: &mut ChaCha8Rng, kind: u64, problem: &Problem) -> Load {
    let scale = rng.random_range(0.0..1.0f64);
    match kind {
        0 => Load::Approach(problem.highest() * (1.3 * scale - 0.2)),
        1 => Load::MeanGap(problem.highest() * (0.05 + 1.2 * scale)),
        _ if rng.random_range(0..5) == 0 => Load::MeanPressure(0.0),
        _ => Load::MeanPressure(10f64.powf(-3.0 + 2.5 * scale) * problem.rms_gradient() * problem.contact_modulus()),
    }
}

#[test]
fn none_of_sixty_random_histories_is_wrong() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    for history in 0..60 {
        let is_free = history % 3 == 0;
        let grid = match history % 2 {
            0 => Grid::line(64, 1.0).unwrap(),
            _ => Grid::surface([16, 12], [1.0, 0.75]).unwrap(),
        };
        let grid = if is_free { grid.with_periodic([false; 2]) } else { grid };
        let surface = rough(grid, rng.random_range(0.2..0.9), history);
        let problem = Problem::new(surface, ContactModulus(2.0), Load::MeanPressure(1e-3)).unwrap();
        let terms: Vec<[f64; 2]> = (0..rng.random_range(1..4))
            .map(|_| [10f64.powf(rng.random_range(-2.0..4.0)), 10f64.powf(rng.random_range(-6.0..6.0))])
            .collect();
        let solid = prony(&terms);
        let mut creep = Creep::new(problem.clone(), solid.clone());
        let stop = Stop::new(1e-10, 20_000).unwrap();
        let (mut state, mut changes) = (creep.start(), Vec::new());
        let kind = match (history / 6) % 3 {
            0 if is_free => 0,
            0 | 1 if !is_free => 1,
            _ => 2,
        };
        // surfaces that are apart recover by another course than a straight one
        let mut has_parted = false;
        for step in 0..6 {
            let load = random_load(&mut rng, kind, &problem);
            let dt = if rng.random_range(0..5) == 0 { 0.0 } else { rng.random_range(0.1..2.0) };
            let name = format!("history {history} step {step} {:?} {terms:?} {load} dt {dt}", grid.shape());
            let next = creep.step(&state, dt, load, &Multilevel, &stop, &mut ());
            let next = next.unwrap_or_else(|error| panic!("{name}: {error}"));
            check(&problem, &next, &name);
            let change = next.effective_pressure() - state.effective_pressure();
            changes.push(Change { from: state.time, to: next.time, change });
            has_parted |= step > 0 && next.contact.mean_pressure() == 0.0 && state.contact.mean_pressure() == 0.0;
            if kind < 2 && !has_parted {
                let expected = contact_pressure(&solid, &changes, next.time, grid.shape());
                let size = next.effective_pressure().iter().fold(0.0f64, |most, p| most.max(p.abs()));
                let off = (&next.contact.pressure - &expected).iter().fold(0.0f64, |most, p| most.max(p.abs()));
                assert!(off <= 1e-10 * size, "{name}: {off:e} of {size:e}");
            }
            assert!(next.energy.lost >= state.energy.lost && next.energy.lost.is_finite(), "{name}");
            let is_forgotten = next.effective_pressure().iter().all(|&p| p < 1e-280);
            assert!(is_forgotten || next.error_bound().is_finite(), "{name}: {}", next.error_bound());
            state = next;
        }
    }
}
