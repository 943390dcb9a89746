//! Displacements by tractions, by direct sums.

use asperity::Grid;
use std::f64::consts::{PI, TAU};

/// Displacements by sums over all pairs of nodes, with no transform and nothing of the solver: of rectangles, by the four corners of the
/// antiderivatives with logarithms, and of strips on a free line; on a periodic grid by the sum over all waves. The contact modulus is 1.
pub struct DirectSum {
    shape: [usize; 2],
    /// The terms `xx`, `xy`, `yy` at each distance, whose numbers of rows and columns are counted from `1 - n`.
    kernel: Vec<[f64; 3]>,
}

impl DirectSum {
    pub fn new(grid: &Grid, m: f64) -> Self {
        let [ny, nx] = grid.shape();
        let [dy, dx] = grid.spacing();
        let free = |x: f64, y: f64| {
            let corner = |x: f64, y: f64| {
                let r = x.hypot(y);
                let [a, b] = [y * (x + r).ln(), x * (y + r).ln()];
                [a + b + m * a, -m * r, a + b + m * b]
            };
            let ends = [(0.5, 0.5, 1.0), (0.5, -0.5, -1.0), (-0.5, 0.5, -1.0), (-0.5, -0.5, 1.0)];
            ends.iter().fold([0.0; 3], |sum, (a, b, sign)| {
                let at = corner(x + a * dx, y + b * dy);
                [0, 1, 2].map(|i| sum[i] + sign * at[i] / PI)
            })
        };
        let [ly, lx] = grid.size();
        let periodic = |x: f64, y: f64| {
            let half = |n: usize| (n as isize - 1) / 2;
            let mut sum = [0.0; 3];
            for ky in -half(ny)..=(ny / 2) as isize {
                for kx in -half(nx)..=(nx / 2) as isize {
                    let (qx, qy) = (TAU * kx as f64 / lx, TAU * ky as f64 / ly);
                    let square = qx * qx + qy * qy;
                    if square == 0.0 {
                        continue;
                    }
                    let wave = 2.0 / square.sqrt() * (qx * x + qy * y).cos() / (nx * ny) as f64;
                    let is_nyquist = 2 * kx == nx as isize || 2 * ky == ny as isize;
                    sum[0] += wave * (1.0 + m - m * qx * qx / square);
                    sum[1] -= if is_nyquist { 0.0 } else { wave * m * qx * qy / square };
                    sum[2] += wave * (1.0 + m - m * qy * qy / square);
                }
            }
            sum
        };
        let line = |x: f64| {
            let half = |x: f64| if x == 0.0 { 0.0 } else { x * x.abs().ln() - x };
            let xx = -2.0 / PI * (half(x + 0.5 * dx) - half(x - 0.5 * dx));
            [xx, 0.0, xx]
        };
        let signed = |i: usize, n: usize| i as f64 - (n as f64 - 1.0);
        let places = (0..2 * ny - 1).flat_map(|y| (0..2 * nx - 1).map(move |x| (y, x)));
        let at = |(y, x): (usize, usize)| {
            let (x, y) = (signed(x, nx) * dx, signed(y, ny) * dy);
            match (grid.is_periodic(), grid.is_line()) {
                (true, _) => periodic(x, y),
                (false, true) => line(x),
                (false, false) => free(x, y),
            }
        };
        Self { shape: [ny, nx], kernel: places.map(at).collect() }
    }

    /// The displacement along `x` and `y` at each node.
    pub fn displaced(&self, tau: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let [ny, nx] = self.shape;
        let at = |i: usize| {
            let mut u = [0.0; 2];
            for (j, [x, y]) in tau.iter().enumerate() {
                let (rows, columns) = (i / nx + ny - 1 - j / nx, i % nx + nx - 1 - j % nx);
                let [xx, xy, yy] = self.kernel[rows * (2 * nx - 1) + columns];
                u = [u[0] + xx * x + xy * y, u[1] + xy * x + yy * y];
            }
            u
        };
        (0..ny * nx).map(at).collect()
    }
}
