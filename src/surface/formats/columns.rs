//! HeightColumns of a text that are neither positions nor heights.

use super::points::map;
use super::remarks::Remarks;
use super::table::TextTable;

/// Names of a column that says whether the heights beside it were measured.
const VALIDITY: [&str; 4] = ["valid", "validity", "is valid", "isvalid"];

/// The columns of a table that are positions and heights, with the metres in their units.
pub(super) struct HeightColumns {
    pub table: TextTable,
    pub units: Vec<Option<f64>>,
}

impl HeightColumns {
    /// The columns of a table with the units and under the names that its head says: heights are void where a column of validity is 0, and that
    /// column and one that counts the points are left out.
    pub fn new(table: TextTable, remarks: &Remarks) -> Self {
        let mut columns = Self { table, units: remarks.column_units.clone() };
        let is_validity = |name: &String| VALIDITY.contains(&name.as_str());
        if let Some(place) = remarks.column_names.iter().position(is_validity).filter(|_| columns.table.columns > 1) {
            columns.blank(place);
            columns = columns.without(place);
        }
        if columns.counts_points() { columns.without(0) } else { columns }
    }

    /// Makes the heights void, which are the last column but that of validity, where that is 0.
    fn blank(&mut self, validity: usize) {
        let last = self.table.columns - 1;
        let height = if validity == last { last - 1 } else { last };
        for row in self.table.values.chunks_exact_mut(last + 1).filter(|row| row[validity] == 0.0) {
            row[height] = f64::NAN;
        }
    }

    fn without(mut self, column: usize) -> Self {
        if column < self.units.len() {
            self.units.remove(column);
        }
        Self { table: self.table.without(column), ..self }
    }

    /// Whether the first column counts the rows from 0 or 1 on, and positions follow: two columns with positions that are not the same
    /// everywhere, or three with the points of a map.
    fn counts_points(&self) -> bool {
        let first = self.table.values[0];
        let is_count = || self.table.column(0).enumerate().all(|(i, number)| number == first + i as f64);
        let is_numbered = self.table.shape()[0] > 1 && [0.0, 1.0].contains(&first) && is_count();
        is_numbered
            && match self.table.columns {
                3 => !self.table.is_constant(1),
                4 => map(&self.table, 1).is_some(),
                _ => false,
            }
    }
}
