//! The half-space in Fourier space against the direct sum.

use asperity::Grid;
use asperity::elastic::direct::{displacement, influence};
use asperity::elastic::{HalfSpace, Response};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};
use std::f64::consts::TAU;

fn grids() -> [Grid; 6] {
    [
        Grid::line(4, 2.0).unwrap(),
        Grid::line(31, 0.5).unwrap(),
        Grid::line(64, 10.0).unwrap(),
        Grid::surface([12, 16], [1.0, 3.0]).unwrap(),
        Grid::surface([7, 5], [2.0, 2.0]).unwrap(),
        Grid::surface([4, 37], [1.0, 1.0]).unwrap(),
    ]
}

#[test]
fn direct_sum_of_one_wave_is_its_compliance() {
    let grid = Grid::surface([12, 16], [1.0, 3.0]).unwrap();
    let q = TAU * (2.0_f64 / 3.0).hypot(1.0);
    let wave: Vec<f64> =
        (0..grid.len()).map(|i| (TAU * (2.0 * (i % 16) as f64 / 16.0 + (i / 16) as f64 / 12.0)).cos()).collect();
    for (u, p) in displacement(&grid, &HalfSpace::new(5.0), &wave).iter().zip(&wave) {
        assert!((u - 2.0 / (5.0 * q) * p).abs() < 1e-14);
    }
}

#[test]
fn fourier_is_the_direct_sum_on_awkward_grids() {
    for grid in grids() {
        let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin() + 0.3).collect();
        let mut fast = vec![0.0; grid.len()];
        Response::half_space(&grid, 3.0).displacement(&pressure, &mut fast);
        for (fast, slow) in fast.iter().zip(displacement(&grid, &HalfSpace::new(3.0), &pressure)) {
            assert!((fast - slow).abs() < 1e-13, "{grid:?}: {fast} against {slow}");
        }
    }
}

#[test]
fn stiffness_undoes_compliance() {
    for grid in grids() {
        let wanted: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin()).collect();
        let mean = wanted.iter().sum::<f64>() / wanted.len() as f64;
        let (mut u, mut p) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        let mut half_space = Response::half_space(&grid, 3.0);
        half_space.displacement(&wanted, &mut u);
        half_space.pressure(&u, &mut p);
        for (p, w) in p.iter().zip(&wanted) {
            assert!((p - (w - mean)).abs() < 1e-12);
        }
    }
}

/// Lines in one piece and in many, surfaces on one core and on many.
fn shared_grids() -> [Grid; 6] {
    [
        Grid::line(31, 0.5).unwrap(),
        Grid::line(1 << 16, 2.0).unwrap(),
        Grid::line(2 * 3 * 5 * 7 * 11 * 31, 2.0).unwrap(),
        Grid::surface([7, 5], [2.0, 1.0]).unwrap(),
        Grid::surface([4, 37], [1.0, 1.0]).unwrap(),
        Grid::surface([181, 200], [1.0, 3.0]).unwrap(),
    ]
}

/// A free surface that is large enough for a near and a far part.
fn large_and_free() -> Grid {
    Grid::surface([402, 445], [1.2, 1.3]).unwrap().with_periodic([false; 2])
}

#[test]
fn large_free_surfaces_respond_as_the_direct_sum() {
    let (grid, solid) = (large_and_free(), HalfSpace::new(3.0));
    let ([ny, nx], influence) = (grid.shape(), influence(&grid, &solid));
    let mut response = Response::new(&grid, solid).unwrap();
    for seed in 0..20 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let loads: Vec<_> =
            (0..500).map(|_| (random.random_range(0..grid.len()), random.random_range(0.0..2.0))).collect();
        let mut pressure = vec![0.0; grid.len()];
        loads.iter().for_each(|(node, load)| pressure[*node] += load);
        let mut displacement = vec![0.0; grid.len()];
        response.displacement(&pressure, &mut displacement);
        let largest = displacement.iter().fold(0.0, |most: f64, u| most.max(*u));
        let watched =
            (0..200).map(|_| random.random_range(0..grid.len())).chain([0, nx - 1, (ny - 1) * nx, ny * nx - 1]);
        for node in watched {
            let apart = |other: usize| (node / nx).abs_diff(other / nx) * nx + (node % nx).abs_diff(other % nx);
            let sum: f64 = loads.iter().map(|(other, load)| influence[apart(*other)] * load).sum();
            let error = (displacement[node] - sum).abs() / largest;
            assert!(error < 1e-13, "seed {seed}, node {node}: {error:e}");
        }
    }
}

#[test]
fn responses_are_the_same_on_any_number_of_threads() {
    for grid in shared_grids().into_iter().chain([large_and_free()]) {
        let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i % 1009 * (i % 911)) as f64 * 0.7).sin() + 0.3).collect();
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut displacement = vec![0.0; grid.len()];
                Response::new(&grid, HalfSpace::new(3.0)).unwrap().displacement(&pressure, &mut displacement);
                displacement
            })
        };
        let one = on(1);
        assert!([2, 3, 8].iter().all(|&threads| on(threads) == one), "{grid:?}");
    }
}

#[test]
fn stiffnesses_start_with_the_mean_and_are_nowhere_softer_than_the_softest() {
    for grid in shared_grids() {
        let half_space = Response::half_space(&grid, 3.0);
        let stiffnesses: Vec<f64> = half_space.stiffnesses().collect();
        assert_eq!((stiffnesses.len(), stiffnesses[0]), (grid.modes(), 0.0));
        let softest = stiffnesses[1..].iter().copied().fold(f64::INFINITY, f64::min);
        assert!((half_space.softest_stiffness() / softest - 1.0).abs() < 1e-15, "{grid:?}");
    }
}
