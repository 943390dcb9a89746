//! Nested grids.

use super::support::{Pressure, Support};
use crate::contact::{ContactModulus, Load, Problem};
use crate::grid::Grid;
use crate::surface::{Field, Surface};

/// The fewest points along a side of a coarse grid.
const FEWEST: usize = 32;

/// The problem on the [`halved`] grid, if there is one and what is left on it is neither flat nor too low to be touched.
pub(super) fn coarser(problem: &Problem) -> Option<Problem> {
    let surface = problem.surface();
    let coarse = halved(surface.grid())?;
    let height = Field::from_shape_fn(coarse.shape(), |(y, x)| surface.height()[[2 * y, 2 * x]]);
    let surface = Surface::new(coarse, height).ok()?;
    let load = match problem.mean_gap() {
        Some(gap) => Load::MeanGap(gap - surface.mean_height()),
        None => Load::MeanPressure(problem.expected_mean_pressure()),
    };
    Problem::new(surface, ContactModulus(problem.contact_modulus()), load).ok()
}

/// The grid of every other node along each side, if the sides are even and long enough.
pub(super) fn halved(grid: &Grid) -> Option<Grid> {
    let ([ny, nx], [ly, lx]) = (grid.shape(), grid.size());
    let halves = |n: usize| n.is_multiple_of(2) && n / 2 >= FEWEST;
    if grid.is_line() {
        halves(nx).then(|| Grid::line(nx / 2, lx).ok())?
    } else {
        (halves(nx) && halves(ny)).then(|| Grid::surface([ny / 2, nx / 2], [ly, lx]).ok())?
    }
}

/// The pressure on the nodes of a grid of twice as many along each side, in `rows` of the half-space, interpolated linearly.
pub(super) fn prolong(coarse: &[f64], [ny, nx]: [usize; 2], fine: [usize; 2], rows: [usize; 2]) -> Pressure {
    let around = |i: usize, coarse: usize, fine: usize| {
        if coarse == fine { [i, i] } else { [i / 2, i.div_ceil(2) % coarse] }
    };
    let (support, values) = Support::choose(rows, |row, nodes| {
        let first = row * rows[1];
        let [y0, y1] = around(first / fine[1], ny, fine[0]);
        let sum = |x: usize| coarse[y0 * nx + x] + coarse[y1 * nx + x];
        for column in 0..rows[1] {
            let [x0, x1] = around(first % fine[1] + column, nx, fine[1]);
            let pressure = 0.25 * (sum(x0) + sum(x1));
            if pressure > 0.0 {
                nodes.push(column, pressure);
            }
        }
    });
    Pressure { support, values }
}
