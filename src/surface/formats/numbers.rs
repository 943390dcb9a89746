//! Texts of numbers: profiles, maps and points of maps, with or without a head that says their units.

use super::bytes::decoded;
use super::channel::Channel;
use super::columns::HeightColumns;
use super::format::malformed;
use super::instrument::Instrument;
use super::points::map;
use super::remarks::Remarks;
use super::table::TextTable;
use super::text::is_text;
use super::unit::{lateral, ratio};
use std::io;

/// A [`TextTable`] in text. HeightColumns are, in this order of choice:
///
/// | columns | what they are |
/// |---------|---------------|
/// | any, below a head that says the width of the map or the size of a pixel | heights row by row, the first row at `y = 0`, as Gwyddion exports them |
/// | 1 (or one row) | heights of a profile |
/// | 2 | positions and heights of a profile |
/// | 3 | x, y and height of the points of a map, in any order, evenly spaced; those that are missing are void; a profile if x or y is the same everywhere |
/// | more | heights row by row |
///
/// A column of the name `valid` marks heights that are void by 0, and one of whole numbers from 0 or 1 on before positions counts the points;
/// neither is counted in this table. Units are those of the head: `Value units: m`, or in brackets or at the end of the names of columns, as in
/// `x (um), z in nm`.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "text", is_it: is_text, channels };

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let table = TextTable::from_text(&decoded(bytes))?;
    let mut remarks = Remarks::new(&table.head, table.columns);
    let doubts = doubts(&table, &remarks);
    let said = std::mem::take(&mut remarks.said);
    let name = remarks.channel.clone().unwrap_or_else(|| "height".into());
    let channel = if remarks.width.is_some() || remarks.pixel.is_some() {
        sized(table, &remarks)
    } else {
        let HeightColumns { table, units } = HeightColumns::new(table, &remarks);
        let of_column = |column: usize| units.get(column).copied().flatten();
        let unit = remarks.value_unit.or(of_column(table.columns - 1));
        let channel = match table.shape() {
            [_, 1] | [1, _] => Channel { unit: remarks.value_unit.or(of_column(0)), ..profile(table) },
            [_, 2] => Channel { lateral_unit: of_column(0), ..positions(table, 0) },
            [_, 3] => match [1, 0].into_iter().find(|column| table.is_constant(*column)) {
                Some(column) => Channel { lateral_unit: of_column(1 - column), ..positions(table, 1 - column) },
                None => points(&table, [of_column(1), of_column(0)])?,
            },
            shape => {
                return Ok(vec![Channel {
                    header: said,
                    doubts,
                    ..Channel::map(name, shape, move || Ok(table.values))
                }]);
            }
        };
        Channel { unit: channel.unit.or(unit), ..channel }
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
    let passed = match table.passed {
        0 => None,
        1 => Some("a row of numbers stands above a line of text and is not read".to_owned()),
        passed => Some(format!("{passed} rows of numbers stand above a line of text and are not read")),
    };
    rows.into_iter().chain(columns).chain(passed).collect()
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
fn profile(table: TextTable) -> Channel<'static> {
    Channel { is_profile: true, ..Channel::map("", [1, table.values.len()], move || Ok(table.values)) }
}

/// Positions in a column, and heights in the last one.
fn positions(table: TextTable, column: usize) -> Channel<'static> {
    let x: Vec<f64> = table.column(column).collect();
    let count = x.len();
    let heights = move || Ok(table.column(table.columns - 1).collect());
    Channel { is_profile: true, positions: Some(x), ..Channel::map("", [1, count], heights) }
}

/// Points of a map with units along y and x.
fn points(table: &TextTable, [along_y, along_x]: [Option<f64>; 2]) -> io::Result<Channel<'static>> {
    let why = "it has three columns, but they are not x, y and height on an evenly spaced grid: resample the points, or save the heights row by row as .npy";
    let map = map(table, 0).ok_or_else(|| malformed(why))?;
    let [dy, dx] = map.spacing;
    Ok(Channel {
        spacing: Some([dy * ratio(along_y, along_x), dx]),
        lateral_unit: lateral(along_y, along_x),
        ..Channel::map("", map.shape, move || Ok(map.values))
    })
}
