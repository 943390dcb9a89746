//! The files of FRT's MicroProf profilometers.

use super::bytes::{ByteReader, latin, left_over};
use super::channel::{Channel, new_name};
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::check_channels;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use std::io;

/// A version and blocks, each of a number, its length and its bytes; lengths have four bytes in version 1.00 and eight in 1.01. Block 0x66 says
/// columns, rows and bits of a point, 0x67 the lengths of the map in metres, 0x6c the metres in a step of heights, and 0x0b holds the points.
/// Block 0x7d holds several images, each with its kind, columns, rows and bits, and repeats the points: where it is there, it is read alone.
/// Points are integers of two bytes without a sign or of four bytes with one, row by row from the lowest row on, so that the last row is at
/// `y = 0`. A point of 1 is void. Images of the topography and of an AFM are heights.
///
/// # Source
/// Gwyddion (`microprof.c`); SurfaceTopography 1.27 (`FRT.py`).
pub(super) const INSTRUMENT: Instrument = Instrument { name: "FRT MicroProf", is_it, channels };

/// What a file begins with, up to the version.
const MAGIC: &[u8] = b"FRTM_GLIDERV";
/// A point without a height.
const VOID: f64 = 1.0;
/// The bits of the kind of an image, without those for its origin.
const KIND: u32 = 0xffdf;
/// The bit of images of the sensor below the sample.
const BELOW: u32 = 0x1000_0000;
/// Kinds of images of heights.
const HEIGHTS: [u32; 2] = [TOPOGRAPHY, 0x1000];
/// The kind of images of the topography.
const TOPOGRAPHY: u32 = 0x4;
/// Names of the kinds of images.
const NAMES: [(u32, &str); 9] = [
    (0x1, "piezo"),
    (0x2, "intensity"),
    (TOPOGRAPHY, "topography"),
    (0x40, "camera"),
    (0x80, "thickness"),
    (0x400, "phase"),
    (0x800, "sample thickness"),
    (0x1000, "AFM"),
    (0x2000, "quality"),
];
/// Blocks of text that are told.
const TEXTS: [(u16, &str); 3] = [(0x65, "Description"), (0x77, "Parameters"), (0x7f, "Calibration")];

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let (blocks, rest) = blocks(bytes)?;
    let find = |number: u16| blocks.iter().find(|it| it.number == number).map(|it| ByteReader::new(it.bytes));
    let need = |number: u16| find(number).ok_or_else(|| malformed(format!("it has no block {number:#04x}")));
    let mut doubts: Vec<String> = left_over(rest, "the last block").into_iter().collect();
    let images = match find(0x7d) {
        Some(at) => images(at)?,
        None => {
            let (mut at, mut points) = (need(0x66)?, need(0x0b)?);
            let [columns, rows, bits] = [at.u32()?, at.u32()?, at.u32()?];
            let image = FrtImage { kind: TOPOGRAPHY, raster: raster(&mut points, [rows, columns], bits)? };
            doubts.extend(left_over(points.rest().len(), "the points"));
            vec![image]
        }
    };
    let mut lengths = need(0x67)?;
    let [width, height] = [lengths.f64()?, lengths.f64()?];
    let mut scale = need(0x6c)?;
    scale.u32()?; // the range of the measurement
    let unit = scale.f64()?;
    if !(unit > 0.0 && unit.is_finite()) {
        return Err(malformed(format!("it states that a step of its heights is {unit:?} metres")));
    }
    let text = |(kind, name): (u16, &str)| Some((name.to_owned(), find(kind).map(|it| text(it.rest()))?));
    let header: Vec<_> = TEXTS.into_iter().filter_map(text).filter(|it| !it.1.is_empty()).collect();
    let mut channels: Vec<Channel> = Vec::new();
    for FrtImage { kind, raster } in images {
        let [ny, nx] = raster.shape.map(|it| it as f64);
        let height_of = |point| if point == VOID { f64::NAN } else { point };
        let values = move || Ok(raster.numbers_from_below()?.into_iter().map(height_of).collect());
        let map = Channel::map(new_name(&name(kind), &channels), raster.shape, values);
        channels.push(Channel {
            is_height: HEIGHTS.contains(&(kind & KIND)),
            unit: Some(unit),
            header: header.clone(),
            doubts: doubts.clone(),
            ..map.spaced([height / ny, width / nx], [Some(1.0); 2])
        });
    }
    Ok(channels)
}

/// A part of the file.
struct FrtBlock<'a> {
    number: u16,
    bytes: &'a [u8],
}

/// All parts, and how many bytes follow them.
fn blocks(bytes: &[u8]) -> io::Result<(Vec<FrtBlock<'_>>, usize)> {
    let mut at = ByteReader::new(bytes).seek(MAGIC.len())?;
    let version = at.text(4)?;
    let is_long = match version.as_str() {
        "1.00" => false,
        "1.01" => true,
        _ => return Err(malformed(format!("it has the version {version:?}, neither 1.00 nor 1.01"))),
    };
    at.u16()?; // number of blocks
    let mut blocks = Vec::new();
    while at.rest().len() >= if is_long { 10 } else { 6 } {
        let number = at.u16()?;
        let length = if is_long { at.u64()? } else { at.u32()?.into() };
        blocks.push(FrtBlock { number, bytes: at.take(usize::try_from(length).unwrap_or(usize::MAX))? });
    }
    Ok((blocks, at.rest().len()))
}

/// An image and its kind.
struct FrtImage<'a> {
    kind: u32,
    raster: ChannelRaster<'a>,
}

/// The images of block 0x7d.
fn images(mut at: ByteReader<'_>) -> io::Result<Vec<FrtImage<'_>>> {
    at.take(8)?; // which ones are shown
    let mut images = Vec::new();
    while !at.rest().is_empty() {
        let [kind, columns, rows, bits] = [at.u32()?, at.u32()?, at.u32()?, at.u32()?];
        images.push(FrtImage { kind, raster: raster(&mut at, [rows, columns], bits)? });
        check_channels(images.len())?;
    }
    Ok(images)
}

/// The next points, each of so many bits.
fn raster<'a>(at: &mut ByteReader<'a>, shape: [u32; 2], bits: u32) -> io::Result<ChannelRaster<'a>> {
    let kind = match bits {
        16 => NumberType::U16,
        32 => NumberType::I32,
        _ => return Err(malformed(format!("its points have {bits} bits, neither 16 nor 32"))),
    };
    ChannelRaster::new(at, kind, shape.map(i64::from))
}

/// The name of a kind of images.
fn name(kind: u32) -> String {
    let name = NAMES.iter().find(|it| it.0 == kind & KIND).map_or("image", |it| it.1);
    if kind & BELOW == 0 { name.to_owned() } else { format!("{name}, sensor below") }
}

/// The text up to the first zero.
fn text(bytes: &[u8]) -> String {
    latin(bytes.split(|byte| *byte == 0).next().unwrap_or_default()).trim().to_owned()
}
