//! Texts of numbers: profiles, maps and points of maps, with or without a head that says their units.

use super::bytes::decoded;
use super::channel::{Channel, new_name};
use super::columns::{HeightColumns, NamedColumns, is_even};
use super::format::malformed;
use super::instrument::Instrument;
use super::points::{Map, NoMap};
use super::remarks::Remarks;
use super::table::{COLUMNS_OF_POINTS, TextTable};
use super::text::is_text;
use super::unit::{lateral, ratio};
use std::io;

/// A [`TextTable`] in text. HeightColumns are, in this order of choice:
///
/// | columns | what they are |
/// |---------|---------------|
/// | any, below a head that says the width of the map or the size of a pixel, but for columns of named positions | heights row by row, the first row at `y = 0`, as Gwyddion exports them |
/// | named x and heights, such as `x, z, z raw` | positions and heights of profiles, each a channel |
/// | named x, y and heights | points of maps, each a channel |
/// | 1 (or one row) | heights of a profile, or of a map whose head says rows and columns |
/// | 2 | positions and heights of a profile |
/// | 3 | x, y and height of the points of a map, in any order, evenly spaced; those that are missing are void; a profile if x or y is the same everywhere |
/// | more | heights row by row |
///
/// A column of the name `valid` marks heights that are void by 0, and one of whole numbers from 0 or 1 on before positions counts the points;
/// neither is counted in this table. Units are those of the head: `Value units: m`, or in brackets or at the end of the names of columns, as in
/// `x (um), z in nm`.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "text", is_it: is_text, channels };

/// Numbers that programs write for a void without saying so.
const SENTINELS: [f64; 8] = [-9999.0, -99999.0, -999.0, -32768.0, -32767.0, 9999.0, 99999.0, 999.0];
/// Such a number is taken for a height where it is within so many ranges of the others.
const RANGES: f64 = 10.0;
/// From this size on a number is no height, but stands for a void, as the largest one of single precision does.
const HUGE: f64 = 1e30;
/// Deviations of points from their places, over the spacing, that are told: those of positions in text of four digits are less.
const TOLD_DEVIATION: f64 = 1e-3;

/// The least rows and the most columns of a table whose first column is told to look like positions.
const ROWS_OF_POSITIONS: usize = 16;
const COLUMNS_BESIDE_POSITIONS: usize = 8;

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let table = TextTable::from_text(&decoded(bytes))?;
    let remarks = Remarks::new(&table.head, table.columns);
    let [rows, passed] = [table.rows.filter(|rows| *rows != table.shape()[0]), Some(table.passed).filter(|it| *it > 0)];
    let rows = rows.map(|rows| format!("the header states {rows} rows, but there are {}", table.shape()[0]));
    let passed = passed.map(|passed| match passed {
        1 => "a row of numbers stands above a line of text and is not read".to_owned(),
        _ => format!("{passed} rows of numbers stand above a line of text and are not read"),
    });
    let mut channels = read(table, &remarks)?;
    for channel in &mut channels {
        if channel.name.is_empty() {
            channel.name = remarks.channel.clone().unwrap_or_else(|| "height".into());
        }
        channel.header.extend(remarks.said.clone());
        channel.doubts.extend(rows.iter().chain(&passed).cloned());
        channel.doubts.extend(doubts_of_shape(channel, &remarks));
    }
    Ok(channels)
}

/// The channels of a table: a map whose distances its head says, or what its columns are.
fn read(table: TextTable, remarks: &Remarks) -> io::Result<Vec<Channel<'static>>> {
    if table.columns > COLUMNS_OF_POINTS && remarks.column_names.is_empty() && has_distances(remarks) {
        return Ok(vec![map(table, remarks)]);
    }
    let columns = HeightColumns::new(table, remarks)?;
    let shape = columns.table.shape();
    let named = columns.named().filter(|_| shape[0] > 1);
    if named.is_none()
        && has_distances(remarks)
        && shape[1] > 1
        && (remarks.width.is_some() || shape[1] > COLUMNS_OF_POINTS || remarks.shape[1] == Some(shape[1]))
    {
        return Ok(vec![map(columns.table, remarks)]);
    }
    let named = named.or(match shape {
        [1, _] | [_, 1] => None,
        [_, 2] => Some(NamedColumns { x: 0, y: None, heights: vec![1] }),
        [_, 3] => Some(NamedColumns { x: 0, y: Some(1), heights: vec![2] }),
        _ => None,
    });
    match named {
        Some(named) => of_points(&columns, &named, remarks),
        None if shape[0] == 1 || shape[1] == 1 => Ok(vec![list(columns, remarks)]),
        None => Ok(vec![map(columns.table, remarks)]),
    }
}

