//! Columns of a text that are positions and heights, and those that are neither.

use super::format::malformed;
use super::points::is_grid;
use super::remarks::Remarks;
use super::said::plain;
use super::table::{COLUMNS_OF_POINTS, TextTable};
use std::io;

/// Names, without white space and in small letters, of a column that says whether the heights beside it were measured.
const VALIDITY: [&str; 3] = ["valid", "validity", "isvalid"];
/// Names of a column that counts points.
const COUNT: [&str; 12] =
    ["index", "idx", "no", "nr", "n", "i", "id", "point", "points", "pointno", "number", "sample"];
/// Names of positions along x, and along y.
const X: [&str; 20] = [
    "x",
    "xpos",
    "xposition",
    "xcoord",
    "xcoordinate",
    "xdata",
    "xaxis",
    "xvalue",
    "xvalues",
    "position",
    "pos",
    "distance",
    "dist",
    "lateral",
    "lateralposition",
    "scanposition",
    "scanlength",
    "travel",
    "arclength",
    "length",
];
const Y: [&str; 9] = ["y", "ypos", "yposition", "ycoord", "ycoordinate", "ydata", "yaxis", "yvalue", "yvalues"];
/// Names of heights, and what the names of variants of them begin with, such as `z raw`.
const HEIGHT: [&str; 20] = [
    "z",
    "zpos",
    "zposition",
    "zcoord",
    "zcoordinate",
    "zdata",
    "zaxis",
    "zvalue",
    "zvalues",
    "zheight",
    "height",
    "heights",
    "h",
    "topography",
    "topo",
    "profile",
    "depth",
    "elevation",
    "altitude",
    "surface",
];
const VARIANT: [&str; 6] = ["z", "height", "topography", "profile", "raw", "depth"];

/// The largest deviation from an even spacing, as a share of it: what positions that are rounded to a tenth of it come to.
const ROUNDING: f64 = 0.1;

/// What a column holds, by its name.
#[derive(Clone, Copy, PartialEq)]
enum ColumnRole {
    X,
    Y,
    Height,
    /// Heights that were treated, or not yet.
    HeightVariant,
    Other,
}

impl ColumnRole {
    fn new(name: &str) -> Self {
        let name = plain(name);
        let is_variant = VARIANT.iter().any(|it| name.starts_with(it)) || name.ends_with("raw");
        match name.as_str() {
            name if X.contains(&name) => Self::X,
            name if Y.contains(&name) => Self::Y,
            name if HEIGHT.contains(&name) => Self::Height,
            _ if is_variant => Self::HeightVariant,
            _ => Self::Other,
        }
    }
}

/// The columns of a table that are positions and heights, with the metres in their units.
pub(super) struct HeightColumns {
    pub table: TextTable,
    pub units: Vec<Option<f64>>,
    pub names: Vec<String>,
}

/// Columns of positions and heights, by their places.
#[derive(Debug, PartialEq)]
pub(super) struct NamedColumns {
    pub x: usize,
    pub y: Option<usize>,
    /// Columns of heights, the best one first.
    pub heights: Vec<usize>,
}

impl HeightColumns {
    /// The columns of a table with the units and under the names that its head says: heights are void where a column of validity is 0, and that
    /// column, one that counts the points and empty ones are left out.
    ///
    /// # Errors
    /// Where the first of three columns may count the points or be their positions.
    pub(crate) fn new(table: TextTable, remarks: &Remarks) -> io::Result<Self> {
        let mut columns = Self { table, units: remarks.column_units.clone(), names: remarks.column_names.clone() };
        columns.remove_blank();
        let is_validity = |name: &String| VALIDITY.contains(&plain(name).as_str());
        if let Some(place) = columns.names.iter().position(is_validity).filter(|_| columns.table.columns > 1) {
            columns.blank(place);
            columns.remove(place);
        }
        if columns.counts_points()? {
            columns.remove(0);
        }
        Ok(columns)
    }

    /// Removes empty columns among those of points, and all that are parted by tabs, of which several may stand between two columns.
    fn remove_blank(&mut self) {
        let filled = self.table.is_blank.iter().filter(|it| !**it).count();
        if filled > COLUMNS_OF_POINTS && !self.table.is_tabbed {
            return;
        }
        while let Some(place) = self.table.is_blank.iter().position(|it| *it) {
            self.remove(place);
        }
    }

    /// Makes the heights void, which are the last column but that of validity, where that is 0.
    fn blank(&mut self, validity: usize) {
        let last = self.table.columns - 1;
        let height = if validity == last { last - 1 } else { last };
        for row in self.table.values.chunks_exact_mut(last + 1).filter(|row| row[validity] == 0.0) {
            row[height] = f64::NAN;
        }
    }

    fn remove(&mut self, column: usize) {
        if column < self.units.len() {
            self.units.remove(column);
        }
        if column < self.names.len() {
            self.names.remove(column);
        }
        self.table.remove(column);
    }

    /// Which columns are positions and heights by their names, if these say so.
    pub(crate) fn named(&self) -> Option<NamedColumns> {
        let roles: Vec<ColumnRole> = self.names.iter().map(|name| ColumnRole::new(name)).collect();
        let places = |role: ColumnRole| roles.iter().enumerate().filter(move |it| *it.1 == role).map(|it| it.0);
        let (mut x, mut y) = (places(ColumnRole::X), places(ColumnRole::Y));
        let ([Some(x), None], [y, None]) = ([x.next(), x.next()], [y.next(), y.next()]) else { return None };
        let heights: Vec<usize> = places(ColumnRole::Height).chain(places(ColumnRole::HeightVariant)).collect();
        match y {
            // beside x alone, y is a height
            Some(y) if heights.is_empty() => Some(NamedColumns { x, y: None, heights: vec![y] }),
            y => (!heights.is_empty()).then_some(NamedColumns { x, y, heights }),
        }
    }

    /// Whether the first column counts the rows from 0 or 1 on, and positions follow: two columns with positions that are not the same
    /// everywhere, or three with the points of a map.
    fn counts_points(&self) -> io::Result<bool> {
        let first = self.table.values[0];
        let is_count = || self.table.column(0).enumerate().all(|(i, number)| number == first + i as f64);
        let is_numbered = self.table.shape()[0] > 1 && [0.0, 1.0].contains(&first) && is_count();
        let has_positions = is_numbered
            && match self.table.columns {
                3 => !self.table.is_constant(1),
                4 => is_grid(&self.table, [1, 2]),
                _ => false,
            };
        if !has_positions {
            return Ok(false);
        }
        if let Some(name) = self.names.first() {
            return Ok(COUNT.contains(&plain(name).as_str()) || self.named().is_none());
        }
        // without names, a first column of three may be positions with a step of 1, and two kinds of heights may stand beside it
        match self.table.columns == 3 && !is_even(&self.table, 1) {
            true => Err(malformed(
                "the first of its three columns may count the points or hold their positions: name the columns in a line above them, such as \
                 index, x, z or x, z, z raw, or give positions and heights alone",
            )),
            false => Ok(true),
        }
    }
}

/// Whether the numbers of a column rise or fall evenly, except for rounding to a tenth of their step.
pub(super) fn is_even(table: &TextTable, column: usize) -> bool {
    let last = table.shape()[0] - 1;
    let at = |row: usize| table.values[row * table.columns + column];
    let step = (at(last) - at(0)) / last as f64;
    let is_off = |row: usize| (at(row) - at(0) - row as f64 * step).abs() > ROUNDING * step.abs();
    step.is_finite() && step != 0.0 && !(0..=last).any(is_off)
}
