//! Nested grids.

use super::support::{SparsePressure, Support};
use crate::chunks;
use crate::contact::{Ceiling, Load, Problem};
use crate::grid::Grid;
use crate::surface::{Field, Surface};
use std::ops::Range;

/// The fewest points per side of a coarse grid.
const FEWEST: usize = 32;

/// The problem on the [`halved`] grid, if there is one and what is left on it is neither flat nor too low to be touched.
pub(crate) fn coarser(problem: &Problem) -> Option<Problem> {
    let surface = problem.surface();
    let coarse = halved(surface.grid())?;
    let height = subsampled(surface.heights(), [surface.grid(), &coarse]);
    let surface = Surface::new(coarse, Field::from_shape_vec(coarse.shape(), height).ok()?).ok()?;
    // the datum of the heights of this grid, above their own mean
    let datum = problem.datum().map(|datum| datum - surface.mean_height());
    let load = match (problem.load(), datum) {
        (Load::Approach(_), Some(datum)) => Load::Approach(highest(&surface) - datum),
        (_, Some(datum)) => Load::MeanGap(datum),
        (_, None) => Load::MeanPressure(problem.expected_mean_pressure()),
    };
    let posed = Problem::new(surface, problem.solid().clone(), load).ok()?;
    let at_rest = match problem.ceiling() {
        Ceiling::Uniform(_) => posed.with_law(problem.law()).ok()?,
        Ceiling::Field(ceilings) => {
            posed.with_ceilings(subsampled(ceilings, [problem.surface().grid(), &coarse])).ok()?
        }
    };
    let compliance = || problem.compliance().on_grid(&coarse, load.keeps_uniform());
    if problem.is_moving() { at_rest.with_compliance(compliance().ok()?).ok() } else { Some(at_rest) }
}

/// The values of a field at the nodes of the [`halved`] grid.
fn subsampled(values: &[f64], [from, to]: [&Grid; 2]) -> Vec<f64> {
    let ([_, width], [ny, nx]) = (from.shape(), to.shape());
    let tile = chunks::tile([ny, nx]);
    let mut coarse = vec![0.0; ny * nx];
    chunks::rows_mut(&mut coarse, tile, |task, part| {
        let (y, x) = (task * tile / nx, task * tile % nx);
        let every_other = values[2 * (y * width + x)..].iter().step_by(2);
        part.iter_mut().zip(every_other).for_each(|(to, from)| *to = *from);
    });
    coarse
}

/// The highest height above the mean.
fn highest(surface: &Surface) -> f64 {
    surface.heights().iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// The grid of every other node along each side, if the sides are even and long enough.
pub(in crate::contact) fn halved(grid: &Grid) -> Option<Grid> {
    let [ny, nx] = grid.shape();
    let halves = |n: usize| n.is_multiple_of(2) && n / 2 >= FEWEST;
    let fits = halves(nx) && (grid.is_line() || halves(ny));
    fits.then(|| grid.with_shape([ny / 2, nx / 2]).ok())?
}

/// The pressure on the nodes of a grid of twice as many along each side, in `rows` of the half-space, interpolated linearly. Nodes
/// between a node with pressure and one without get none. Where some nodes yield at their `ceilings`, those of the coarse and of the fine
/// grid, they get some: patches that yield up to their edges could not carry the load of what is left out.
pub(in crate::contact) fn prolong(
    coarse: &[f64],
    [from, to]: [&Grid; 2],
    rows: [usize; 2],
    ceilings: [&Ceiling; 2],
) -> SparsePressure {
    let fine = to.shape()[1];
    let yields = |(i, p): (usize, &f64)| *p > 0.0 && *p >= ceilings[0].at(i);
    let fewest = if coarse.iter().enumerate().any(yields) { 1 } else { 3 };
    let (support, values) = Support::choose_values(rows, |row, nodes| {
        let first = row * rows[1];
        interpolate(coarse, from, to, first / fine, first % fine..first % fine + rows[1], |column, pressure| {
            let is_allowed = ceilings[1].at(first + column) > 0.0;
            if is_allowed && pressure.iter().filter(|p| **p > 0.0).count() >= fewest {
                nodes.push(column, mean(pressure));
            }
        });
    });
    SparsePressure { support, values }
}

/// A field on a grid of twice as many nodes along each side, interpolated linearly.
pub(super) fn interpolated(coarse: &[f64], from: &Grid, to: &Grid) -> Vec<f64> {
    let mut field = vec![0.0; to.len()];
    let width = to.shape()[1];
    chunks::rows_mut(&mut field, width, |y, row| {
        interpolate(coarse, from, to, y, 0..width, |column, values| row[column] = mean(values));
    });
    field
}

/// Hands the four values whose mean is that at some `columns` of the row `y` of the finer grid to `put`, with the places among the
/// columns.
fn interpolate(
    coarse: &[f64],
    from: &Grid,
    to: &Grid,
    y: usize,
    columns: Range<usize>,
    mut put: impl FnMut(usize, [f64; 4]),
) {
    let ([ny, nx], fine, [round_y, round_x]) = (from.shape(), to.shape(), from.periodic());
    let around = |i: usize, coarse: usize, fine: usize, is_periodic: bool| match i.div_ceil(2) {
        _ if coarse == fine => [i, i],
        next if next < coarse => [i / 2, next],
        _ => [i / 2, if is_periodic { 0 } else { coarse - 1 }],
    };
    let [y0, y1] = around(y, ny, fine[0], round_y);
    for (place, column) in columns.enumerate() {
        let [x0, x1] = around(column, nx, fine[1], round_x);
        put(place, [y0 * nx + x0, y1 * nx + x0, y0 * nx + x1, y1 * nx + x1].map(|node| coarse[node]));
    }
}

fn mean([a, b, c, d]: [f64; 4]) -> f64 {
    0.25 * ((a + b) + (c + d))
}