fn has_distances(remarks: &Remarks) -> bool {
    remarks.width.is_some() || remarks.pixel.is_some()
}

/// What the head says of the numbers of rows and columns, where a map has others.
fn doubts_of_shape(channel: &Channel, remarks: &Remarks) -> Vec<String> {
    if channel.is_profile {
        return Vec::new();
    }
    let differs = |axis: usize, what: &str| {
        let found = channel.shape[axis];
        let stated = remarks.shape[axis].filter(|stated| *stated != found)?;
        Some(format!("the header states {stated} {what}, but there are {found}"))
    };
    [differs(0, "rows"), differs(1, "columns")].into_iter().flatten().collect()
}

/// Heights, NaN for the number that the head says to stand for a void, and the doubt that another number does.
fn heights(mut values: Vec<f64>, remarks: &Remarks) -> (Vec<f64>, Vec<String>) {
    if let Some(void) = remarks.void {
        // the number may be rounded to single precision in the head or in the table
        let is_void = |value: f64| (value - void).abs() <= 1e-6 * void.abs();
        values.iter_mut().filter(|value| is_void(**value)).for_each(|value| *value = f64::NAN);
    }
    let doubts = doubt_of_sentinel(&values).into_iter().collect();
    (values, doubts)
}

/// The doubt that a number far from all others, such as -9999, stands for a void.
fn doubt_of_sentinel(values: &[f64]) -> Option<String> {
    let is_sentinel = |value: &f64| SENTINELS.contains(value) || value.abs() >= HUGE;
    let sentinel = *values.iter().find(|value| is_sentinel(value))?;
    let others = || values.iter().filter(|value| value.is_finite() && **value != sentinel);
    let [least, most] =
        [others().copied().fold(f64::INFINITY, f64::min), others().copied().fold(f64::NEG_INFINITY, f64::max)];
    let distance = if sentinel > most { sentinel - most } else { least - sentinel };
    let count = values.iter().filter(|value| **value == sentinel).count();
    (distance > RANGES * (most - least)).then(|| {
        format!(
            "{count} heights are {sentinel}, far from all others, as programs write a void: if they are, write NaN instead, or \
             NODATA_value {sentinel} in a line above them"
        )
    })
}

/// A map row by row; its head may say its distances.
fn map(table: TextTable, remarks: &Remarks) -> Channel<'static> {
    let [ny, nx] = table.shape();
    let (values, mut doubts) = heights(table.values.clone(), remarks);
    if !has_distances(remarks) {
        doubts.extend(doubt_of_positions(&table));
    }
    Channel { doubts, ..sized([ny, nx], values, remarks) }
}

/// A map of a shape with the distances that its head says.
fn sized(shape: [usize; 2], values: Vec<f64>, remarks: &Remarks) -> Channel<'static> {
    let map = Channel { unit: remarks.value_unit, ..Channel::map("", shape, move || Ok(values)) };
    if let Some(width) = remarks.width {
        let across = width / shape[1] as f64;
        let along = remarks.height.map_or(across, |height| height / shape[0] as f64);
        return Channel { spacing: Some([along, across]), lateral_unit: Some(1.0), ..map };
    }
    Channel { spacing: remarks.pixel.map(|it| it.spacing), lateral_unit: remarks.pixel.and_then(|it| it.unit), ..map }
}

/// The doubt that the first of a few columns of a map holds positions: its numbers rise evenly, and those of others do not.
fn doubt_of_positions(table: &TextTable) -> Option<String> {
    let [rows, columns] = table.shape();
    let has_size = rows >= ROWS_OF_POSITIONS && columns <= COLUMNS_BESIDE_POSITIONS;
    let has_positions = has_size && is_even(table, 0) && !(1..columns).all(|column| is_even(table, column));
    has_positions.then(|| {
        format!(
            "the first of {columns} columns rises evenly, as positions do, but is read as heights of a map: name the columns in a line above \
             them, such as x, z, or give positions and heights alone"
        )
    })
}

/// Heights alone, in one row or column: of a map if its head says rows and columns, or else of a profile.
fn list(columns: HeightColumns, remarks: &Remarks) -> Channel<'static> {
    let (values, doubts) = heights(columns.table.values, remarks);
    let unit = remarks.value_unit.or(columns.units.first().copied().flatten());
    if let Some(shape) = remarks.fitting_shape(values.len()) {
        return Channel { unit, doubts, ..sized(shape, values, remarks) };
    }
    Channel { is_profile: true, unit, doubts, ..sized([1, values.len()], values, remarks) }
}

