//! Fields filtered on a grid that reaches beyond them.

use super::Real;
use super::filter::Filter;
use crate::grid::Grid;

/// The filter of fields that are padded with zeros behind their last row and column, and so do not see their own images.
pub(crate) struct Padded<T: Real = f64> {
    shape: [usize; 2],
    filter: Filter<T>,
}

impl<T: Real> Padded<T> {
    /// Plans the transforms of fields of `shape` on a grid of at least as many rows and columns.
    pub(crate) fn new(shape: [usize; 2], padded: &Grid) -> Self {
        Self { shape, filter: Filter::with_used_rows(padded, shape[0]) }
    }

    /// The shape of the fields without padding.
    pub(crate) fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Multiplies the modes of a padded field by the `weight` of the [`Filter::places`] of its grid.
    pub(crate) fn scale(&mut self, field: &mut [T], weight: impl Fn(usize) -> f64 + Sync) {
        let [ny, nx] = self.shape;
        let filter = &mut self.filter;
        let (is_line, [count, padded_width]) = (ny == 1, filter.rows());
        filter.load(|r, row| {
            let first = if is_line { nx.min(r * padded_width) } else { r * nx };
            let values = &field[first..if is_line { nx.min(first + padded_width) } else { first + nx }];
            row[..values.len()].copy_from_slice(values);
            row[values.len()..].fill(T::zero());
        });
        filter.scale(|wave| weight(wave.place));
        let mut parts: Vec<&mut [T]> = field.chunks_mut(if is_line { padded_width } else { nx }).collect();
        parts.resize_with(count, Default::default);
        filter.store(&mut parts, |_, row, part| part.copy_from_slice(&row[..part.len()]));
    }

    /// Multiplies the modes of a padded surface by the `weight` of the [`Filter::places`] of its grid. The surface need not exist as a
    /// whole: `fill(r, row)` writes row `r` of the field without padding, and `store(r, row, sink)` takes row `r` of the result, which may be
    /// changed there, with its sink.
    pub(crate) fn scale_rows<S: Send>(
        &mut self,
        weight: impl Fn(usize) -> f64 + Sync,
        fill: impl Fn(usize, &mut [T]) + Sync,
        sinks: &mut [S],
        store: impl Fn(usize, &mut [T], &mut S) + Sync,
    ) {
        let (nx, filter) = (self.shape[1], &mut self.filter);
        filter.load(|r, row| {
            let (values, padding) = row.split_at_mut(nx);
            fill(r, values);
            padding.fill(T::zero());
        });
        filter.scale(|wave| weight(wave.place));
        filter.store(sinks, |r, row, sink| store(r, &mut row[..nx], sink));
    }
}

/// The least even number from `least` on with no factors but 2, 3 and 5, of which transforms are fast.
pub(crate) fn smooth(least: usize) -> usize {
    let rest = |mut n: usize| {
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n
    };
    (least..).find(|&n| n.is_multiple_of(2) && rest(n) == 1).expect("a power of two follows every number")
}
