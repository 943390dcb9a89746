//! Fields filtered in Fourier space.

use super::halves::Halves;
use super::long_line::LongLine;
use crate::grid::Grid;

/// Multiplies each mode of a real field by a factor of its wavenumber, `f -> F^-1[ factor(|q|) F[f] ]`, in three passes:
/// [`load`](Self::load) the field, [`scale`](Self::scale) its modes, [`store`](Self::store) the result.
///
/// Fields come and go in rows, so that they need not exist as a whole: see [`rows`](Self::rows).
///
/// Memory: one half spectrum (about one real field) and scratch for some rows and columns per thread.
pub(crate) enum Filter {
    Halves(Halves),
    LongLine(LongLine),
}

impl Filter {
    /// Plans the transforms of fields on `grid`.
    pub fn new(grid: &Grid) -> Self {
        LongLine::new(grid).map_or_else(|| Self::Halves(Halves::new(grid)), Self::LongLine)
    }

    /// The number of rows in which fields come and go, and their length. Rows follow each other without gaps; those of a
    /// surface are its rows, those of a line are pieces of it.
    pub fn rows(&self) -> [usize; 2] {
        match self {
            Self::Halves(halves) => halves.rows(),
            Self::LongLine(line) => line.rows(),
        }
    }

    /// Takes the field whose row `r` is written by `fill(r, row)`; what `row` holds before is undefined.
    pub fn load(&mut self, fill: impl Fn(usize, &mut [f64]) + Sync + Send) {
        match self {
            Self::Halves(halves) => halves.load(fill),
            Self::LongLine(line) => line.load(fill),
        }
    }

    /// Multiplies the modes by `factor(|q|)`.
    pub fn scale(&mut self, factor: impl Fn(f64) -> f64 + Sync + Send) {
        match self {
            Self::Halves(halves) => halves.scale(factor),
            Self::LongLine(line) => line.scale(factor),
        }
    }

    /// Gives row `r` of the result to `store(r, row, sink)` with the sink of that row. The result is lost.
    ///
    /// # Panics
    /// If there is not one sink per row.
    pub fn store<S: Send>(&mut self, sinks: &mut [S], store: impl Fn(usize, &[f64], &mut S) + Sync + Send) {
        assert_eq!(sinks.len(), self.rows()[0], "one sink per row");
        match self {
            Self::Halves(halves) => halves.store(sinks, store),
            Self::LongLine(line) => line.store(sinks, store),
        }
    }
}
