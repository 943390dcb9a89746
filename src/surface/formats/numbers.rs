//! Texts of numbers: profiles, maps and points of maps, with or without a head that says their units.

use super::bytes::latin;
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::points::map;
use super::remarks::Remarks;
use super::table::TextTable;
use std::io;

/// A [`TextTable`] in text. Columns are, in this order of choice:
///
/// | columns | what they are |
/// |---------|---------------|
/// | any, below a head that says the width of the map or the size of a pixel | heights row by row, the first row at `y = 0`, as Gwyddion exports them |
/// | 1 (or one row) | heights of a profile |
/// | 2 | positions and heights of a profile |
/// | 3 | x, y and height of the points of a map, in any order, evenly spaced; those that are missing are void |
/// | more | heights row by row |
///
/// Units are those of the head: `Value units: m`, or in brackets after the names of columns, as in `x (um), z (nm)`.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "text", is_it, channels };

/// Number of bytes from the start of a file that are checked to distinguish text from binary data.
const START: usize = 4096;

/// Whether bytes begin with text, in any encoding of one byte for each letter of ours.
fn is_it(bytes: &[u8]) -> bool {
    !bytes.is_empty() && bytes.iter().take(START).all(|byte| *byte >= b'\t')
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let table = TextTable::from_text(&latin(bytes))?;
    let mut remarks = Remarks::new(&table.head);
    let doubts = doubts(&table, &remarks);
    let said = std::mem::take(&mut remarks.said);
    let name = remarks.channel.clone().unwrap_or_else(|| "height".into());
    let channel = match table.shape() {
        _ if remarks.width.is_some() || remarks.pixel.is_some() => sized(table, &remarks),
        [_, 1] | [1, _] => profile(table, &remarks),
        [_, 2] => positions(table, &remarks),
        [_, 3] => points(&table, &remarks)?,
        shape => Channel::map("", shape, move || Ok(table.values)),
    };
    Ok(vec![Channel { name, header: said, doubts, ..channel }])
}

/// What the head says of the numbers of rows and columns, where the table has others.
fn doubts(table: &TextTable, remarks: &Remarks) -> Vec<String> {
    let [found_rows, found_columns] = table.shape();
    let rows = [table.rows, remarks.shape[0]].into_iter().flatten().find(|rows| *rows != found_rows);
    let rows = rows.map(|rows| format!("the header states {rows} rows, but there are {found_rows}"));
    let columns = remarks.shape[1].filter(|columns| *columns != found_columns);
    let columns = columns.map(|columns| format!("the header states {columns} columns, but there are {found_columns}"));
    rows.into_iter().chain(columns).collect()
}

/// A map whose head says its size.
fn sized(table: TextTable, remarks: &Remarks) -> Channel<'static> {
    let [ny, nx] = table.shape();
    let across = remarks.width.map(|width| width / nx as f64).or(remarks.pixel).unwrap_or(f64::NAN);
    let along = remarks.height.map_or(across, |height| height / ny as f64);
    Channel {
        spacing: Some([along, across]),
        lateral_unit: Some(1.0),
        unit: remarks.value_unit,
        ..Channel::map("", [ny, nx], move || Ok(table.values))
    }
}

/// Heights alone.
fn profile(table: TextTable, remarks: &Remarks) -> Channel<'static> {
    let unit = remarks.value_unit.or(remarks.column_units.first().copied().flatten());
    Channel { is_profile: true, unit, ..Channel::map("", [1, table.values.len()], move || Ok(table.values)) }
}

/// Positions and heights.
fn positions(table: TextTable, remarks: &Remarks) -> Channel<'static> {
    let x: Vec<f64> = table.column(0).collect();
    let of_column = |column: usize| remarks.column_units.get(column).copied().flatten();
    Channel {
        is_profile: true,
        lateral_unit: of_column(0),
        unit: remarks.value_unit.or(of_column(1)),
        positions: Some(x),
        ..Channel::map("", [1, table.shape()[0]], move || Ok(table.column(1).collect()))
    }
}

/// Points of a map.
fn points(table: &TextTable, remarks: &Remarks) -> io::Result<Channel<'static>> {
    let why = "it has three columns, but they are not x, y and height on an evenly spaced grid: resample the points, or save the heights row by row as .npy";
    let of_column = |column: usize| remarks.column_units.get(column).copied().flatten();
    let map = map(table).ok_or_else(|| malformed(why))?;
    Ok(Channel {
        spacing: Some(map.spacing),
        lateral_unit: of_column(0),
        unit: remarks.value_unit.or(of_column(2)),
        ..Channel::map("", map.shape, move || Ok(map.values))
    })
}
