//! The files of MetroPro, with which Zygo's interferometers measure.

use super::bytes::{ByteReader, left_over};
use super::channel::{Channel, new_name};
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::check_channels;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use std::io;

/// A header of fixed fields of 834 bytes (formats 1 and 2) or 4096 bytes (format 3), images of the intensity as integers of two bytes, and
/// phases as integers of four bytes, row by row, the most significant byte first. A phase times wavelength, scale and obliquity, over its
/// resolution, is a height in metres, which a flag turns around. Points are as far apart along y as along x. A phase is void from
/// 2147483640 on.
///
/// # Source
/// Gwyddion (`metropro.c`) and SurfaceTopography 1.27 (`MetroPro.py`).
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Zygo MetroPro", is_it, channels };

/// What files of the formats 1, 2 and 3 begin with.
const MAGICS: [&[u8]; 3] = [b"\x88\x1b\x03\x6f", b"\x88\x1b\x03\x70", b"\x88\x1b\x03\x71"];
/// The fewest bytes of a header.
const HEADER: usize = 834;
/// The first phase that is void.
const VOID: f64 = 2_147_483_640.0;
/// Places of fields: bytes of the header, columns and rows of the images and their number, columns and rows of the phases.
const LENGTH: usize = 6;
const PIXELS: usize = 52;
const IMAGES: usize = 56;
const POINTS: usize = 68;
/// Places of fields of the phases: factors, distance of points, code of the resolution, and whether heights are turned around.
const SCALE: usize = 164;
const WAVELENGTH: usize = 168;
const OBLIQUITY: usize = 176;
const SPACING: usize = 184;
const RESOLUTION: usize = 218;
const SIGN: usize = 232;
/// Texts in the header: names, places and lengths.
const TEXTS: [(&str, [usize; 2]); 6] = [
    ("Date", [12, 30]),
    ("Comment", [80, 82]),
    ("Objective", [246, 12]),
    ("Part", [258, 40]),
    ("Serial number", [320, 40]),
    ("Scan", [408, 20]),
];

fn is_it(bytes: &[u8]) -> bool {
    MAGICS.iter().any(|magic| bytes.starts_with(magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let at = |place: usize| ByteReader::new(bytes).big_endian(true).seek(place);
    let length = at(LENGTH)?.u32()? as usize;
    if length < HEADER {
        return Err(malformed(format!("its header has {length} bytes, but at least {HEADER} are needed")));
    }
    let mut data = at(length)?;
    let header = header(bytes)?;
    let spacing = Some(f64::from(at(SPACING)?.f32()?)).filter(|it| *it != 0.0);
    let (pixels, points) = (shape(at(PIXELS)?)?, shape(at(POINTS)?)?);
    let images = if pixels == [0, 0] { 0 } else { usize::from(at(IMAGES)?.u16()?) };
    check_channels(images + 1)?;
    let mut channels: Vec<Channel> = Vec::new();
    for _ in 0..images {
        let raster = ChannelRaster::new(&mut data, NumberType::U16, pixels)?;
        let name = new_name("intensity", &channels);
        let map = Channel::map(name, raster.shape, move || raster.numbers());
        channels.push(Channel { is_height: false, ..map });
    }
    if points != [0, 0] {
        let raster = ChannelRaster::new(&mut data, NumberType::I32, points)?;
        let height = |phase: f64| if phase < VOID { phase } else { f64::NAN };
        let values = move || Ok(raster.numbers()?.into_iter().map(height).collect());
        channels.push(Channel { unit: Some(unit(bytes)?), ..Channel::map("height", raster.shape, values) });
    }
    let rest = left_over(data.rest().len(), "the phases");
    for channel in &mut channels {
        channel.header.clone_from(&header);
        channel.doubts.extend(rest.clone());
        channel.spacing = spacing.map(|it| [it; 2]);
        channel.lateral_unit = spacing.map(|_| 1.0);
    }
    Ok(channels)
}

/// Rows and columns out of columns and rows.
fn shape(mut at: ByteReader) -> io::Result<[i64; 2]> {
    let [columns, rows] = [at.u16()?, at.u16()?].map(i64::from);
    Ok([rows, columns])
}

/// Metres in a phase of one.
fn unit(bytes: &[u8]) -> io::Result<f64> {
    let at = |place: usize| ByteReader::new(bytes).big_endian(true).seek(place);
    let [scale, wavelength, obliquity] =
        [at(SCALE)?.f32()?, at(WAVELENGTH)?.f32()?, at(OBLIQUITY)?.f32()?].map(f64::from);
    let resolution = match at(RESOLUTION)?.i16()? {
        0 => 4096.0,
        1 => 32768.0,
        2 => 131_072.0,
        code => return Err(malformed(format!("its phases have the resolution {code}, which is none of 0, 1 and 2"))),
    };
    let sign = if at(SIGN)?.i16()? == 0 { 1.0 } else { -1.0 };
    match sign * scale * wavelength * obliquity / resolution {
        unit if unit.is_finite() && unit != 0.0 => Ok(unit),
        unit => Err(malformed(format!("it states that a phase of one is {unit:?} metres"))),
    }
}

/// The texts of the header.
fn header(bytes: &[u8]) -> io::Result<Vec<(String, String)>> {
    let text = |(name, [place, length]): (&str, [usize; 2])| {
        Ok((name.to_owned(), ByteReader::new(bytes).seek(place)?.text(length)?))
    };
    let texts = TEXTS.into_iter().map(text).collect::<io::Result<Vec<_>>>()?;
    Ok(texts.into_iter().filter(|it| !it.1.is_empty()).collect())
}
