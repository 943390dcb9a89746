//! Fields filtered in Fourier space.

use super::Real;
use super::line::LineFilter;
use super::long_line::LongLineFilter;
use super::surface::SurfaceFilter;
use super::wave::Wave;
use crate::grid::Grid;

/// Multiplies each mode of a real field by a factor that depends on its [`Wave`], `f -> F^-1[ factor F[f] ]`, in three
/// passes: [`load`](Self::load) the field, [`scale`](Self::scale) its modes, [`store`](Self::store) the result.
///
/// Fields are passed row by row, so that they need not exist as a whole: see [`rows`](Self::rows).
///
/// Memory: one half spectrum (about one real field) and scratch for some rows and columns per thread.
pub(crate) enum Filter<T: Real = f64> {
    Surface(SurfaceFilter<T>),
    Line(LineFilter<T>),
    LongLine(LongLineFilter<T>),
}

/// `$call` on the filter of whichever kind.
macro_rules! each_kind {
    ($self:ident, $filter:ident => $call:expr) => {
        match $self {
            Self::Surface($filter) => $call,
            Self::Line($filter) => $call,
            Self::LongLine($filter) => $call,
        }
    };
}

impl Filter {
    /// The [`rows`](Self::rows) of a filter of `grid`, without planning it.
    pub(crate) fn rows_of(grid: &Grid) -> [usize; 2] {
        let as_pieces = || LongLineFilter::rows_of(grid).unwrap_or([1, grid.len()]);
        if grid.is_line() { as_pieces() } else { grid.shape() }
    }

    /// Wave numbers along y and x, below or at Nyquist, of each place in the tables of the filter of a grid.
    pub(crate) fn places(grid: &Grid) -> Vec<[usize; 2]> {
        if !grid.is_line() {
            return SurfaceFilter::places(grid);
        }
        LongLineFilter::places(grid).unwrap_or_else(|| LineFilter::places(grid))
    }
}

impl<T: Real> Filter<T> {
    /// Plans the transforms of fields on `grid`.
    pub(crate) fn new(grid: &Grid) -> Self {
        Self::with_used_rows(grid, grid.shape()[0])
    }

    /// Plans the transforms of fields on a surface's `grid` of which only the first rows are not zero, and only these
    /// rows are needed.
    pub(crate) fn with_used_rows(grid: &Grid, used_rows: usize) -> Self {
        if !grid.is_line() {
            return Self::Surface(SurfaceFilter::new(grid, used_rows));
        }
        LongLineFilter::new(grid).map_or_else(|| Self::Line(LineFilter::new(grid)), Self::LongLine)
    }

    /// The number of rows in which fields come and go, and their length. Rows follow each other without gaps; those of a
    /// surface are its rows, those of a line are pieces of it.
    pub(crate) fn rows(&self) -> [usize; 2] {
        each_kind!(self, filter => filter.rows())
    }

    /// Takes the field whose row `r` is written by `fill(r, row)`; what `row` holds before is undefined.
    pub(crate) fn load(&mut self, fill: impl Fn(usize, &mut [T]) + Sync) {
        each_kind!(self, filter => filter.load(fill))
    }

    /// Multiplies the modes by the factors of their waves.
    pub(crate) fn scale(&mut self, factor: impl Fn(Wave) -> f64 + Sync) {
        each_kind!(self, filter => filter.scale(factor))
    }

    /// Gives row `r` of the result, which may be changed there, to `store(r, row, sink)` with the sink of that row. The result is lost.
    ///
    /// # Panics
    /// If there is not one sink per row.
    pub(crate) fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &mut [T], &mut S) + Sync) {
        assert_eq!(sinks.len(), self.rows()[0], "one sink per row");
        each_kind!(self, filter => filter.store(sinks, store))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::{Complex, Fourier};

    fn noise(n: usize) -> Vec<f64> {
        (0..n).map(|i| ((i % 1009 * (i % 911)) as f64 * 0.7).sin() + 0.3).collect()
    }

    fn line(points: usize) -> Grid {
        Grid::line(points, 2.0).unwrap()
    }

    fn factor(q: f64) -> f64 {
        1.0 / (1.0 + 0.1 * q)
    }

    fn filtered(grid: &Grid, field: &[f64]) -> Vec<f64> {
        let mut filter = Filter::new(grid);
        let [count, width] = filter.rows();
        let mut rows = vec![Vec::new(); count];
        filter.load(|r, row| row.copy_from_slice(&field[r * width..][..width]));
        filter.scale(|wave| factor(wave.q));
        filter.store(&mut rows, |_, row, sink| *sink = row.to_vec());
        rows.concat()
    }

    /// The field filtered by the plain pair, whose own test is the definition, with wavenumbers of the grid.
    fn by_the_pair(grid: &Grid, field: &[f64]) -> Vec<f64> {
        let mut fourier = Fourier::new(grid);
        let mut spectrum = vec![Complex::default(); grid.modes()];
        fourier.forward(field, &mut spectrum);
        spectrum.iter_mut().zip(grid.wavenumbers()).for_each(|(mode, q)| *mode *= factor(q));
        let mut result = vec![0.0; field.len()];
        fourier.inverse(&mut spectrum, &mut result);
        result
    }

    #[test]
    fn filter_is_the_transform_pair_on_awkward_grids() {
        let surface = |shape| Grid::surface(shape, [1.0, 3.0]).unwrap();
        let short = [line(4), line(5), line(31), line(4099)];
        let surfaces =
            [[4, 4], [7, 5], [5, 12], [12, 16], [17, 9], [33, 4], [4, 37], [181, 200], [256, 129]].map(surface);
        // Powers of two; an odd number of rows, of columns, and of both; a prime number of points and twice one.
        let long = [1 << 16, 1 << 17, 2 * 255 * 256, 2 * 256 * 257, 2 * 255 * 257, 65537, 2 * 65537].map(line);
        for grid in short.into_iter().chain(surfaces).chain(long) {
            let field = noise(grid.len());
            for (fast, slow) in filtered(&grid, &field).iter().zip(by_the_pair(&grid, &field)) {
                assert!((fast - slow).abs() < 1e-14, "{grid:?}: {fast} against {slow}");
            }
        }
    }

    #[test]
    fn long_lines_are_cut_into_rows_if_their_points_have_factors() {
        let rows = |points| Filter::<f64>::new(&line(points)).rows();
        assert_eq!(rows(1 << 15), [1, 1 << 15]);
        assert_eq!(rows(1 << 16), [128, 512]);
        assert_eq!(rows(2 * 255 * 256), [255, 512]);
        assert_eq!(rows(2 * 65537), [1, 2 * 65537]);
        assert_eq!(rows(65537), [1, 65537]);
    }
}
