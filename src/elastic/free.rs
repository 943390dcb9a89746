//! A boundary without images: convolution padded with zeros.

use super::{ElasticSolid, element};
use crate::chunks;
use crate::error::GridError;
use crate::fourier::{self, Complex, Filter, Fourier, Real, smooth};
use crate::grid::Grid;
use std::f64::consts::TAU;

/// Columns that are transposed together: the values of two cache lines.
const BAND: usize = 16;

/// The influence of elements on each other, transformed over a grid that is padded with zeros along its free axes.
#[derive(Debug, Clone)]
pub(super) struct FreeTable {
    pub modulus: f64,
    padded: Grid,
    /// Displacement over pressure by the places of the filter of the padded grid.
    weights: Vec<f64>,
}

impl FreeTable {
    /// The table of a half-space.
    pub(crate) fn new(grid: &Grid, solid: &dyn ElasticSolid) -> Result<Self, GridError> {
        if !solid.is_half_space() {
            return Err(GridError::FreeSolid { solid: solid.description() });
        }
        let padded = padded(grid)?;
        let modulus = solid.contact_modulus();
        let (spacing, datum) = (grid.spacing(), datum(solid, grid.size()[1]));
        let weights = match grid.periodic() {
            [true, false] if !grid.is_line() => banded(grid, &padded, solid, 1),
            [false, true] => banded(grid, &padded, solid, 0),
            _ if grid.is_line() => transformed(&padded, |[_, x]| element::strip(x, spacing[1], datum, modulus)),
            _ => transformed(&padded, |at| element::rectangle(at, spacing, modulus)),
        };
        Ok(Self { modulus, padded, weights })
    }

    /// The table of tractions along `x` on a surface that is free along both axes, see [`super::Compliance::tangential`].
    pub(crate) fn sheared(grid: &Grid, solid: &dyn ElasticSolid, m: f64) -> Result<Self, GridError> {
        let (padded, modulus) = (padded(grid)?, solid.contact_modulus());
        let weights = transformed(&padded, |at| element::sheared_rectangle(at, grid.spacing(), modulus, m));
        Ok(Self { modulus, padded, weights })
    }

    /// The table of tractions along `y`, which is that of `x` on a turned element.
    pub(crate) fn sheared_across(grid: &Grid, solid: &dyn ElasticSolid, m: f64) -> Result<Self, GridError> {
        let (padded, modulus, [dy, dx]) = (padded(grid)?, solid.contact_modulus(), grid.spacing());
        let weights = transformed(&padded, |[y, x]| element::sheared_rectangle([x, y], [dx, dy], modulus, m));
        Ok(Self { modulus, padded, weights })
    }

    /// Points of the padded grid.
    pub(crate) fn points(&self) -> usize {
        self.padded.len()
    }

    /// Displacement over traction by the places of the filter of the padded grid.
    pub(crate) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Stiffness of the field that gives way most.
    pub(crate) fn softest(&self) -> f64 {
        self.weights.iter().fold(0.0, |most: f64, weight| most.max(weight.abs())).recip()
    }
}

/// The distance from a line load at which the displacement is zero.
pub(super) fn datum(solid: &dyn ElasticSolid, length: f64) -> f64 {
    solid.datum().unwrap_or(length)
}

/// The grid with at least twice as many points along its free axes, at the same spacing.
pub(super) fn padded(grid: &Grid) -> Result<Grid, GridError> {
    let (shape, spacing, periodic) = (grid.shape(), grid.spacing(), grid.periodic());
    let points = [0, 1].map(|axis| if periodic[axis] { shape[axis] } else { smooth(2 * shape[axis]) });
    let size = [0, 1].map(|axis| if periodic[axis] { grid.size()[axis] } else { points[axis] as f64 * spacing[axis] });
    if grid.is_line() { Grid::line(points[1], size[1]) } else { Grid::surface(points, size) }
}

/// The `influence` of an element at a distance, transformed along all axes: of lines, and of surfaces without images.
fn transformed(padded: &Grid, influence: impl Fn([f64; 2]) -> f64 + Sync) -> Vec<f64> {
    let [dy, dx] = padded.spacing();
    transformed_quarter(padded, |y, row| {
        row.iter_mut().enumerate().for_each(|(x, value)| *value = influence([dy * y as f64, dx * x as f64]));
    })
}