/// Profiles or maps of points, a channel for each column of heights.
fn of_points(columns: &HeightColumns, named: &NamedColumns, remarks: &Remarks) -> io::Result<Vec<Channel<'static>>> {
    let table = &columns.table;
    let unit_of = |column: usize| columns.units.get(column).copied().flatten();
    let mut channels: Vec<Channel> = Vec::new();
    for height in &named.heights {
        let channel = match named.y {
            None => profile(table, named.x, *height, remarks),
            Some(y) if table.is_constant(y) => profile(table, named.x, *height, remarks),
            Some(y) if table.is_constant(named.x) => profile(table, y, *height, remarks),
            Some(y) => points(table, [named.x, y, *height], remarks)?,
        };
        let along = named.y.filter(|_| table.is_constant(named.x)).unwrap_or(named.x);
        let unit = if named.heights.len() > 1 {
            unit_of(*height).or(remarks.value_unit)
        } else {
            remarks.value_unit.or(unit_of(*height))
        };
        let channel = match named.y.filter(|_| !channel.is_profile) {
            None => Channel { lateral_unit: unit_of(along), unit, ..channel },
            // a unit that the channel has is that of the pixels in its head
            Some(y) => with_units(Channel { unit, ..channel }, [unit_of(y), unit_of(named.x)]),
        };
        let name = match columns.names.get(*height).filter(|_| named.heights.len() > 1) {
            Some(name) => new_name(name.split(['(', '[']).next().unwrap_or_default().trim(), &channels),
            None => String::new(),
        };
        channels.push(Channel { name, ..channel });
    }
    Ok(channels)
}

/// A map of points with the units of its distances along y and x.
fn with_units(channel: Channel<'static>, [along_y, along_x]: [Option<f64>; 2]) -> Channel<'static> {
    let spacing = channel.spacing.map(|[dy, dx]| [dy * ratio(along_y, along_x), dx]);
    Channel { spacing, lateral_unit: channel.lateral_unit.or(lateral(along_y, along_x)), ..channel }
}

/// Positions in a column, and heights in another one.
fn profile(table: &TextTable, x: usize, height: usize, remarks: &Remarks) -> Channel<'static> {
    let positions: Vec<f64> = table.column(x).collect();
    let count = positions.len();
    let (values, doubts) = heights(table.column(height).collect(), remarks);
    let map = Channel::map("", [1, count], move || Ok(values));
    Channel { is_profile: true, positions: Some(positions), doubts, ..map }
}

/// Points of a map with positions x and y and heights in three columns. Positions that count pixels are as far apart as the head says.
fn points(table: &TextTable, [x, y, height]: [usize; 3], remarks: &Remarks) -> io::Result<Channel<'static>> {
    let map = Map::new(table, [x, y]).map_err(|why| malformed(no_map(why, table, [x, y])))?;
    let (values, doubts) = heights(map.values(table, height), remarks);
    let off = (map.deviation > TOLD_DEVIATION)
        .then(|| ("points off the grid".to_owned(), format!("by up to {:.1} % of its spacing", 100.0 * map.deviation)));
    let counts_pixels = map.spacing.iter().all(|step| (step - 1.0).abs() < 1e-9);
    let pixel = remarks.pixel.filter(|_| counts_pixels);
    Ok(Channel {
        spacing: Some(pixel.map_or(map.spacing, |it| it.spacing)),
        lateral_unit: pixel.and_then(|it| it.unit),
        header: off.into_iter().collect(),
        doubts,
        ..Channel::map("", map.shape, move || Ok(values))
    })
}

/// Why points in two columns are no map, and what to do.
fn no_map(why: NoMap, table: &TextTable, [x, y]: [usize; 2]) -> String {
    let advice = "resample the points to an even grid, or save the heights row by row as .npy";
    match why {
        NoMap::Twice(row) => {
            let at = |column: usize| table.values[row * table.columns + column];
            format!(
                "two of its points have one place on their grid, at x = {:?} and y = {:?}: give each point once, or {advice}",
                at(x),
                at(y)
            )
        }
        NoMap::Uneven | NoMap::Sparse => {
            format!("it has three columns, but they are not x, y and height on an evenly spaced grid: {advice}")
        }
    }
}
