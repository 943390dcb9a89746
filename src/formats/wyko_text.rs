//! The text files of Wyko interferometers.

use super::bytes::decoded;
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::opd::rows_of;
use super::table::TextTable;
use std::io;

/// Lines of a name and a value, or of a name, a type, a length and a value, parted by tabs, and heights: a line for each column of the map, from
/// its last row on, `Bad` where there is none. Of the three flags in the first line the second one says whether heights are nanometres, or else
/// wavelengths of `Wavelength` nanometres over `Mult`. Points are `Pixel_size` millimetres apart along x and `Aspect` times that along y. Lines
/// that are rows of the map instead, by their number and their length, are read as such.
///
/// # Source
/// Gwyddion 2.61 (`opdfile.c`) for the order of heights and their unit; SurfaceTopography 1.27 for the flag.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Wyko ASCII", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"Wyko ASCII Data File Format";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let table = TextTable::from_text(&decoded(bytes))?;
    let said: Vec<(String, String)> = table.head.iter().skip(1).filter_map(|line| entry(line)).collect();
    let find = |name: &str| said.iter().find(|it| it.0 == name).map(|it| it.1.as_str());
    let number = |name: &str, default: Option<f64>| match find(name).map_or(Ok(default), |it| it.parse().map(Some)) {
        Ok(Some(value)) if value > 0.0 && f64::is_finite(value) => Ok(value),
        Ok(None) => Err(malformed(format!("it has no {name}"))),
        _ => Err(malformed(format!("its {name} has the invalid value {}", find(name).unwrap_or_default()))),
    };
    let [ny, nx] = [number("Y Size", None)? as usize, number("X Size", None)? as usize];
    let is_turned = table.shape() == [nx, ny];
    if !is_turned && table.shape() != [ny, nx] {
        let [lines, numbers] = table.shape();
        return Err(malformed(format!("it states {nx} columns of {ny} heights, but has {lines} lines of {numbers}")));
    }
    let flags = table.head.first().map(|line| line.split_whitespace().rev().nth(1));
    let wavelength = match flags {
        Some(Some("1")) => 1.0,
        _ => number("Wavelength", None)? / number("Mult", Some(1.0))?,
    };
    let [size, aspect] = [number("Pixel_size", None)?, number("Aspect", Some(1.0))?];
    let values = move || if is_turned { rows_of(table.values, [ny, nx]) } else { Ok(table.values) };
    Ok(vec![Channel {
        spacing: Some([aspect * size, size]),
        lateral_unit: Some(1e-3),
        unit: Some(1e-9 * wavelength),
        header: said,
        ..Channel::map("height", [ny, nx], values)
    }])
}

/// A name and its value, the last one of the parts of a line.
fn entry(line: &str) -> Option<(String, String)> {
    let mut parts = line.split('\t').map(str::trim);
    let (name, value) = (parts.next()?, parts.next_back()?);
    (!value.is_empty()).then(|| (name.to_owned(), value.to_owned()))
}
