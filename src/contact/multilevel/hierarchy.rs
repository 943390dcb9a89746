//! Nested grids.

use crate::contact::{Problem, chunks};
use crate::grid::Grid;
use crate::surface::{Field, Surface};

/// The fewest points along a side of a coarse grid.
const FEWEST: usize = 32;

/// The problem on every other node along each side, if the sides are even and long enough and what is left is not flat.
pub(super) fn coarser(problem: &Problem) -> Option<Problem> {
    let surface = problem.surface();
    let grid = surface.grid();
    let [ny, nx] = grid.shape();
    let halves = |n: usize| n.is_multiple_of(2) && n / 2 >= FEWEST;
    if !halves(nx) || !(grid.is_line() || halves(ny)) {
        return None;
    }
    let [ly, lx] = grid.size();
    let coarse = if grid.is_line() { Grid::line(nx / 2, lx) } else { Grid::surface([ny / 2, nx / 2], [ly, lx]) };
    let height = Field::from_shape_fn(coarse.as_ref().ok()?.shape(), |(y, x)| surface.height()[[2 * y, 2 * x]]);
    let surface = Surface::new(coarse.ok()?, height).ok()?;
    Problem::new(surface, problem.contact_modulus(), problem.expected_mean_pressure()).ok()
}

/// The pressure on the nodes of `problem`, interpolated linearly from `coarse` and scaled to the load.
pub(super) fn prolong(pressure: &[f64], coarse: &Grid, problem: &Problem) -> Vec<f64> {
    let [fine_rows, fine_columns] = problem.surface().grid().shape();
    let [rows, columns] = coarse.shape();
    let around =
        |i: usize, coarse: usize, fine: usize| if coarse == fine { [i, i] } else { [i / 2, i.div_ceil(2) % coarse] };
    let at = |node: usize| {
        let [y0, y1] = around(node / fine_columns, rows, fine_rows);
        let [x0, x1] = around(node % fine_columns, columns, fine_columns);
        let p = |y: usize, x: usize| pressure[y * columns + x];
        0.25 * (p(y0, x0) + p(y0, x1) + p(y1, x0) + p(y1, x1))
    };
    let mut fine = vec![0.0; problem.nodes()];
    let loads = chunks::update(&mut fine, |range, fine| {
        range.zip(fine.iter_mut()).for_each(|(node, p)| *p = at(node));
        fine.iter().sum::<f64>()
    });
    let scale = problem.expected_mean_pressure() * problem.nodes() as f64 / loads.iter().sum::<f64>();
    chunks::update(&mut fine, |_, fine| fine.iter_mut().for_each(|p| *p *= scale));
    fine
}
