//! Sums over neighbours.

use super::support::Support;
use crate::chunks;
use std::ops::Range;

/// Sources that are added to a row together.
const BLOCK: usize = 4;

/// A symmetric kernel of short range on the nodes of a surface, in single precision, applied to vectors on sets. Its cost grows with
/// the nodes of the source, and not with the grid.
pub(super) struct Stencil {
    /// Half the width of the longest row.
    reach: usize,
    /// Rows at the distances `0, 1, ...`.
    rows: Vec<StencilRow>,
    shape: [usize; 2],
    periodic: [bool; 2],
}

/// The kernel at `-half..=half`, with room for a block before and after.
struct StencilRow {
    half: usize,
    padded: Vec<f32>,
}

impl Stencil {
    /// The kernel with the value `kernel([dy, dx])` at nodes within the ellipse of the half axes `reach`, on a grid of `shape`.
    pub(crate) fn new(
        shape: [usize; 2],
        periodic: [bool; 2],
        [along_y, along_x]: [f64; 2],
        kernel: impl Fn([usize; 2]) -> f64,
    ) -> Self {
        let row = |dy: usize| {
            let half = (along_x * (1.0 - (dy as f64 / along_y).powi(2)).max(0.0).sqrt()) as usize;
            let mut padded = vec![0.0; 2 * half + 1 + 2 * (BLOCK - 1)];
            (0..=2 * half).for_each(|x| padded[BLOCK - 1 + x] = kernel([dy, half.abs_diff(x)]) as f32);
            StencilRow { half, padded }
        };
        Self { reach: along_x as usize, rows: (0..=along_y as usize).map(row).collect(), shape, periodic }
    }

    /// Values of the kernel that are not zero.
    pub(crate) fn values(&self) -> usize {
        self.rows.iter().enumerate().map(|(dy, row)| (2 * row.half + 1) * if dy == 0 { 1 } else { 2 }).sum()
    }

    /// The sum of the values of the kernel.
    pub(crate) fn sum(&self) -> f64 {
        let of = |row: &StencilRow| row.padded.iter().map(|&value| f64::from(value)).sum::<f64>();
        self.rows.iter().enumerate().map(|(dy, row)| of(row) * if dy == 0 { 1.0 } else { 2.0 }).sum()
    }

    /// Adds to `sums` on `to` the values `down * values` on `from` spread by the kernel, times `up`.
    pub(crate) fn add(&self, from: &Support, values: &[f64], to: &Support, [down, up]: [f64; 2], sums: &mut [f64]) {
        let [ny, nx] = self.shape;
        let values: Vec<f32> = values.iter().map(|value| (down * value) as f32).collect();
        let mut pieces = to.pieces(sums);
        let width = nx + 2 * self.reach + BLOCK;
        chunks::each_with(
            &mut pieces,
            nx,
            || vec![0f32; width],
            |row, y, piece| {
                if piece.is_empty() {
                    return;
                }
                self.clear(to, y, row);
                let last = self.rows.len() as isize - 1;
                for dy in -last..=last {
                    let source = y as isize + dy;
                    let source = if self.periodic[0] { source.rem_euclid(ny as isize) } else { source };
                    if (0..ny as isize).contains(&source) {
                        let kernel = &self.rows[dy.unsigned_abs()];
                        for (run, at) in from.runs(source as usize) {
                            self.spread(kernel, run.start, &values[at], row);
                        }
                    }
                }
                if self.periodic[1] {
                    fold(row, self.reach, nx);
                }
                let mut sums = piece.iter_mut();
                for (run, _) in to.runs(y) {
                    let nodes = &row[run.start + self.reach..run.end + self.reach];
                    nodes.iter().zip(&mut sums).for_each(|(node, sum)| *sum += up * f64::from(*node));
                }
            },
        );
    }

    /// Clears a row where it is read: at the nodes of the set, and in the margins.
    fn clear(&self, to: &Support, y: usize, row: &mut [f32]) {
        let nx = self.shape[1];
        row[..2 * self.reach].fill(0.0);
        row[nx..].fill(0.0);
        for (run, _) in to.runs(y) {
            row[run.start + self.reach..run.end + self.reach].fill(0.0);
        }
    }

    /// Adds a run of values from the column `first` on, spread by a row of the kernel.
    fn spread(&self, kernel: &StencilRow, first: usize, values: &[f32], row: &mut [f32]) {
        let length = 2 * kernel.half + BLOCK;
        let shifted = |by: usize| &kernel.padded[BLOCK - 1 - by..][..length];
        let [k0, k1, k2, k3] = [shifted(0), shifted(1), shifted(2), shifted(3)];
        for (block, values) in values.chunks(BLOCK).enumerate() {
            let at = first + block * BLOCK + self.reach - kernel.half;
            let value = |i: usize| values.get(i).copied().unwrap_or(0.0);
            let [v0, v1, v2, v3] = [value(0), value(1), value(2), value(3)];
            let row = &mut row[at..at + length];
            for i in 0..length {
                row[i] += v0 * k0[i] + v1 * k1[i] + v2 * k2[i] + v3 * k3[i];
            }
        }
    }
}

/// Adds the margins of a periodic row to its other end.
fn fold(row: &mut [f32], reach: usize, nx: usize) {
    let shift = |row: &mut [f32], from: Range<usize>, to: usize| {
        from.enumerate().for_each(|(i, from)| row[to + i] += row[from]);
    };
    shift(row, 0..reach, nx);
    shift(row, nx + reach..nx + 2 * reach, reach);
}
