//! The half-space by direct summation: slow, short and obviously right. Tests hold the fast one against it.

use crate::grid::Grid;
use std::f64::consts::TAU;

/// Displacement under `pressure` by convolution with the influence function, `O(n^2)`.
///
/// `u(x) = sum_x' K(x - x') p(x')` with `K(x) = (1/n) sum_{q != 0} 2 cos(q x) / (E* |q|)`, the sum running over the `n` modes
/// of the grid.
///
/// # Panics
/// If the length of `pressure` does not fit the grid.
pub fn displacement(grid: &Grid, contact_modulus: f64, pressure: &[f64]) -> Vec<f64> {
    assert_eq!(pressure.len(), grid.len(), "pressure must fit the grid");
    let [ny, nx] = grid.shape();
    let influence = influence(grid, contact_modulus);
    let at = |y: usize, x: usize| {
        let term = |(i, p): (usize, &f64)| {
            let (dy, dx) = ((y + ny - i / nx) % ny, (x + nx - i % nx) % nx);
            influence[dy * nx + dx] * p
        };
        pressure.iter().enumerate().map(term).sum::<f64>()
    };
    (0..ny).flat_map(|y| (0..nx).map(move |x| (y, x))).map(|(y, x)| at(y, x)).collect()
}

/// Displacement at every distance from a node under unit pressure, shape `(ny, nx)`. Whole turns of a phase are taken off while
/// they are integers, so that no digits are lost to them.
pub fn influence(grid: &Grid, contact_modulus: f64) -> Vec<f64> {
    let [ny, nx] = grid.shape();
    let [ly, lx] = grid.size();
    let signed = |k: usize, n: usize| if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let mode = |ky: usize, kx: usize, y: usize, x: usize| {
        let q = TAU * (signed(kx, nx) / lx).hypot(signed(ky, ny) / ly);
        let turns = |k: usize, x: usize, n: usize| ((k * x) % n) as f64 / n as f64;
        let phase = TAU * (turns(kx, x, nx) + turns(ky, y, ny));
        if q > 0.0 { 2.0 * phase.cos() / (contact_modulus * q) } else { 0.0 }
    };
    let at = |i: usize| {
        let sum: f64 = (0..ny * nx).map(|k| mode(k / nx, k % nx, i / nx, i % nx)).sum();
        sum / (ny * nx) as f64
    };
    (0..ny * nx).map(at).collect()
}
