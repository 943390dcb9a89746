//! Gradient and developed area of heights, by differences of neighbours.

use crate::chunks;
use crate::surface::Surface;

/// The root mean square gradient: the mean squares of the slopes between all neighbours along each axis, added.
pub(super) fn rms_gradient(surface: &Surface) -> f64 {
    let (h, grid) = (surface.heights(), *surface.grid());
    let mean_along = |axis: usize, next: [isize; 2]| {
        let square = |node: usize| (h[grid.neighbour(node, next)] - h[node]).powi(2);
        let n = grid.shape()[axis];
        let inside = if grid.periodic()[axis] { 1.0 } else { n as f64 / (n - 1) as f64 };
        inside * chunks::sum(h.len(), square) / h.len() as f64 / grid.spacing()[axis].powi(2)
    };
    (mean_along(0, [1, 0]) + mean_along(1, [0, 1])).sqrt()
}

/// The developed area over that of the cell, less 1.
pub(super) fn developed_ratio(surface: &Surface) -> f64 {
    let (h, grid) = (surface.heights(), *surface.grid());
    let [per_dy, per_dx] = grid.spacing().map(f64::recip);
    let [round_y, round_x] = grid.periodic();
    let [ny, nx] = grid.shape();
    let is_cell = |node: usize| (round_y || node / nx + 1 < ny) && (round_x || node % nx + 1 < nx);
    let excess = |node: usize| {
        if !is_cell(node) {
            return 0.0;
        }
        let [a, b, c, d] = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|step| h[grid.neighbour(node, step)]);
        let ([bottom, top], [left, right]) =
            ([b - a, d - c].map(|it| it * per_dx), [c - a, d - b].map(|it| it * per_dy));
        let corners = [[bottom, left], [bottom, right], [top, left], [top, right]];
        // sqrt(1 + s) - 1 without cancellation
        let corner = |[x, y]: [f64; 2]| (x * x + y * y) / (1.0 + (1.0 + x * x + y * y).sqrt());
        0.25 * corners.into_iter().map(corner).sum::<f64>()
    };
    let cells = (ny - usize::from(!round_y)) * (nx - usize::from(!round_x));
    chunks::sum(h.len(), excess) / cells as f64
}
