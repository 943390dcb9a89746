//! A long line, filtered on all cores.

use super::Real;
use super::columns::{band_len, for_each_column};
use super::wave::Wave;
use super::worker::Worker;
use crate::chunks::spread;
use crate::grid::Grid;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// The fewest points that are cut into rows: here two cores are 1.5 times as fast as one transform of the whole on one
/// core, and one core 1.1 times as slow.
const SHORTEST: usize = 1 << 16;

/// The fewest rows that are worth sharing.
const FEWEST_ROWS: usize = 32;

/// A line of `n = 2 N` points as the complex numbers `z = f(even) + i f(odd)`, a matrix of `n1` rows and `n2` columns with
/// `N = n1 n2`, transformed in place by columns and then by rows.
///
/// With `j = n2 j1 + j2` and `k = k1 + n1 k2` the transform of `z` is
///
/// `Z_k = sum_j2 w^(j2 k2 n1) [ w^(j2 k1) sum_j1 w^(j1 k1 n2) z_j ]`, `w = exp(-2 pi i / N)`,
///
/// which leaves `Z_k` in row `k1` and column `k2`. The modes of the field are sums of `Z_k` and `conj Z_(N-k)`, which lies in
/// row `n1 - k1`: so pairs of rows are transformed, scaled and transformed back on their own.
pub(crate) struct LongLineFilter<T: Real = f64> {
    shape: [usize; 2],
    forward: [Arc<dyn Fft<T>>; 2],
    inverse: [Arc<dyn Fft<T>>; 2],
    twiddles: Twiddles<T>,
    modes: Modes<T>,
    z: Vec<Complex<T>>,
    workers: Vec<Worker<T>>,
}

impl LongLineFilter {
    /// Wave numbers along y and x of each place, if the line can be cut.
    pub(crate) fn places(grid: &Grid) -> Option<Vec<[usize; 2]>> {
        let [n1, n2] = cut(grid)?;
        Some((0..=n1).flat_map(|k1| (0..n2).map(move |k2| [0, k1 + n1 * k2])).collect())
    }

    /// The rows of the filter of a line, if the line can be cut.
    pub(crate) fn rows_of(grid: &Grid) -> Option<[usize; 2]> {
        cut(grid).map(pieces)
    }
}

impl<T: Real> LongLineFilter<T> {
    /// Plans the transforms, if `grid` is a line that is long enough and can be cut into rows.
    pub(crate) fn new(grid: &Grid) -> Option<Self> {
        let (n, shape) = (grid.len(), cut(grid)?);
        let mut planner = FftPlanner::new();
        let forward = shape.map(|n| planner.plan_fft_forward(n));
        let inverse = shape.map(|n| planner.plan_fft_inverse(n));
        let scratch = forward.iter().chain(&inverse).map(|fft| fft.get_inplace_scratch_len()).fold(0, usize::max);
        Some(Self {
            shape,
            forward,
            inverse,
            twiddles: Twiddles::new(shape),
            modes: Modes::new(shape, TAU / grid.size()[1]),
            z: vec![Complex::new(T::zero(), T::zero()); n / 2],
            workers: Worker::crew(n, shape[0], [2 * shape[1], band_len(shape[0]).max(shape[1]), scratch]),
        })
    }

    pub(crate) fn rows(&self) -> [usize; 2] {
        pieces(self.shape)
    }

