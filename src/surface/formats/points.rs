//! Points of a map, given one by one.

use super::table::TextTable;

/// The largest distance of a point from its place on the grid, as a share of the spacing: what positions that are rounded to a tenth
/// of it come to.
const TOLERANCE: f64 = 0.1;
/// Positions that differ by less than this share of their range are the same.
const SAME: f64 = 1e-6;
/// The most places of a grid for each point that is given.
const SPARSEST: usize = 4;

/// A map on an evenly spaced grid.
pub(super) struct Map {
    pub shape: [usize; 2],
    pub spacing: [f64; 2],
    /// Heights row by row, NaN where no point was given.
    pub values: Vec<f64>,
}

/// The map of points in three columns x, y and height from the column `first` on, in any order; none if they are not evenly spaced, or two have
/// one place.
pub(super) fn map(table: &TextTable, first: usize) -> Option<Map> {
    let axis = |column: usize| EvenPositions::new(table.column(column).collect());
    let [x, y] = [axis(first)?, axis(first + 1)?];
    let shape = [y.points, x.points];
    let places =
        shape[0].checked_mul(shape[1]).filter(|places| *places <= SPARSEST.saturating_mul(table.shape()[0]))?;
    let mut values = vec![f64::NAN; places];
    let mut is_given = vec![false; places];
    for point in table.values.chunks_exact(table.columns).map(|row| &row[first..]) {
        let place = y.place(point[1])? * shape[1] + x.place(point[0])?;
        if std::mem::replace(&mut is_given[place], true) {
            return None;
        }
        values[place] = point[2];
    }
    Some(Map { shape, spacing: [y.spacing, x.spacing], values })
}

/// Evenly spaced positions along an axis.
struct EvenPositions {
    first: f64,
    spacing: f64,
    points: usize,
}

impl EvenPositions {
    /// The axis on which all these positions are, of which some may be missing; none if there is only one, or one is not finite.
    fn new(mut positions: Vec<f64>) -> Option<Self> {
        positions.sort_by(f64::total_cmp);
        let [first, last] = [*positions.first()?, *positions.last()?];
        let same = SAME * (last - first);
        let gaps = positions.windows(2).map(|pair| pair[1] - pair[0]);
        let mut gaps: Vec<f64> = gaps.filter(|gap| *gap > same).collect();
        let middle = gaps.len() / 2;
        let typical = (!gaps.is_empty()).then(|| *gaps.select_nth_unstable_by(middle, f64::total_cmp).1)?;
        let steps: f64 = gaps.iter().map(|gap| (gap / typical).round()).sum();
        let spacing = (last - first) / steps;
        (spacing > 0.0 && spacing.is_finite()).then_some(Self { first, spacing, points: steps as usize + 1 })
    }

    /// The place of a position, if it is at one.
    fn place(&self, position: f64) -> Option<usize> {
        let steps = (position - self.first) / self.spacing;
        ((steps - steps.round()).abs() < TOLERANCE).then_some(steps.round() as usize).filter(|it| *it < self.points)
    }
}
