//! Nested grids.

use super::support::{SparsePressure, Support};
use crate::contact::{Load, Problem};
use crate::grid::Grid;
use crate::surface::{Field, Surface};

/// The fewest points per side of a coarse grid.
const FEWEST: usize = 32;

/// The problem on the [`halved`] grid, if there is one and what is left on it is neither flat nor too low to be touched.
pub(super) fn coarser(problem: &Problem) -> Option<Problem> {
    let surface = problem.surface();
    let coarse = halved(surface.grid())?;
    let height = Field::from_shape_fn(coarse.shape(), |(y, x)| surface.height()[[2 * y, 2 * x]]);
    let surface = Surface::new(coarse, height).ok()?;
    let load = match problem.load() {
        Load::MeanGap(gap) => Load::MeanGap(gap - surface.mean_height()),
        Load::Approach(approach) => Load::Approach(approach - lost(problem, &surface)),
        _ => Load::MeanPressure(problem.expected_mean_pressure()),
    };
    Problem::new(surface, problem.solid().clone(), load).ok()?.with_law(problem.law()).ok()
}

/// By how much the highest peak of every other node is lower than that of all.
fn lost(problem: &Problem, coarse: &Surface) -> f64 {
    let highest = coarse.heights().iter().copied().fold(f64::NEG_INFINITY, f64::max);
    problem.highest() - (highest + coarse.mean_height())
}

/// The grid of every other node along each side, if the sides are even and long enough.
pub(super) fn halved(grid: &Grid) -> Option<Grid> {
    let [ny, nx] = grid.shape();
    let halves = |n: usize| n.is_multiple_of(2) && n / 2 >= FEWEST;
    let fits = halves(nx) && (grid.is_line() || halves(ny));
    fits.then(|| grid.with_shape([ny / 2, nx / 2]).ok())?
}

/// The pressure on the nodes of a grid of twice as many along each side, in `rows` of the half-space, interpolated linearly.
pub(super) fn prolong(coarse: &[f64], from: &Grid, to: &Grid, rows: [usize; 2]) -> SparsePressure {
    let ([ny, nx], fine, [round_y, round_x]) = (from.shape(), to.shape(), from.periodic());
    let around = |i: usize, coarse: usize, fine: usize, is_periodic: bool| match i.div_ceil(2) {
        _ if coarse == fine => [i, i],
        next if next < coarse => [i / 2, next],
        _ => [i / 2, if is_periodic { 0 } else { coarse - 1 }],
    };
    let (support, values) = Support::choose(rows, |row, nodes| {
        let first = row * rows[1];
        let [y0, y1] = around(first / fine[1], ny, fine[0], round_y);
        let sum = |x: usize| coarse[y0 * nx + x] + coarse[y1 * nx + x];
        for column in 0..rows[1] {
            let [x0, x1] = around(first % fine[1] + column, nx, fine[1], round_x);
            let pressure = 0.25 * (sum(x0) + sum(x1));
            if pressure > 0.0 {
                nodes.push(column, pressure);
            }
        }
    });
    SparsePressure { support, values }
}
