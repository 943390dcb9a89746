//! The convolution with both parts of a half-space without images.

use super::table::EwaldTable;
use super::window::SIDE;
use crate::chunks;
use crate::fourier::{Padded, Real};

/// The convolution with a table, and its scratch: a half spectrum of the near part, and coarse fields.
pub(in crate::elastic) struct EwaldConvolution<T: Real> {
    near: Padded<T>,
    far: Padded<T>,
    /// Weights of the coarse nodes of a cell at each of its nodes.
    weights: Vec<[T; SIDE]>,
    /// Each row of the field on the coarse nodes along it.
    lines: Vec<CoarseLine<T>>,
    /// The coarse field, row by row.
    coarse: Vec<T>,
    width: usize,
}

/// A row of nodes on the coarse nodes along it.
#[derive(Clone)]
struct CoarseLine<T> {
    values: Vec<T>,
    is_zero: bool,
}

impl<T: Real> EwaldConvolution<T> {
    /// The convolution of fields of `shape`.
    pub(crate) fn new(shape: [usize; 2], table: &EwaldTable) -> Self {
        let coarse @ [height, width] = table.coarse();
        Self {
            near: Padded::new(shape, table.near().0),
            far: Padded::new(coarse, table.far().0),
            weights: table.window().weights(),
            lines: vec![CoarseLine { values: vec![T::zero(); width], is_zero: true }; shape[0]],
            coarse: vec![T::zero(); height * width],
            width,
        }
    }

    /// Gives `unit` times the displacement under a pressure, as [`crate::elastic::Convolution::displace`] has it. `fill` is called twice
    /// for each row of the pressure.
    pub(crate) fn convolve<S: Send>(
        &mut self,
        table: &EwaldTable,
        unit: f64,
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &[T], &mut S) + Sync,
    ) {
        let nodes = self.near.shape()[1];
        self.spread(nodes, &fill);
        self.convolve_far(table, unit);
        self.interpolate_rows();
        let Self { near, weights, lines, .. } = self;
        let of_place = table.near().1;
        near.scale_rows(
            |place| unit * of_place[place],
            fill,
            sinks,
            |r, row, sink| {
                add_interpolated(weights, &lines[r].values, row);
                store(r, row, sink);
            },
        );
    }

    /// Spreads each row of `nodes` to the coarse nodes along it.
    fn spread(&mut self, nodes: usize, fill: &(impl Fn(usize, &mut [T]) + Sync)) {
        let weights = &self.weights;
        let row = || vec![T::zero(); nodes.next_multiple_of(SIDE)];
        chunks::each_with(&mut self.lines, nodes, row, |row, r, line| {
            fill(r, &mut row[..nodes]);
            line.values.fill(T::zero());
            line.is_zero = true;
            for (cell, values) in row.chunks_exact(SIDE).enumerate() {
                if values.iter().any(|value| *value != T::zero()) {
                    line.is_zero = false;
                    for (sum, weights) in line.values[cell..].iter_mut().zip(weights) {
                        *sum = (0..SIDE).fold(*sum, |sum, node| sum + weights[node] * values[node]);
                    }
                }
            }
        });
    }

    /// Spreads the lines to coarse rows, and convolves the coarse field.
    fn convolve_far(&mut self, table: &EwaldTable, unit: f64) {
        let Self { far, weights, lines, coarse, width, .. } = self;
        let of_place = table.far().1;
        let mut rows: Vec<_> = coarse.chunks_exact_mut(*width).collect();
        let fill = |r: usize, row: &mut [T]| {
            row.fill(T::zero());
            for (weights, cell) in weights.iter().zip((0..=r).rev()) {
                let of_cell = lines.iter().skip(cell * SIDE).zip(weights);
                of_cell.filter(|(line, _)| !line.is_zero).for_each(|(line, weight)| add(row, *weight, &line.values));
            }
        };
        far.scale_rows(|place| unit * of_place[place], fill, &mut rows, |_, row, to| to.copy_from_slice(row));
    }

    /// Takes the lines from the coarse rows.
    fn interpolate_rows(&mut self) {
        let Self { weights, lines, coarse, width, .. } = self;
        chunks::each(lines, *width, |r, line| {
            let (cell, node) = (r / SIDE, r % SIDE);
            line.values.fill(T::zero());
            let rows = coarse.chunks_exact(*width).skip(cell);
            weights.iter().zip(rows).for_each(|(weights, row)| add(&mut line.values, weights[node], row));
        });
    }
}

/// Adds `weight` times the values to sums.
fn add<T: Real>(sums: &mut [T], weight: T, values: &[T]) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum = *sum + weight * *value);
}

/// Adds to a row of nodes what the coarse nodes along it say.
fn add_interpolated<T: Real>(weights: &[[T; SIDE]], line: &[T], row: &mut [T]) {
    for (cell, values) in row.chunks_mut(SIDE).enumerate() {
        let terms = weights.iter().zip(&line[cell..]);
        let sums = terms.fold([T::zero(); SIDE], |sums, (weights, value)| {
            std::array::from_fn(|node| sums[node] + weights[node] * *value)
        });
        values.iter_mut().zip(sums).for_each(|(value, sum)| *value = *value + sum);
    }
}
