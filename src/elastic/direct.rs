//! Elastic response by direct summation, which is slow but simple. Tests compare the fast response with it.

use super::{ElasticSolid, element};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// Displacement under `pressure` by convolution with the [`influence`] function, `O(n^2)`: `u(x) = sum_x' K(x - x') p(x')`.
///
/// # Panics
/// If the length of `pressure` does not fit the grid, and for a grid that is free along one axis of a surface only.
pub fn displacement(grid: &Grid, solid: &dyn ElasticSolid, pressure: &[f64]) -> Vec<f64> {
    assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
    let [ny, nx] = grid.shape();
    let influence = influence(grid, solid);
    let at = |y: usize, x: usize| {
        let term = |(i, p): (usize, &f64)| {
            // the influence is even
            let apart = |a: usize, b: usize, n: usize| if grid.is_periodic() { (a + n - b) % n } else { a.abs_diff(b) };
            influence[apart(y, i / nx, ny) * nx + apart(x, i % nx, nx)] * p
        };
        pressure.iter().enumerate().map(term).sum::<f64>()
    };
    (0..ny).flat_map(|y| (0..nx).map(move |x| (y, x))).map(|(y, x)| at(y, x)).collect()
}

/// Displacement at every distance from a node under unit pressure, shape `(ny, nx)`.
///
/// On a periodic grid it is `K(x) = (1/n) sum_{q != 0} factor(q) 2 cos(q x) / (E* |q|)`, the sum running over the `n` modes of the grid;
/// whole turns of a phase are taken off while they are integers, so that no digits are lost to them. On a free one it is the displacement
/// under unit pressure on an element, in closed form.
///
/// # Panics
/// For a grid that is free along one axis of a surface only.
pub fn influence(grid: &Grid, solid: &dyn ElasticSolid) -> Vec<f64> {
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    if grid.is_periodic() {
        return (0..ny * nx).map(|i| periodic(grid, solid, [i / nx, i % nx])).collect();
    }
    assert!(grid.is_line() || grid.periodic() == [false; 2], "both axes of a surface must be free");
    let modulus = solid.contact_modulus();
    let at = |i: usize| {
        let [y, x] = [(i / nx) as f64 * dy, (i % nx) as f64 * dx];
        if grid.is_line() {
            element::strip(x, dx, solid.datum().unwrap_or(grid.size()[1]), modulus)
        } else {
            element::rectangle([y, x], [dy, dx], modulus)
        }
    };
    (0..ny * nx).map(at).collect()
}

/// The influence at a distance of `y` rows and `x` columns, by the sum over all modes.
fn periodic(grid: &Grid, solid: &dyn ElasticSolid, [y, x]: [usize; 2]) -> f64 {
    let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
    let signed = |k: usize, n: usize| if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let mode = |ky: usize, kx: usize| {
        let q = TAU * (signed(kx, nx) / lx).hypot(signed(ky, ny) / ly);
        let turns = |k: usize, x: usize, n: usize| ((k * x) % n) as f64 / n as f64;
        let phase = TAU * (turns(kx, x, nx) + turns(ky, y, ny));
        if q > 0.0 { solid.factor(q) * (2.0 * phase.cos() / (solid.contact_modulus() * q)) } else { 0.0 }
    };
    (0..ny * nx).map(|k| mode(k / nx, k % nx)).sum::<f64>() / (ny * nx) as f64
}
