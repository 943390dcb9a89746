//! Reductions: fewer values than nodes without losing an extreme, so that drawings never skip a node.

use crate::grid::Grid;
use std::ops::Range;

/// Pixels along the longer side of an image.
const PIXELS: usize = 512;

/// Nodes of cell `cell` when `nodes` are shared out over `cells`, on a grid with every `stride`-th of them and by their
/// numbers there: the ones inside, or the nearest.
fn share(nodes: usize, stride: usize, cells: usize, cell: usize) -> Range<usize> {
    let start = cell * nodes / cells;
    let end = ((cell + 1) * nodes / cells).max(start + 1);
    let inside = start.div_ceil(stride)..end.div_ceil(stride);
    if !inside.is_empty() {
        return inside;
    }
    let nearest = (start.midpoint(end) + stride / 2) / stride % (nodes / stride);
    nearest..nearest + 1
}

/// The points of a curve, shared out over columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Columns {
    points: usize,
    count: usize,
}

impl Columns {
    /// About as many columns as a large picture has pixels; a curve keeps two points of each.
    pub(crate) const MOST: usize = 1024;

    /// The columns of a curve of `points`; a short one keeps one column per point.
    pub(crate) fn new(points: usize) -> Self {
        Self { points, count: if points <= 2 * Self::MOST { points } else { Self::MOST } }
    }

    /// The points of each column, from left to right.
    fn ranges(self) -> impl Iterator<Item = Range<usize>> {
        (0..self.count).map(move |column| share(self.points, 1, self.count, column))
    }

    /// The points that hold the smallest and the largest value of each column, in the order in which they lie on the curve.
    pub(crate) fn extremes<T: Copy + PartialOrd>(self, value: impl Fn(usize) -> T) -> Vec<(usize, T)> {
        let mut points = Vec::with_capacity(2 * self.count);
        self.ranges().for_each(|range| points.extend(ends(range, &value)));
        points
    }

    /// The curve of a field, with the extremes of each column as in [`Columns::extremes`].
    pub(crate) fn curve(self, value: impl Fn(usize) -> f64) -> FieldCurve {
        let mut points = Vec::with_capacity(2 * self.count);
        let mut columns = Vec::with_capacity(self.count);
        for range in self.ranges() {
            let (start, middle) = (points.len(), 0.5 * (range.start + range.end - 1) as f64);
            points.extend(ends(range, &value));
            columns.push((middle, start..points.len()));
        }
        FieldCurve { points, columns }
    }

    /// The number of columns.
    pub(crate) fn count(self) -> usize {
        self.count
    }

    /// Runs of columns in which any point holds, as runs of their points.
    pub(crate) fn runs(self, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for column in self.ranges().filter(|column| column.clone().any(&holds)) {
            match runs.last_mut() {
                Some(run) if run.end == column.start => run.end = column.end,
                _ => runs.push(column),
            }
        }
        runs
    }
}

/// A curve with the points of the smallest and of the largest value of each column.
pub(crate) struct FieldCurve {
    /// Numbers and values of the points, from left to right.
    pub points: Vec<(usize, f64)>,
    /// The middle of each column, as a point with a fraction, and where among the points its own lie.
    columns: Vec<(f64, Range<usize>)>,
}

impl FieldCurve {
    /// Where among the points the pieces of the columns lie, which reach to the next one; the last one begins in the one before.
    pub(crate) fn pieces(&self) -> impl ExactSizeIterator<Item = Range<usize>> + Clone {
        let last = self.points.len();
        self.columns.iter().map(move |(_, own)| match own.end < last {
            true => own.start..own.end + 1,
            false => own.start.saturating_sub(1)..last,
        })
    }

    /// The middle of each column, and the value of the point in it that `pick` prefers.
    pub(crate) fn values(&self, pick: impl Fn(f64, f64) -> f64) -> impl Iterator<Item = (f64, f64)> {
        self.columns.iter().map(move |(middle, own)| {
            let values = self.points[own.clone()].iter().map(|point| point.1);
            (*middle, values.reduce(&pick).unwrap_or_default())
        })
    }
}