/// The transform of a field that is even along each axis, so that a quarter of it is enough, and so is its transform. `fill(y, row)` writes
/// row `y` up to the middle; rows are zero before.
pub(super) fn transformed_quarter(padded: &Grid, fill: impl Fn(usize, &mut [f64]) + Sync) -> Vec<f64> {
    let [my, mx] = padded.shape();
    let [height, width] = [my / 2 + 1, mx / 2 + 1];
    let mut quarter = vec![0.0; height * width];
    chunks::rows_mut(&mut quarter, width, fill);
    transform_even_rows(&mut quarter, mx);
    if padded.is_line() {
        return Filter::places(padded).into_iter().map(|[_, kx]| quarter[kx]).collect();
    }
    // the order of the places of a surface: column by column
    let mut weights = transposed(&quarter, width);
    transform_even_rows(&mut weights, my);
    weights
}

/// The sums `sum_x f(x) cos(q x)` over even rows of an even number of `points`, of which each row of `field` holds those up to the middle.
fn transform_even_rows(field: &mut [f64], points: usize) {
    let width = points / 2 + 1;
    let line = Grid::line(points, 1.0).expect("an axis of a grid is a line");
    let plan = || (Fourier::new(&line), vec![0.0; points], vec![Complex::default(); width]);
    let mut rows: Vec<_> = field.chunks_exact_mut(width).collect();
    chunks::each_with(&mut rows, width, plan, |(fourier, whole, spectrum), _, row| {
        if row.iter().all(|value| *value == 0.0) {
            return;
        }
        (0..points).for_each(|x| whole[x] = row[x.min(points - x)]);
        fourier.forward(whole, spectrum);
        row.iter_mut().zip(&*spectrum).for_each(|(value, mode)| *value = points as f64 * mode.re);
    });
}

/// The columns of rows of `width` values, one after the other.
fn transposed(field: &[f64], width: usize) -> Vec<f64> {
    let height = field.len() / width;
    let mut columns = vec![0.0; field.len()];
    chunks::rows_mut(&mut columns, BAND * height, |band, part| {
        for (y, row) in field.chunks_exact(width).enumerate() {
            let values = &row[band * BAND..width.min((band + 1) * BAND)];
            values.iter().enumerate().for_each(|(x, value)| part[x * height + y] = *value);
        }
    });
    columns
}

/// The influence of waves along the periodic axis, transformed along the axis `free`.
fn banded(grid: &Grid, padded: &Grid, solid: &dyn ElasticSolid, free: usize) -> Vec<f64> {
    let other = 1 - free;
    let (points, spacing, modulus) = (padded.shape()[free], grid.spacing()[free], solid.contact_modulus());
    let line = Grid::line(points, padded.size()[free]).expect("an axis of a grid is a line");
    let waves = padded.shape()[other] / 2 + 1;
    let bands = chunks::rows(waves, points, |k| {
        let q = TAU * k as f64 / grid.size()[other];
        let at = |i: usize| {
            let x = i.min(points - i) as f64 * spacing;
            if k == 0 {
                element::strip(x, spacing, datum(solid, grid.size()[free]), modulus)
            } else {
                element::wave(x, spacing, q, modulus)
            }
        };
        let near: Vec<f64> = (0..=points / 2).map(at).collect();
        let influence: Vec<f64> = (0..points).map(|i| near[i.min(points - i)]).collect();
        let mut spectrum = vec![Complex::default(); line.modes()];
        Fourier::new(&line).forward(&influence, &mut spectrum);
        spectrum.into_iter().map(|mode| points as f64 * mode.re).collect::<Vec<_>>()
    });
    Filter::places(padded).into_iter().map(|k| bands[k[other]][k[free]]).collect()
}

/// The convolution with a table, and its scratch: a half spectrum of the rows of the padded grid that are not padding.
pub(super) struct FreeConvolution<T: Real> {
    fields: fourier::Padded<T>,
    /// The field of a line, whose pieces are not those of the padded line.
    line: Option<Vec<T>>,
}

impl<T: Real> FreeConvolution<T> {
    pub(crate) fn new(grid: &Grid, table: &FreeTable) -> Self {
        let line = grid.is_line().then(|| vec![T::zero(); grid.len()]);
        Self { fields: fourier::Padded::new(grid.shape(), &table.padded), line }
    }

    /// Gives `unit` times the displacement under a pressure, both in `rows` of the unpadded grid, as [`super::Convolution::displace`]
    /// has them.
    pub(crate) fn convolve<S: Send>(
        &mut self,
        table: &FreeTable,
        unit: f64,
        rows: [usize; 2],
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[T], &mut S) + Sync,
    ) {
        let (width, weight) = (rows[1], |place| unit * table.weights[place]);
        let Some(line) = &mut self.line else {
            return self.fields.scale_rows(weight, fill, sinks, |r, row, sink| store(r, row, sink));
        };
        chunks::rows_mut(line, width, fill);
        self.fields.scale(line, weight);
        chunks::each(sinks, width, |r, sink| store(r, &line[r * width..][..width], sink));
    }
}
