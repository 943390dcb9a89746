//! The columns of a matrix that is stored row by row, transformed in place.

use super::Real;
use super::worker::Worker;
use crate::chunks::spread;
use ndarray::{ArrayViewMut2, Axis, ShapeBuilder};
use rustfft::num_complex::Complex;

/// Columns that are copied out, worked on and copied back together: two cache lines of each row. Fewer would copy lines in
/// parts; twice as many took a tenth longer on 4096 x 4096 points, and gained a twentieth on lines.
const BAND: usize = 8;

/// Complex numbers of a band of columns with `rows` values each.
pub(super) fn band_len(rows: usize) -> usize {
    BAND * rows
}

/// Calls `work(index, column, row, scratch)` for every column of `rows` values, with the row and the scratch of a worker, and stores
/// what it leaves. The matrix has rows of `width`, and holds the first ones only if it is shorter than its columns: the others
/// are zero before the work, and lost after it.
///
/// Workers need bands of [`band_len`].
pub(super) fn for_each_column<T: Real>(
    matrix: &mut [Complex<T>],
    [rows, width]: [usize; 2],
    workers: &mut [Worker<T>],
    work: impl Fn(usize, &mut [Complex<T>], &mut [T], &mut [Complex<T>]) + Sync,
) {
    let held = matrix.len() / width;
    let per_worker = width.div_ceil(workers.len()).next_multiple_of(BAND);
    let mut matrix = ArrayViewMut2::from_shape((held, width), matrix).expect("rows of equal width");
    let tasks = matrix.axis_chunks_iter_mut(Axis(1), per_worker).zip(workers).enumerate();
    spread(tasks, |(task, (mut columns, Worker { row, band, scratch }))| {
        for (i, mut columns) in columns.axis_chunks_iter_mut(Axis(1), BAND).enumerate() {
            let shape = columns.dim();
            let indices = (task * per_worker + i * BAND..width).take(shape.1);
            by_columns(band, shape, rows).assign(&columns);
            for (column, index) in band.chunks_exact_mut(rows).zip(indices) {
                column[held..].fill(Complex::new(T::zero(), T::zero()));
                work(index, column, row, scratch);
            }
            columns.assign(&by_columns(band, shape, rows));
        }
    });
}

/// A band of columns of `length`, of which the first values are shown, one column after the other.
fn by_columns<T>(band: &mut [Complex<T>], shape: (usize, usize), length: usize) -> ArrayViewMut2<'_, Complex<T>> {
    ArrayViewMut2::from_shape(shape.strides((1, length)), band).expect("room for the band")
}
