//! The images of WSxM, the program for scanning probe microscopes.

use super::bytes::{ByteReader, latin, left_over};
use super::channel::{Channel, may_be_height};
use super::entries::{Entries, EntrySection, sections};
use super::format::malformed;
use super::instrument::Instrument;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use super::unit::metres_of_si;
use std::io;

/// A header of `[parts]` with lines of `name: value` up to the line `[Header end]`, and numbers row by row, the least significant byte first:
/// integers of two bytes (`short`, `integer`) or floating point numbers (`float`, `double`). `Z Amplitude` is the difference of the highest
/// and the lowest height, and thus says what a number is; `X Amplitude` and `Y Amplitude` are the lengths of the image. Numbers stand from
/// right to left and from the lowest row on, so that the last one is at `x = 0, y = 0`. No value is void.
///
/// # Source
/// "File specifications" of SPMImages (Universidad Autónoma de Madrid) for the header; Gwyddion (`wsxmfile.c`) for order and types of numbers. The length of the header is not believed: some programs write a wrong one.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "WSxM (STP, TOP)", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"WSxM file copyright";
/// The second line of a file of an image.
const IMAGE: &str = "SxM Image file";
/// The relative error of a stated difference of heights.
const ROUNDING: f64 = 1e-5;
/// The last line of the header.
const END: &[u8] = b"[Header end]";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let end = bytes.windows(END.len()).position(|it| it == END);
    let end = end.ok_or_else(|| malformed("its header has no end, which is the line [Header end]"))?;
    let header = latin(&bytes[..end]);
    let kind = header.lines().nth(1).unwrap_or_default().trim();
    if kind != IMAGE {
        return Err(malformed(format!("it is a file of the type {kind:?}, not {IMAGE:?}")));
    }
    let rest = &bytes[end + END.len()..];
    let line = rest.iter().position(|byte| *byte == b'\n').map_or(0, |place| place + 1);
    let entries = flat(sections(&header, ':'));
    let shape = [entries.number("Number of rows")?, entries.number("Number of columns")?];
    let mut at = ByteReader::new(&rest[line..]);
    let raster = ChannelRaster::new(&mut at, number_type(entries.find("Image Data Type"))?, shape)?;
    let amplitude = entries.find("Z Amplitude").map(WsxmLength::new).transpose()?;
    let span = amplitude.as_ref().map_or(f64::NAN, |it| it.number);
    let values = move || Ok(scaled(raster.numbers()?, span));
    let name = entries.find("Acquisition channel").filter(|it| !it.is_empty()).unwrap_or("image");
    let map = Channel::map(name, raster.shape, values);
    let unit = amplitude.as_ref().map_or("", |it| it.unit);
    let (unit, is_length) = (metres_of_si(unit), ["", "a.u."].contains(&unit) || metres_of_si(unit).is_some());
    let [y, x] = [WsxmLength::new(entries.need("Y Amplitude")?)?, WsxmLength::new(entries.need("X Amplitude")?)?];
    let [ny, nx] = raster.shape.map(|it| it as f64);
    Ok(vec![Channel {
        is_height: is_length && may_be_height(name),
        unit,
        header: entries.header(),
        doubts: left_over(at.rest().len(), "the last row").into_iter().collect(),
        ..map.spaced([y.number / ny, x.number / nx], [metres_of_si(y.unit), metres_of_si(x.unit)])
    }])
}

/// All parts as one.
fn flat(sections: Vec<EntrySection>) -> Entries {
    sections.into_iter().fold(Entries::default(), |mut all, it| {
        all.extend(it.entries);
        all
    })
}

/// The type of numbers by its name.
fn number_type(name: Option<&str>) -> io::Result<NumberType> {
    match name {
        None | Some("short" | "integer") => Ok(NumberType::I16),
        Some("float") => Ok(NumberType::F32),
        Some("double") => Ok(NumberType::F64),
        Some(other) => Err(malformed(format!("its numbers are of the type {other:?}, which is not known"))),
    }
}

/// A number with a unit.
struct WsxmLength<'a> {
    number: f64,
    unit: &'a str,
}

impl<'a> WsxmLength<'a> {
    fn new(text: &'a str) -> io::Result<Self> {
        let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
        let number = number.parse().map_err(|_| malformed(format!("its header has the invalid length {text:?}")))?;
        Ok(Self { number, unit: unit.trim() })
    }
}

/// Heights out of numbers that span a difference of heights, from the last number on. The numbers are heights if that difference is not known
/// or not positive, or if it is theirs except for its rounding.
fn scaled(mut numbers: Vec<f64>, span: f64) -> Vec<f64> {
    let known = || numbers.iter().copied().filter(|it| it.is_finite());
    let range = known().fold(f64::NEG_INFINITY, f64::max) - known().fold(f64::INFINITY, f64::min);
    let is_height = !(span > 0.0 && range > 0.0) || (span / range - 1.0).abs() < ROUNDING;
    let scale = if is_height { 1.0 } else { span / range };
    numbers.iter_mut().for_each(|it| *it *= scale);
    numbers.reverse();
    numbers
}
