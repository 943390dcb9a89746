//! The columns of a matrix that is stored row by row, transformed in place.

use super::Complex;
use super::worker::{Worker, share};
use ndarray::{ArrayViewMut2, Axis};

/// Columns that are copied out, worked on and copied back together.
pub(super) const BAND: usize = 16;

/// Columns of a band are this much apart beyond their length: at a distance of a power of two they would compete for the
/// same lines of the cache.
const PAD: usize = 4;

/// Complex numbers of a band of columns with `rows` values each.
pub(super) fn band_len(rows: usize) -> usize {
    BAND * (rows + PAD)
}

/// Calls `work(index, column, scratch)` for every column of the matrix with rows of `width`, and stores what it leaves.
///
/// Workers need bands of [`band_len`].
pub(super) fn for_each_column(
    matrix: &mut [Complex],
    width: usize,
    workers: &mut [Worker],
    work: impl Fn(usize, &mut [Complex], &mut [Complex]) + Sync + Send,
) {
    let rows = matrix.len() / width;
    let per_worker = width.div_ceil(workers.len()).next_multiple_of(BAND);
    let mut matrix = ArrayViewMut2::from_shape((rows, width), matrix).expect("rows of equal width");
    let tasks = matrix.axis_chunks_iter_mut(Axis(1), per_worker).zip(workers).enumerate();
    share(tasks, |(task, (mut columns, worker))| {
        for (i, band) in columns.axis_chunks_iter_mut(Axis(1), BAND).enumerate() {
            let first = task * per_worker + i * BAND;
            let count = band.ncols();
            gather(&band, &mut worker.band);
            for (c, column) in worker.band.chunks_exact_mut(rows + PAD).take(count).enumerate() {
                work(first + c, &mut column[..rows], &mut worker.scratch);
            }
            scatter(&worker.band, band);
        }
    });
}

fn gather(from: &ArrayViewMut2<'_, Complex>, to: &mut [Complex]) {
    let length = from.nrows() + PAD;
    for (r, row) in from.rows().into_iter().enumerate() {
        for (c, &value) in row.iter().enumerate() {
            to[c * length + r] = value;
        }
    }
}

fn scatter(from: &[Complex], mut to: ArrayViewMut2<'_, Complex>) {
    let length = to.nrows() + PAD;
    for (r, mut row) in to.rows_mut().into_iter().enumerate() {
        for (c, value) in row.iter_mut().enumerate() {
            *value = from[c * length + r];
        }
    }
}