    pub(crate) fn load(&mut self, fill: impl Fn(usize, &mut [T]) + Sync) {
        let [n1, n2] = self.shape;
        let per_worker = n1.div_ceil(self.workers.len());
        let tasks = self.z.chunks_mut(per_worker * n2).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, (z, Worker { row, .. }))| {
            for (i, z) in z.chunks_exact_mut(n2).enumerate() {
                fill(task * per_worker + i, row);
                z.iter_mut().zip(row.chunks_exact(2)).for_each(|(z, f)| *z = Complex::new(f[0], f[1]));
            }
        });
    }

    pub(crate) fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &mut [T], &mut S) + Sync) {
        let [n1, n2] = self.shape;
        let per_worker = n1.div_ceil(self.workers.len());
        let tasks = self.z.chunks(per_worker * n2).zip(sinks.chunks_mut(per_worker)).zip(&mut self.workers).enumerate();
        spread(tasks, |(task, ((z, sinks), Worker { row, .. }))| {
            for (i, (z, sink)) in z.chunks_exact(n2).zip(sinks).enumerate() {
                row.chunks_exact_mut(2).zip(z).for_each(|(f, z)| f.copy_from_slice(&[z.re, z.im]));
                store(task * per_worker + i, row, sink);
            }
        });
    }

    pub(crate) fn scale(&mut self, factor: impl Fn(Wave) -> f64 + Sync) {
        for_each_column(&mut self.z, self.shape, &mut self.workers, |j2, column, _, scratch| {
            self.forward[0].process_with_scratch(column, scratch);
            self.twiddles.column(j2).zip(column).for_each(|(w, z)| *z = *z * w);
        });
        self.scale_rows(factor);
        for_each_column(&mut self.z, self.shape, &mut self.workers, |j2, column, _, scratch| {
            self.twiddles.column(j2).zip(&mut *column).for_each(|(w, z)| *z = *z * w.conj());
            self.inverse[0].process_with_scratch(column, scratch);
        });
    }

    /// Transforms each row `k1` and its mirror image `n1 - k1`, scales their modes, and transforms them back.
    fn scale_rows(&mut self, factor: impl Fn(Wave) -> f64 + Sync) {
        let ([n1, n2], modes) = (self.shape, &self.modes);
        let (forward, inverse) = (self.forward[1].as_ref(), self.inverse[1].as_ref());
        let (zeroth, others) = self.z.split_at_mut(n2);
        let (front, back) = others.split_at_mut(n1 / 2 * n2);
        let (front, middle) = front.split_at_mut((n1 - 1) / 2 * n2);
        let per_worker = (n1 / 2).div_ceil(self.workers.len());
        let pairs = front.chunks_mut(per_worker * n2).zip(back.rchunks_mut(per_worker * n2));
        spread(pairs.zip(&mut self.workers).enumerate(), |(task, ((front, back), Worker { scratch, .. }))| {
            let pairs = front.chunks_exact_mut(n2).zip(back.rchunks_exact_mut(n2));
            for (i, (row, mirror)) in pairs.enumerate() {
                forward.process_with_scratch(row, scratch);
                forward.process_with_scratch(mirror, scratch);
                modes.scale(1 + task * per_worker + i, row, mirror, &factor);
                inverse.process_with_scratch(row, scratch);
                inverse.process_with_scratch(mirror, scratch);
            }
        });
        let Worker { band, scratch, .. } = &mut self.workers[0];
        for (k1, row, turn) in [(0, zeroth, 1), (n1 / 2, middle, 0)] {
            if !row.is_empty() {
                forward.process_with_scratch(row, scratch);
                let mirror = &mut band[..n2];
                mirror.copy_from_slice(row);
                mirror.rotate_left(turn);
                modes.scale(k1, row, mirror, &factor);
                inverse.process_with_scratch(row, scratch);
            }
        }
    }
}

/// Rows and columns of the matrix of a line that is long enough and can be cut.
fn cut(grid: &Grid) -> Option<[usize; 2]> {
    let n = grid.len();
    if !grid.is_line() || n < SHORTEST || n % 2 == 1 {
        return None;
    }
    let n1 = (FEWEST_ROWS..=(n / 2).isqrt()).rev().find(|n1| (n / 2).is_multiple_of(*n1))?;
    Some([n1, n / 2 / n1])
}

/// `w^(j2 k1)` as products of two short tables, for `j2` in coarse and in fine steps.
struct Twiddles<T: Real> {
    rows: usize,
    step: usize,
    coarse: Vec<Complex<T>>,
    fine: Vec<Complex<T>>,
}

