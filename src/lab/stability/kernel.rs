//! What a pressure displaces, by code of its own, and what that is worth beside a sum over images.

use crate::elastic::{ElasticSolid, HalfSpace, direct};
use crate::error::GridError;
use crate::fourier::Complex;
use crate::grid::Grid;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Largest number of nodes for which the sum is computed directly.
const DIRECT: usize = 1000;
/// Images of the cell on each side, in a small window and in one three times as wide.
const IMAGES: [i32; 2] = [24, 73];
/// Widths of the pressure that is summed over images, in spacings: smooth on the grid, and gone at the distance that is looked at.
const WIDTH: f64 = 3.0;

/// The displacement under `pressure`, row by row and with zero mean: small grids by the direct sum, larger ones by a
/// plain transform for any length. The mean pressure is subtracted first: it displaces nothing, but would be rounded.
/// Free grids are summed directly.
pub(crate) fn displacement(grid: &Grid, solid: &dyn ElasticSolid, pressure: &[f64]) -> Vec<f64> {
    if !grid.is_periodic() {
        return direct::displacement(grid, solid, pressure);
    }
    let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
    let pressure: Vec<f64> = pressure.iter().map(|p| p - mean).collect();
    if grid.len() <= DIRECT { direct::displacement(grid, solid, &pressure) } else { by_modes(grid, solid, &pressure) }
}

/// `u_q = factor 2 p_q / (E* |q|)`.
fn by_modes(grid: &Grid, solid: &dyn ElasticSolid, pressure: &[f64]) -> Vec<f64> {
    let ([ny, nx], [ly, lx], n) = (grid.shape(), grid.size(), grid.len() as f64);
    let signed = |k: usize, n: usize| k.min(n - k) as f64;
    let modes = transform(pressure.iter().map(|&p| Complex::new(p, 0.0)).collect(), [ny, nx], -1.0);
    let modes = modes.into_iter().enumerate().map(|(i, mode)| {
        let q = TAU * (signed(i / nx, ny) / ly).hypot(signed(i % nx, nx) / lx);
        if q > 0.0 { mode * (solid.factor(q) * 2.0 / (solid.contact_modulus() * q * n)) } else { Complex::default() }
    });
    transform(modes.collect(), [ny, nx], 1.0).into_iter().map(|u| u.re).collect()
}

/// The sums `sum x exp(sign i k x)` along rows, then along columns.
fn transform(mut field: Vec<Complex>, [ny, nx]: [usize; 2], sign: f64) -> Vec<Complex> {
    field.chunks_mut(nx).for_each(|row| row.copy_from_slice(&transform_one(row, sign)));
    for x in 0..nx {
        let column: Vec<Complex> = (0..ny).map(|y| field[y * nx + x]).collect();
        transform_one(&column, sign).into_iter().enumerate().for_each(|(y, value)| field[y * nx + x] = value);
    }
    field
}

/// Cooley and Tukey's splitting by the smallest factor of the length, down to a single value.
fn transform_one(values: &[Complex], sign: f64) -> Vec<Complex> {
    let n = values.len();
    let Some(factor) = (2..=n).find(|factor| n.is_multiple_of(*factor)) else { return values.into() };
    let every = |r: usize| values.iter().skip(r).step_by(factor).copied().collect::<Vec<_>>();
    let parts: Vec<Vec<Complex>> = (0..factor).map(|r| transform_one(&every(r), sign)).collect();
    let turn = |turns: usize| Complex::from_polar(1.0, sign * TAU * (turns % n) as f64 / n as f64);
    (0..n).map(|k| (0..factor).map(|r| turn(r * k) * parts[r][k % (n / factor)]).sum()).collect()
}

