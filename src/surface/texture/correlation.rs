//! The autocorrelation of heights.

use crate::fourier::{Complex, Fourier, smooth};
use crate::grid::Grid;
use crate::surface::Surface;
use std::f64::consts::PI;

/// Directions over half a turn in which the autocorrelation is followed: one per half degree.
const DIRECTIONS: usize = 360;

/// The autocorrelation of the heights of a surface, `R(t) = <z(x) z(x + t)> / <z^2>`.
///
/// Along a periodic axis pairs reach across the period. Along a free axis, see [`Grid::periodic`], only pairs inside of the
/// cell count, and the mean is that over their number, so that distant pairs have no less weight. Distances reach as far as half of
/// the cell along each axis. Between the nodes `R` is interpolated, linearly along each axis.
///
/// ```
/// use asperity::Grid;
/// use asperity::surface::{Autocorrelation, Indenter};
/// let surface = Indenter::Sine { amplitude: 2.0 }.surface(Grid::line(1000, 1.0)?)?;
/// let correlation = Autocorrelation::new(&surface).unwrap();
/// let q = std::f64::consts::TAU;
/// assert!((correlation.decay(0.0, 0.2).unwrap() - 0.2f64.acos() / q).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Autocorrelation {
    /// Values for distances along y and x in nodes, negative ones at the end of each axis.
    values: Vec<f64>,
    shape: [usize; 2],
    spacing: [f64; 2],
    /// The longest distances along y and x, in nodes.
    reach: [usize; 2],
}

impl Autocorrelation {
    /// The autocorrelation of `surface`; none for a flat, whose mean square is 0.
    pub fn new(surface: &Surface) -> Option<Self> {
        let grid = surface.grid();
        let (inside, periodic) = (grid.shape(), grid.periodic());
        let reach = inside.map(|n| n / 2);
        let length = |axis: usize| if periodic[axis] { inside[axis] } else { smooth(inside[axis] + reach[axis]) };
        let shape = [length(0), length(1)];
        let mut values = products(surface, shape);
        let square = values[0];
        if square <= 0.0 {
            return None;
        }
        let pairs = |axis: usize, i: usize| match i.min(shape[axis] - i) {
            _ if periodic[axis] => 1.0,
            distance => inside[axis].saturating_sub(distance) as f64 / inside[axis] as f64,
        };
        for (row, values) in values.chunks_exact_mut(shape[1]).enumerate() {
            let scale = square * pairs(0, row);
            values.iter_mut().enumerate().for_each(|(column, value)| *value /= scale * pairs(1, column));
        }
        Some(Self { values, shape, spacing: grid.spacing(), reach })
    }

    /// The distance at which the autocorrelation first falls to `level`, in a direction at an angle to the x axis in radians; none if
    /// it does not within half of the cell. For a line the angle is 0.
    pub fn decay(&self, angle: f64, level: f64) -> Option<f64> {
        let (sine, cosine) = angle.sin_cos();
        let [y, x] = [sine / self.spacing[0], cosine / self.spacing[1]];
        // at most half a node along each axis
        let step = if self.shape[0] == 1 { 0.5 / x.abs() } else { 0.5 / y.abs().max(x.abs()) };
        let mut before = 1.0;
        for i in 1.. {
            let distance = i as f64 * step;
            let value = self.between([distance * y, distance * x])?;
            if value <= level {
                return Some(distance - step * (level - value) / (before - value));
            }
            before = value;
        }
        None
    }

    /// The shortest and the longest of the distances in all directions at which the autocorrelation first falls to `level`, with a
    /// resolution of half a degree. The shortest is none if there is no such direction, the longest if there is one in which
    /// it does not fall to it.
    pub fn extremes(&self, level: f64) -> [Option<f64>; 2] {
        let directions = if self.shape[0] == 1 { 1 } else { DIRECTIONS };
        let all: Vec<Option<f64>> =
            (0..directions).map(|i| self.decay(PI * i as f64 / DIRECTIONS as f64, level)).collect();
        let longest: Option<Vec<f64>> = all.iter().copied().collect();
        [all.into_iter().flatten().reduce(f64::min), longest.and_then(|all| all.into_iter().reduce(f64::max))]
    }

    /// The value at distances along y and x in nodes; none beyond the reach.
    fn between(&self, [y, x]: [f64; 2]) -> Option<f64> {
        if y.abs() > self.reach[0] as f64 || x.abs() > self.reach[1] as f64 {
            return None;
        }
        let [ny, nx] = self.shape;
        let at = |row: f64, column: f64| {
            let [row, column] = [(row, ny), (column, nx)].map(|(i, n)| (i as i64).rem_euclid(n as i64) as usize);
            self.values[row * nx + column]
        };
        let ([row, column], [up, right]) = ([y.floor(), x.floor()], [y - y.floor(), x - x.floor()]);
        let along = |row: f64| (1.0 - right) * at(row, column) + right * at(row, column + 1.0);
        Some((1.0 - up) * along(row) + up * along(row + 1.0))
    }
}

/// Sums of the products of heights at all distances over a constant, periodic over `shape`, into which the heights are padded with zeros.
fn products(surface: &Surface, shape: [usize; 2]) -> Vec<f64> {
    let [ny, nx] = shape;
    let sides = shape.map(|n| n as f64);
    let grid = if ny == 1 { Grid::line(nx, sides[1]) } else { Grid::surface(shape, sides) };
    let grid = grid.expect("a grid no smaller than that of the surface");
    let mut field = vec![0.0; ny * nx];
    let width = surface.grid().shape()[1];
    let rows = surface.heights().chunks_exact(width);
    field.chunks_exact_mut(nx).zip(rows).for_each(|(to, from)| to[..width].copy_from_slice(from));
    let (mut fourier, mut spectrum) = (Fourier::new(&grid), vec![Complex::default(); grid.modes()]);
    fourier.forward(&field, &mut spectrum);
    spectrum.iter_mut().for_each(|mode| *mode = mode.norm_sqr().into());
    fourier.inverse(&mut spectrum, &mut field);
    field
}