impl<T: Real> Twiddles<T> {
    fn new([n1, n2]: [usize; 2]) -> Self {
        let step = n2.isqrt();
        let power = |j2: usize, k1: usize| turn(-TAU * (j2 * k1 % (n1 * n2)) as f64 / (n1 * n2) as f64);
        let table = |count: usize, step: usize| -> Vec<Complex<T>> {
            (0..count).flat_map(|j| (0..n1).map(move |k1| (j * step, k1))).map(|(j2, k1)| power(j2, k1)).collect()
        };
        Self { rows: n1, step, coarse: table(n2.div_ceil(step), step), fine: table(step, 1) }
    }

    /// The factors of column `j2`.
    fn column(&self, j2: usize) -> impl Iterator<Item = Complex<T>> {
        let coarse = &self.coarse[j2 / self.step * self.rows..][..self.rows];
        let fine = &self.fine[j2 % self.step * self.rows..][..self.rows];
        coarse.iter().zip(fine).map(|(a, b)| a * b)
    }
}

/// The modes of the field, as pairs `Z_k` and `Z_(N-k)`.
struct Modes<T: Real> {
    shape: [usize; 2],
    /// Wavenumbers of `k1` in the first column, up to `n1`, and of `n1 k2` in the first row.
    row_q: Vec<f64>,
    column_q: Vec<f64>,
    /// `i exp(i pi k1 / N)`.
    row_turns: Vec<Complex<T>>,
    /// `exp(i pi k2 / n2)`.
    column_turns: Vec<Complex<T>>,
}

impl<T: Real> Modes<T> {
    fn new([n1, n2]: [usize; 2], q: f64) -> Self {
        let row_turns =
            (0..n1).map(|k1| Complex::new(T::zero(), T::one()) * turn(PI * k1 as f64 / (n1 * n2) as f64)).collect();
        let column_turns = (0..n2).map(|k2| turn(PI * k2 as f64 / n2 as f64)).collect();
        let row_q = (0..=n1).map(|k1| q * k1 as f64).collect();
        let column_q = (0..n2).map(|k2| q * (n1 * k2) as f64).collect();
        Self { shape: [n1, n2], row_q, column_q, row_turns, column_turns }
    }

    /// Multiplies the modes in row `k1` and in its `mirror` image by `factor(q)`, and by `1 / N` for the transforms.
    ///
    /// With `E + P = Z_k`, `E - P = conj Z_(N-k)` and `v = i exp(i pi k / N)` the modes of the field are `E + conj(v) P`
    /// and, mirrored, `E - conj(v) P`. Scaled by `s + d` and `s - d` they are those of `s E + d conj(v) P` and `s P + d v E`.
    fn scale(&self, k1: usize, row: &mut [Complex<T>], mirror: &mut [Complex<T>], factor: impl Fn(Wave) -> f64) {
        let [n1, n2] = self.shape;
        let norm = 0.25 / (n1 * n2) as f64;
        let (q, mirror_q, turn) = (self.row_q[k1], self.row_q[n1 - k1], self.row_turns[k1]);
        let (row, mirror, v) = (&mut row[..n2], &mut mirror[..n2], &self.column_turns[..n2]);
        let column_q = &self.column_q[..n2];
        for (k2, mirror_k2) in (0..n2).zip((0..n2).rev()) {
            let wave = Wave { q: q + column_q[k2], place: k1 * n2 + k2 };
            let mirror_wave = Wave { q: mirror_q + column_q[mirror_k2], place: (n1 - k1) * n2 + mirror_k2 };
            let (z, mirror, v) = (&mut row[k2], &mut mirror[mirror_k2], v[k2]);
            let [a, b] = [wave, mirror_wave].map(|wave| T::from_double(norm * factor(wave)));
            let v = turn * v;
            let (s, d) = (a + b, a - b);
            let (e, p) = (*z + mirror.conj(), *z - mirror.conj());
            let (e, p) = (e * s + v.conj() * p * d, p * s + v * e * d);
            *z = e + p;
            *mirror = (e - p).conj();
        }
    }
}

/// Rows of the field that are rows of the matrix.
fn pieces([n1, n2]: [usize; 2]) -> [usize; 2] {
    [n1, 2 * n2]
}

fn turn<T: Real>(angle: f64) -> Complex<T> {
    Complex::new(T::from_double(angle.cos()), T::from_double(angle.sin()))
}