/// The points of the smallest and of the largest value in `range`, in their order, or the one that is both.
fn ends<T: Copy + PartialOrd>(range: Range<usize>, value: &impl Fn(usize) -> T) -> impl Iterator<Item = (usize, T)> {
    let (low, high) = extremes(range, value);
    let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
    [Some(first), (second.0 != first.0).then_some(second)].into_iter().flatten()
}

/// First node and value of the smallest and of the largest value in `range`.
fn extremes<T: Copy + PartialOrd>(range: Range<usize>, value: impl Fn(usize) -> T) -> ((usize, T), (usize, T)) {
    let first = (range.start, value(range.start));
    let (mut low, mut high) = (first, first);
    for i in range {
        let v = value(i);
        if v < low.1 {
            low = (i, v);
        } else if v > high.1 {
            high = (i, v);
        }
    }
    (low, high)
}

/// A field of `shape`, seen as `cells` blocks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Blocks {
    /// Nodes along y and x.
    pub shape: [usize; 2],
    /// Blocks along y and x.
    pub cells: [usize; 2],
}

impl Blocks {
    /// The blocks of the pixels of an image of a surface on `grid`.
    pub(crate) fn image(grid: &Grid) -> Self {
        Self::square(grid.shape(), grid.size(), PIXELS)
    }

    /// Blocks over a field of `shape` whose sides measure `size`: at most `most` along the longer side, square in space.
    pub(crate) fn square(shape: [usize; 2], size: [f64; 2], most: usize) -> Self {
        let longest = size[0].max(size[1]);
        let finest = (0..2).map(|axis| shape[axis] as f64 * longest / size[axis]).fold(0.0, f64::max);
        let along = (finest.round() as usize).min(most) as f64;
        Self { shape, cells: size.map(|length| ((along * length / longest).round() as usize).max(2)) }
    }

    /// The results of `fold` over all nodes of each block, starting from `start`, row by row. The `values` are those of every
    /// `stride`-th node; where a block has none, the nearest one counts.
    pub(crate) fn fold(
        &self,
        values: &[f64],
        stride: [usize; 2],
        start: f64,
        fold: impl Fn(f64, f64) -> f64,
    ) -> Vec<f64> {
        if self.cells == self.shape && stride == [1, 1] {
            return values.iter().map(|&value| fold(start, value)).collect();
        }
        let share = |axis: usize, cell| share(self.shape[axis], stride[axis], self.cells[axis], cell);
        let row_length = self.shape[1] / stride[1];
        let columns: Vec<Range<usize>> = (0..self.cells[1]).map(|column| share(1, column)).collect();
        let mut blocks = Vec::with_capacity(self.cells[0] * self.cells[1]);
        for rows in (0..self.cells[0]).map(|row| share(0, row)) {
            let of_row = |sum, y: usize, x: &Range<usize>| {
                values[y * row_length..][x.clone()].iter().fold(sum, |sum, &value| fold(sum, value))
            };
            blocks.extend(columns.iter().map(|x| rows.clone().fold(start, |sum, y| of_row(sum, y, x))));
        }
        blocks
    }

    /// Pixels row by row from the upper edge, where y is largest.
    pub(crate) fn rows_down<'a>(&self, blocks: &'a [f64]) -> impl Iterator<Item = f64> + use<'a> {
        blocks.rchunks(self.cells[1]).flatten().copied()
    }
}

/// Whether the contour of a contact on `grid` is drawn: where each node has a pixel of its own.
pub(crate) fn has_contour(grid: &Grid) -> bool {
    pixels(grid) >= grid.len()
}

/// Largest number of points of a curve along a line on `grid`.
pub(crate) fn curve_points(grid: &Grid) -> f64 {
    grid.len().min(2 * Columns::MOST) as f64
}

