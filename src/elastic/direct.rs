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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::HalfSpace;

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
        for (u, p) in displacement(&grid, 5.0, &wave).iter().zip(&wave) {
            assert!((u - 2.0 / (5.0 * q) * p).abs() < 1e-14);
        }
    }

    #[test]
    fn fourier_is_the_direct_sum_on_awkward_grids() {
        for grid in grids() {
            let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin() + 0.3).collect();
            let mut fast = vec![0.0; grid.len()];
            HalfSpace::new(&grid, 3.0).displacement(&pressure, &mut fast);
            for (fast, slow) in fast.iter().zip(displacement(&grid, 3.0, &pressure)) {
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
            let mut half_space = HalfSpace::new(&grid, 3.0);
            half_space.displacement(&wanted, &mut u);
            half_space.pressure(&u, &mut p);
            for (p, w) in p.iter().zip(&wanted) {
                assert!((p - (w - mean)).abs() < 1e-12);
            }
        }
    }
}
