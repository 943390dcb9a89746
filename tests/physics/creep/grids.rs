//! Stated errors of area and `kappa_r` by the grid, against the same histories in the same steps on a finer grid.

use super::{fixed, prony};
use asperity::contact::{ContactModulus, Load, Problem};
use asperity::history::CreepState;
use asperity::surface::Field;
use asperity::{Grid, Surface};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};
use std::f64::consts::TAU;

/// Points along the line, and on the finer grid.
const POINTS: usize = 128;
const FINER: usize = 8;
/// Waves, of which the shortest one has ten points.
const WAVES: usize = 12;

/// The same waves on a line of any number of points.
fn line(points: usize, waves: &[[f64; 2]]) -> Problem {
    let height = |i: usize| {
        let x = (i as f64 + 0.5) / points as f64;
        waves
            .iter()
            .enumerate()
            .map(|(k, [amplitude, phase])| amplitude * (TAU * (k + 1) as f64 * x + phase).cos())
            .sum()
    };
    let heights = Field::from_shape_vec((1, points), (0..points).map(height).collect()).unwrap();
    let surface = Surface::new(Grid::line(points, 1.0).unwrap(), heights).unwrap();
    Problem::new(surface, ContactModulus(1.0), Load::MeanPressure(1e-3)).unwrap()
}

/// The true errors over the stated ones, of area and `kappa_r`, in all states that carry more than a hundredth of the largest load.
fn ratios(seed: u64) -> Vec<[f64; 2]> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let hurst = rng.random_range(0.3..0.9);
    let wave =
        |k: usize| [1e-3 * (k as f64).powf(-0.5 - hurst) * rng.random_range(0.5..1.5), rng.random_range(0.0..TAU)];
    let waves: Vec<[f64; 2]> = (1..=WAVES).map(wave).collect();
    let solid = prony(&[[10f64.powf(rng.random_range(-0.5..1.0)), 10f64.powf(rng.random_range(-1.0..1.0))]]);
    let largest = 10f64.powf(rng.random_range(-3.5..-2.0));
    // pressed, held, released for the most part, and pressed again
    let points = [(0.0, 0.1), (1.0, 1.0), (2.0, 1.0), (3.0, 0.1), (4.0, 0.8)];
    let path = points.map(|(time, part)| (time, Load::MeanPressure(part * largest))).to_vec();
    let states = |points: usize| fixed(&line(points, &waves), &solid, path.clone(), 5);
    let off = |of: fn(&CreepState) -> f64, [state, exact]: [&CreepState; 2]| (of(state) / of(exact) - 1.0).abs();
    let pairs = states(POINTS).into_iter().zip(states(FINER * POINTS));
    let ratios = pairs.map(|(state, exact)| {
        let stated = state.grid_errors().expect("there is contact");
        let both = [&state, &exact];
        [
            off(CreepState::relative_area, both) / stated.relative_area,
            off(|it| it.resolved().kappa_r, both) / stated.kappa_r,
        ]
    });
    ratios.collect()
}

#[test]
fn errors_of_area_and_kappa_r_by_the_grid_are_stated() {
    let found: Vec<[f64; 2]> = (0..16).flat_map(ratios).collect();
    for (i, name) in ["area", "kappa_r"].into_iter().enumerate() {
        let mut values: Vec<f64> = found.iter().map(|it| it[i]).collect();
        values.sort_by(f64::total_cmp);
        let at = |part: f64| values[((values.len() - 1) as f64 * part) as usize];
        println!("true over stated {name} of {}: {:.2} {:.2} {:.2}", values.len(), at(0.5), at(0.99), at(1.0));
        assert!(at(0.99) < 1.5 && at(1.0) < 3.0 && at(0.5) > 0.02, "{name}: {} {} {}", at(0.5), at(0.99), at(1.0));
    }
}