/// Pixels of an image of a surface on `grid`.
pub(crate) fn pixels(grid: &Grid) -> usize {
    Blocks::image(grid).cells.iter().product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_of_one_node_survives_on_a_line() {
        for spike in [0, 1, 4_999, 99_998, 99_999] {
            let value = |i: usize| if i == spike { 7.0 } else { (i % 3) as f32 };
            let points = Columns::new(100_000).extremes(value);
            assert!(points.len() <= 2 * Columns::MOST);
            assert!(points.contains(&(spike, 7.0)));
            assert!(points.is_sorted_by_key(|p| p.0));
            let runs = Columns::new(100_000).runs(|i| i == spike);
            assert!(runs.len() == 1 && runs[0].contains(&spike));
        }
    }

    #[test]
    fn short_lines_are_kept_as_they_are() {
        let points = Columns::new(20).extremes(|i| i as f32);
        assert_eq!(points, (0..20).map(|i| (i, i as f32)).collect::<Vec<_>>());
    }

    #[test]
    fn pieces_join_to_the_curve_and_values_stand_for_their_nodes() {
        for points in [2, 20, 100_000] {
            let (columns, value) = (Columns::new(points), |i: usize| (i * 7919 % 1013) as f64);
            let curve = columns.curve(value);
            let pieces: Vec<_> = curve.pieces().collect();
            assert!(pieces.len() == columns.count() && pieces.iter().all(|piece| piece.len() > 1));
            assert_eq!(curve.points, columns.extremes(value));
            assert_eq!([pieces[0].start, pieces.last().unwrap().end], [0, curve.points.len()]);
            assert!(pieces.windows(2).all(|pair| pair[1].start < pair[0].end));
            let folded: Vec<_> = curve.values(f64::max).collect();
            assert_eq!(folded.len(), columns.count());
            let most = (0..points).map(value).fold(0.0, f64::max);
            assert!(folded.iter().any(|(_, largest)| *largest == most));
            assert!(folded.is_sorted_by_key(|(middle, _)| *middle) && folded[0].0 >= 0.0);
        }
    }

    #[test]
    fn a_spike_of_one_node_survives_in_blocks() {
        let blocks = Blocks { shape: [37, 53], cells: [8, 11] };
        for spike in [0, 52, 53, 1000, 37 * 53 - 1] {
            let mut values = vec![0.0; 37 * 53];
            values[spike] = 1.0;
            assert_eq!(blocks.fold(&values, [1, 1], 0.0, f64::max).iter().filter(|&&v| v == 1.0).count(), 1);
        }
    }

    #[test]
    fn coarse_nodes_fill_the_blocks_around_them_and_none_is_lost() {
        let blocks = Blocks { shape: [8, 16], cells: [8, 16] };
        let values: Vec<f64> = (0..8).map(f64::from).collect();
        let coarse = blocks.fold(&values, [4, 4], 0.0, f64::max);
        assert_eq!(coarse[..16], [0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3., 0., 0.]);
        assert_eq!(coarse[4 * 16 + 4], values[4 + 1]);
        let few = Blocks { shape: [64, 64], cells: [16, 16] };
        for node in 0..32 * 64 {
            let mut values = vec![0.0; 32 * 64];
            values[node] = 1.0;
            let (y, x) = (node / 64 * 2 / 4, node % 64 / 4);
            let folded = few.fold(&values, [2, 1], 0.0, f64::max);
            assert_eq!(folded.iter().position(|&v| v == 1.0), Some(16 * y + x));
        }
    }

    #[test]
    fn blocks_are_square_in_space() {
        assert_eq!(Blocks::square([64, 64], [1.0, 1.0], 512).cells, [64, 64]);
        assert_eq!(Blocks::square([1024, 1024], [1.0, 2.0], 512).cells, [256, 512]);
        assert_eq!(Blocks::square([64, 32], [1.0, 1.0], 512).cells, [64, 64]);
    }
}
