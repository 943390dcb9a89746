//! Points of a map, given one by one.

use super::table::TextTable;

/// The largest distance of a point from its place on the grid, as a share of the spacing: what positions that are rounded to a tenth
/// of it come to.
const TOLERANCE: f64 = 0.1;
/// Positions that differ by less than this share of their range are the same, whatever the spacing.
const SAME: f64 = 1e-9;
/// The least ratio of the distance of two lines of the grid and that of two points on the same line. Points that are within [`TOLERANCE`] of
/// their lines leave a ratio of 0.8 over 0.2, and gaps of missing lines are twice as wide as others.
const LEAST_RATIO: f64 = 3.0;
/// The most places of a grid for each point that is given.
const SPARSEST: usize = 4;

/// A map on an evenly spaced grid.
pub(super) struct Map {
    pub shape: [usize; 2],
    pub spacing: [f64; 2],
    /// The place of each point, row by row.
    places: Vec<usize>,
    /// The largest distance of a point from its place, over the spacing.
    pub deviation: f64,
}

/// Why points are no map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NoMap {
    /// They are not on the lines of an evenly spaced grid.
    Uneven,
    /// Two have one place, the second of them on this row of the table, from 0 on.
    Twice(usize),
    /// Most places of their grid have no point.
    Sparse,
}

impl Map {
    /// The map of points with positions in two columns, x and y, in any order.
    ///
    /// # Errors
    /// If they are not evenly spaced, or two have one place.
    pub(crate) fn new(table: &TextTable, [x, y]: [usize; 2]) -> Result<Self, NoMap> {
        let axis = |column: usize| EvenPositions::new(table.column(column).collect()).ok_or(NoMap::Uneven);
        let [x_axis, y_axis] = [axis(x)?, axis(y)?];
        let shape = [y_axis.points, x_axis.points];
        let nodes = shape[0].checked_mul(shape[1]).filter(|it| *it <= SPARSEST.saturating_mul(table.shape()[0]));
        let nodes = nodes.ok_or(NoMap::Sparse)?;
        let mut is_given = vec![false; nodes];
        let mut places = Vec::with_capacity(table.shape()[0]);
        let mut deviation = 0.0_f64;
        for (row, point) in table.values.chunks_exact(table.columns).enumerate() {
            let [(iy, off_y), (ix, off_x)] =
                [y_axis.place(point[y]).ok_or(NoMap::Uneven)?, x_axis.place(point[x]).ok_or(NoMap::Uneven)?];
            deviation = deviation.max(off_x).max(off_y);
            let place = iy * shape[1] + ix;
            if std::mem::replace(&mut is_given[place], true) {
                return Err(NoMap::Twice(row));
            }
            places.push(place);
        }
        Ok(Self { shape, spacing: [y_axis.spacing, x_axis.spacing], places, deviation })
    }

    /// The numbers of a column row by row, NaN where no point was given.
    pub(crate) fn values(&self, table: &TextTable, column: usize) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.shape[0] * self.shape[1]];
        for (place, value) in self.places.iter().zip(table.column(column)) {
            values[*place] = value;
        }
        values
    }
}

/// Whether two columns hold the positions x and y of points of a map.
pub(super) fn is_grid(table: &TextTable, positions: [usize; 2]) -> bool {
    Map::new(table, positions).is_ok()
}

/// Evenly spaced positions along an axis.
struct EvenPositions {
    first: f64,
    spacing: f64,
    points: usize,
}

impl EvenPositions {
    /// The axis on which all these positions are, of which some may be missing; none if there is only one, or one is not finite. Points may be
    /// off the lines of the grid: those with small distances are on one line, and the widest distances that there are fit best.
    fn new(mut positions: Vec<f64>) -> Option<Self> {
        positions.sort_by(f64::total_cmp);
        let range = positions.last()? - positions.first()?;
        let same = SAME * range;
        if !(range > 0.0 && range.is_finite()) {
            return None;
        }
        let mut gaps: Vec<f64> = positions.windows(2).map(|pair| (pair[1] - pair[0]).max(same)).collect();
        gaps.sort_by(|one, other| other.total_cmp(one));
        // from the widest distances on, each that is much larger than the next one may be that of the lines
        let jumps = gaps.windows(2).filter(|pair| pair[0] >= LEAST_RATIO * pair[1]).map(|pair| pair[0]);
        let widest = jumps.chain(gaps.last().copied());
        widest.filter(|gap| *gap > same).find_map(|gap| Self::on_lines(&positions, gap))
    }

    /// The axis of lines that are at least `gap` apart, if all positions, in ascending order, are on them.
    fn on_lines(positions: &[f64], gap: f64) -> Option<Self> {
        let lines: Vec<f64> = positions
            .chunk_by(|one, other| other - one < 0.999 * gap)
            .map(|line| line.iter().sum::<f64>() / line.len() as f64)
            .collect();
        let mut gaps: Vec<f64> = lines.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = gaps.len() / 2;
        let typical = (!gaps.is_empty()).then(|| *gaps.select_nth_unstable_by(middle, f64::total_cmp).1)?;
        let steps: f64 = gaps.iter().map(|gap| (gap / typical).round().max(1.0)).sum();
        let first = lines[0];
        let spacing = (lines[lines.len() - 1] - first) / steps;
        let axis = Self { first, spacing, points: steps as usize + 1 };
        positions.iter().all(|position| axis.place(*position).is_some()).then_some(axis)
    }

    /// The place of a position and its distance from it over the spacing, if it is at one.
    fn place(&self, position: f64) -> Option<(usize, f64)> {
        let steps = (position - self.first) / self.spacing;
        let off = (steps - steps.round()).abs();
        let place = steps.round().max(0.0) as usize;
        (off < TOLERANCE && steps > -0.5 && place < self.points).then_some((place, off))
    }
}
