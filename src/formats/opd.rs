//! The OPD files of Wyko interferometers.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use ndarray::{Array2, Axis};
use std::io;

/// Two bytes, a directory of blocks with a name, a type and a length, whose first entry is the directory itself, and the blocks one after
/// the other in its order. A block of an array has columns, rows and bytes of a number, and numbers column by column, each from its last row
/// on. Heights are in wavelengths of `Wavelength` nanometres, over `Mult`; points are `Pixel_size` millimetres apart along x and `Aspect` times
/// that along y. A height is void from 1e38 on, or from 32766 on if it is an integer of two bytes. Other arrays are intensities and qualities.
///
/// # Source
/// Veeco's `readopd.m` (2001-2010), for the numbers that are void, too; Gwyddion 2.61 and SurfaceTopography 1.27 for the types of blocks.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Wyko OPD", is_it, channels };

/// Bytes of an entry of the directory.
const ENTRY: usize = 24;
/// Names of the arrays of heights.
const HEIGHTS: [&str; 5] = ["OPD", "Raw", "RAW DATA", "RAW_DATA", "SAMPLE_DATA"];
/// The type of a block of an array.
const ARRAY: u16 = 3;
/// The most arrays of heights that a file may have, each with a header of its own.
const MOST: usize = 32;
/// The most values of a header.
const VALUES: usize = 1000;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x01\x00Directory")
}

fn channels<'a>(bytes: &'a [u8]) -> io::Result<Vec<Channel<'a>>> {
    let (blocks, rest) = blocks(bytes)?;
    let arrays: Vec<&Block> = blocks.iter().filter(|it| it.kind == ARRAY).collect();
    let heights = arrays.iter().filter(|it| it.is_height()).count();
    if heights > MOST {
        return Err(malformed(format!("it contains {heights} arrays of heights, but at most {MOST} are read")));
    }
    let channel = |array: &Block<'a>| if array.is_height() { map(array, &blocks) } else { array.channel() };
    let channels = arrays.into_iter().map(|array| Channel::or_unreadable(&*array.name, channel(array)));
    let mut channels: Vec<Channel> = channels.collect();
    let rest = left_over(rest, "the last block");
    channels.iter_mut().for_each(|it| it.doubts.extend(rest.clone()));
    Ok(channels)
}

/// A part of the file.
struct Block<'a> {
    name: String,
    kind: u16,
    bytes: &'a [u8],
}

/// All parts that are not empty, and how many bytes follow them.
fn blocks(bytes: &[u8]) -> io::Result<(Vec<Block<'_>>, usize)> {
    let mut directory = ByteReader::new(bytes).seek(2)?;
    let (_, _, length) = entry(&mut directory)?;
    let mut data = directory.seek(length.saturating_add(2))?;
    let mut blocks = Vec::new();
    for _ in 1..length / ENTRY {
        let (name, kind, length) = entry(&mut directory)?;
        if length > 0 {
            blocks.push(Block { name, kind, bytes: data.take(length)? });
        }
    }
    Ok((blocks, data.rest().len()))
}

/// Name, type and length of a block.
fn entry(at: &mut ByteReader) -> io::Result<(String, u16, usize)> {
    let (name, kind, length) = (at.text(16)?, at.u16()?, at.i32()?);
    at.u16()?; // a number of unknown meaning
    let length = usize::try_from(length)
        .map_err(|_| malformed(format!("its block {name:?} has an invalid length of {length} bytes")));
    Ok((name, kind, length?))
}

impl<'a> Block<'a> {
    fn is_height(&self) -> bool {
        HEIGHTS.contains(&self.name.as_str())
    }

    /// A number as a number or a text, and a text, as a person reads them.
    fn value(&self) -> Option<String> {
        match (self.kind, self.bytes) {
            (5, bytes) => ByteReader::new(bytes).text(bytes.len()).ok(),
            (15, [0x12, 1, length, text @ ..]) if text.len() == usize::from(*length) => Some(latin(text)),
            _ => self.number().map(|it| it.to_string()),
        }
        .filter(|value| !value.is_empty())
    }

    fn number(&self) -> Option<f64> {
        let mut at = ByteReader::new(self.bytes);
        match self.kind {
            6 => at.i16().ok().map(f64::from),
            7 => at.f32().ok().map(f64::from),
            8 => at.f64().ok(),
            12 => at.i32().ok().map(f64::from),
            _ => None,
        }
    }

    /// The channel of an array, of which the file says no more than its values.
    fn channel(&self) -> io::Result<Channel<'a>> {
        let mut at = ByteReader::new(self.bytes);
        let [columns, rows, size] = [at.u16()?, at.u16()?, at.u16()?];
        let value = number(size)?;
        let (rest, size) = (at.rest(), usize::from(size));
        let shape = nodes(rows.into(), columns.into(), size, rest.len())?;
        let stored = rest.chunks_exact(size).take(shape[0] * shape[1]);
        let values = move || rows_of(stored.map(value).collect::<io::Result<_>>()?, shape);
        let rest = left_over(rest.len() - shape[0] * shape[1] * size, &format!("the points of {:?}", self.name));
        let doubts = rest.into_iter().collect();
        Ok(Channel { is_height: false, doubts, ..Channel::map(&*self.name, shape, values) })
    }
}

/// The channel of an array of heights, with what other blocks say of it.
fn map<'a>(array: &Block<'a>, blocks: &[Block<'a>]) -> io::Result<Channel<'a>> {
    let find = |name: &str| blocks.iter().find(|it| it.name == name).and_then(Block::number);
    let positive = |name: &str, default: Option<f64>| match find(name).or(default) {
        Some(value) if value > 0.0 && value.is_finite() => Ok(value),
        Some(value) => Err(malformed(format!("its {name} has the invalid value {value:?}"))),
        None => Err(malformed(format!("it has no {name}"))),
    };
    let [size, aspect] = [positive("Pixel_size", None)?, positive("Aspect", Some(1.0))?];
    let header = blocks.iter().filter_map(|block| Some((block.name.clone(), block.value()?)));
    Ok(Channel {
        is_height: true,
        spacing: Some([aspect * size, size]),
        lateral_unit: Some(1e-3),
        unit: Some(positive("Wavelength", None)? * 1e-9 / positive("Mult", Some(1.0))?),
        header: header.take(VALUES).collect(),
        ..array.channel()?
    })
}

/// A number in the bytes of a file.
type Number = fn(&[u8]) -> io::Result<f64>;

/// How a number of a given size in bytes is read.
fn number(size: u16) -> io::Result<Number> {
    match size {
        1 => Ok(|it| ByteReader::new(it).u8().map(f64::from)),
        2 => Ok(|it| ByteReader::new(it).i16().map(|value| if value < 32766 { value.into() } else { f64::NAN })),
        4 => Ok(|it| ByteReader::new(it).f32().map(|value| if value.abs() < 1e38 { value.into() } else { f64::NAN })),
        _ => Err(malformed(format!("a number of an array cannot have {size} bytes"))),
    }
}

/// Values row by row of those that are stored column by column, each from its last row on.
pub(super) fn rows_of(stored: Vec<f64>, [ny, nx]: [usize; 2]) -> io::Result<Vec<f64>> {
    let columns =
        Array2::from_shape_vec((nx, ny), stored).map_err(|error| malformed(format!("it is damaged: {error}")))?;
    let mut rows = columns.reversed_axes();
    rows.invert_axis(Axis(0));
    Ok(rows.iter().copied().collect())
}
