//! Smooth kernels, applied on a coarser grid.

use super::support::Support;
use crate::chunks;
use crate::fourier::Filter;
use crate::grid::Grid;
use std::f64::consts::PI;

/// Coarse nodes along each side over which a value is spread, by cubic B-splines.
const SPREAD: usize = 4;

/// A smooth kernel on the nodes of a surface, in single precision: values are spread by B-splines onto a grid of every `side`-th node,
/// convolved there, and interpolated back by the same splines.
///
/// # Source
/// Smooth particle-mesh Ewald: Essmann et al., J. Chem. Phys. 103, 8577 (1995).
pub(super) struct Smooth {
    side: usize,
    /// Shape of the coarse grid, which may reach beyond the nodes.
    shape: [usize; 2],
    /// Weights of the coarse nodes around each of `side` nodes.
    splines: Vec<[f32; SPREAD]>,
    filter: Filter<f32>,
    factors: Vec<f32>,
    /// For each row of cells the rows of coarse nodes that its values are spread over.
    spread: Vec<f32>,
    field: Vec<f32>,
}

impl Smooth {
    /// The kernel whose transform on the `coarse` grid has the value `factor([ky, kx])` at wave numbers; it is divided by that
    /// of the splines.
    pub(crate) fn new(coarse: &Grid, side: usize, factor: impl Fn([usize; 2]) -> f64) -> Self {
        let shape = coarse.shape();
        let spline = |k: usize, n: usize| {
            let x = PI * k as f64 / n as f64;
            if k == 0 { 1.0 } else { (x.sin() / x).powi(SPREAD as i32) }
        };
        let places = Filter::places(coarse).into_iter();
        let factors = places.map(|[ky, kx]| {
            let both = spline(ky, shape[0]) * spline(kx, shape[1]);
            (factor([ky, kx]) / (both * both)) as f32
        });
        let weights = |t: f64| {
            [(1.0 - t).powi(3), 3.0 * t.powi(3) - 6.0 * t * t + 4.0, 3.0 * (t * t + t - t.powi(3)) + 1.0, t.powi(3)]
                .map(|weight| (weight / 6.0) as f32)
        };
        Self {
            side,
            shape,
            splines: (0..side).map(|i| weights(i as f64 / side as f64)).collect(),
            filter: Filter::new(coarse),
            factors: factors.collect(),
            spread: Vec::new(),
            field: vec![0.0; coarse.len()],
        }
    }

    /// Points of the coarse grid.
    pub(crate) fn points(&self) -> usize {
        self.field.len()
    }

    /// Adds to `sums` on `to` the values `down * values` on `from` convolved with the kernel, times `up`.
    pub(crate) fn add(&mut self, from: &Support, values: &[f64], to: &Support, [down, up]: [f64; 2], sums: &mut [f64]) {
        self.spread(from, values, down);
        self.convolve();
        self.gather(to, up, sums);
    }

    /// Spreads values to the coarse rows of each row of cells.
    fn spread(&mut self, from: &Support, values: &[f64], down: f64) {
        let Self { side, shape: [_, width], splines, spread, .. } = self;
        let (side, width) = (*side, *width);
        let cells = from.shape()[0] / side;
        spread.resize(cells * SPREAD * width, 0.0);
        chunks::rows_mut(spread, SPREAD * width, |cell, rows| {
            rows.fill(0.0);
            let mut line = vec![0f32; width];
            for (y, by_row) in (cell * side..).zip(splines.iter()) {
                if from.runs(y).next().is_none() {
                    continue;
                }
                line.fill(0.0);
                for (run, at) in from.runs(y) {
                    for (x, value) in run.zip(&values[at]) {
                        let value = (down * value) as f32;
                        let (cell, weights) = (x / side, &splines[x % side]);
                        (0..SPREAD).for_each(|i| line[around(cell, i, width)] += weights[i] * value);
                    }
                }
                for (row, weight) in rows.chunks_exact_mut(width).zip(by_row) {
                    row.iter_mut().zip(&line).for_each(|(to, from)| *to += weight * from);
                }
            }
        });
    }

    /// Sums what was spread, and convolves it.
    fn convolve(&mut self) {
        let Self { shape: [height, width], spread, filter, factors, field, .. } = self;
        let (height, width) = (*height, *width);
        let cells = spread.len() / SPREAD / width;
        let mut sinks: Vec<_> = field.chunks_exact_mut(width).collect();
        filter.load(|row, sums| {
            sums.fill(0.0);
            for part in 0..SPREAD {
                let cell = (row + height + 1 - part) % height;
                if cell < cells {
                    let from = &spread[(cell * SPREAD + part) * width..][..width];
                    sums.iter_mut().zip(from).for_each(|(sum, from)| *sum += from);
                }
            }
        });
        filter.scale(|wave| f64::from(factors[wave.place]));
        filter.store(&mut sinks, |_, row, sink| sink.copy_from_slice(row));
    }

    /// Interpolates to the nodes of a set.
    fn gather(&self, to: &Support, up: f64, sums: &mut [f64]) {
        let Self { side, shape: [height, width], splines, field, .. } = self;
        let (side, width) = (*side, *width);
        let mut pieces = to.pieces(sums);
        chunks::each_with(
            &mut pieces,
            to.shape()[1],
            || vec![0f32; width],
            |line, y, piece| {
                if piece.is_empty() {
                    return;
                }
                let by_row = &splines[y % side];
                let row = |i: usize| &field[around(y / side, i, *height) * width..][..width];
                let [r0, r1, r2, r3] = [row(0), row(1), row(2), row(3)];
                for (x, value) in line.iter_mut().enumerate() {
                    *value = by_row[0] * r0[x] + by_row[1] * r1[x] + by_row[2] * r2[x] + by_row[3] * r3[x];
                }
                let columns = to.runs(y).flat_map(|(run, _)| run);
                for (sum, x) in piece.iter_mut().zip(columns) {
                    let (cell, weights) = (x / side, &splines[x % side]);
                    let value: f32 = (0..SPREAD).map(|i| weights[i] * line[around(cell, i, width)]).sum();
                    *sum += up * f64::from(value);
                }
            },
        );
    }
}

/// The coarse node `i` of those around a cell, of `count` nodes.
fn around(cell: usize, i: usize, count: usize) -> usize {
    let node = cell + count + i - 1;
    if node >= 2 * count {
        node - 2 * count
    } else if node >= count {
        node - count
    } else {
        node
    }
}