/// The displacement beside a sum over images of the cell, of Flamant's solution under a line load and Boussinesq's under a point
/// load: how far they differ, over the largest displacement; displays as a table.
pub struct Kernel {
    differences: [(&'static str, f64); 4],
}

impl Kernel {
    /// Compares on a line that is summed directly, and on a line and surfaces that are transformed.
    ///
    /// # Errors
    /// None that is known: the grids are fixed.
    pub fn measure() -> Result<Self, GridError> {
        let line = |points| Grid::line(points, 2.0);
        let surface = |shape| Grid::surface(shape, [2.0, 3.0]);
        Ok(Self {
            differences: [
                ("line of 128 points", difference(&line(128)?)),
                ("line of 6561 points", difference(&line(6561)?)),
                ("surface of 48 x 64 points", difference(&surface([48, 64])?)),
                ("surface of 72 x 90 points", difference(&surface([72, 90])?)),
            ],
        })
    }

    /// Whether both agree.
    pub fn agrees(&self) -> bool {
        self.differences.iter().all(|(_, difference)| *difference < 1e-5)
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "displacement of the check and of a sum over images {:>12}", "difference")?;
        self.differences.iter().try_for_each(|(name, difference)| writeln!(f, "{name:<50} {difference:>12.1e}"))
    }
}

/// How far both displacements differ at some nodes far from the pressure, over the largest of them; each less its value at the last
/// one, since a sum over images leaves the datum open.
fn difference(grid: &Grid) -> f64 {
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    let pressure = bump(grid);
    let (computed, sources) = (displacement(grid, &HalfSpace::new(1.0), &pressure), sources(grid, &pressure));
    let both = |x: usize| {
        let y = ny / 2;
        [computed[y * nx + x], images(grid, &sources, [y as f64 * dy, x as f64 * dx])]
    };
    let last = both(nx / 2);
    let others = (0..4).map(|i| nx / 4 + i * (nx / 2 - nx / 4) / 4).map(both);
    let [worst, largest] = others.fold([0.0_f64; 2], |[worst, largest], [computed, image]| {
        let [computed, image] = [computed - last[0], image - last[1]];
        [worst.max((computed - image).abs()), largest.max(image.abs())]
    });
    worst / largest
}

/// A smooth pressure about the first node.
fn bump(grid: &Grid) -> Vec<f64> {
    let [ny, nx] = grid.shape();
    let square = |i: usize, n: usize| (i.min(n - i) as f64 / WIDTH).powi(2);
    (0..grid.len()).map(|i| (-square(i / nx, ny) - square(i % nx, nx)).exp()).collect()
}

/// Places along y and x of the nodes that a pressure acts on, about the origin, and their pressures.
fn sources(grid: &Grid, pressure: &[f64]) -> Vec<[f64; 3]> {
    let ([ny, nx], [dy, dx]) = (grid.shape(), grid.spacing());
    let signed = |i: usize, n: usize| if 2 * i > n { i as f64 - n as f64 } else { i as f64 };
    let at = |(i, &p): (usize, &f64)| [signed(i / nx, ny) * dy, signed(i % nx, nx) * dx, p];
    pressure.iter().enumerate().filter(|(_, p)| **p > f64::EPSILON).map(at).collect()
}

/// The displacement at a place, for a modulus of 1: what the sums over a small and a wide window of images tend to, as the rest falls
/// with their size.
fn images(grid: &Grid, sources: &[[f64; 3]], [y, x]: [f64; 2]) -> f64 {
    let ([ly, lx], [dy, dx]) = (grid.size(), grid.spacing());
    let of = |images: i32| {
        let rows = if grid.is_line() { 0..=0 } else { -images..=images };
        let cells =
            rows.flat_map(|row| (-images..=images).map(move |column| [f64::from(row) * ly, f64::from(column) * lx]));
        let one = |[cy, cx]: [f64; 2], [sy, sx, pressure]: [f64; 3]| {
            let distance = (y - sy - cy).hypot(x - sx - cx);
            if grid.is_line() {
                -2.0 / PI * distance.ln() * pressure * dx
            } else {
                pressure * dy * dx / (PI * distance)
            }
        };
        cells.map(|cell| sources.iter().map(|source| one(cell, *source)).sum::<f64>()).sum::<f64>()
    };
    let [small, wide] = IMAGES.map(of);
    1.5 * wide - 0.5 * small
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plain_transform_is_the_direct_sum_on_any_grid() {
        let lines = [31, 60].map(|points| Grid::line(points, 2.0).unwrap());
        let surfaces = [[12, 35], [8, 16]].map(|shape| Grid::surface(shape, [1.0, 3.0]).unwrap());
        for grid in lines.into_iter().chain(surfaces) {
            let pressure: Vec<f64> = (0..grid.len()).map(|i| ((i * i) as f64 * 0.7).sin()).collect();
            let (plain, direct) = (
                by_modes(&grid, &HalfSpace::new(3.0), &pressure),
                direct::displacement(&grid, &HalfSpace::new(3.0), &pressure),
            );
            assert!(plain.iter().zip(&direct).all(|(a, b)| (a - b).abs() < 1e-13), "{grid:?}");
        }
    }
}
