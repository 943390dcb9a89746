//! The PLU files of Sensofar's confocal and interferometric profilers.

use super::bytes::{ByteReader, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;

/// Fixed fields of 500 bytes: a date as text and as number, a comment, distances and origins of the axes, and settings. Then each layer: rows,
/// columns, heights row by row in single precision, the smallest and the largest of them, and pictures. Behind the last layer there is more. All lengths are micrometres. A height of
/// 1000001 is void. Profiles and topographies are read; images, series of profiles and maps of coordinates are refused.
///
/// # Source
/// Gwyddion 2.61 (`sensofar.c`) for the fields; SurfaceTopography 1.27 for the settings of points, which have as many bytes as those of areas.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Sensofar PLU", is_it, channels };

/// A date such as "Fri Mar 10 16:35:59 2023", with A for a letter, 0 for a digit and 1 for a digit or space.
const DATE: &[u8] = b"AAA AAA 10 00:00:00 0000";
/// The place of the byte that says the version, which is zero or counts down from 255.
const VERSION: usize = 490;
/// Metres in the unit of all lengths.
const MICROMETRE: f64 = 1e-6;
/// The marks of a height that was not measured.
const VOID: f32 = 1_000_001.0;

fn is_it(bytes: &[u8]) -> bool {
    let is_date = bytes.len() > DATE.len() && bytes.iter().zip(DATE).all(|(byte, like)| is_like(*byte, *like));
    let is_end = bytes.get(DATE.len()).is_some_and(|byte| *byte < b' ');
    is_date && is_end && bytes.get(VERSION).is_some_and(|version| matches!(version, 0 | 0xf0..))
}

fn is_like(byte: u8, like: u8) -> bool {
    match like {
        b'A' => byte.is_ascii_alphabetic(),
        b'0' => byte.is_ascii_digit(),
        b'1' => byte.is_ascii_digit() || byte == b' ',
        like => byte == like,
    }
}

/// What the fields say.
struct Fields {
    spacing: [f64; 2],
    is_profile: bool,
    /// Rows and columns, which each layer says again.
    counts: [u32; 2],
    layers: u8,
    pictures: u8,
    header: Vec<(String, String)>,
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes);
    let fields = fields(&mut at)?;
    let (mut channels, mut last) = (Vec::new(), None);
    for layer in 1..=fields.layers {
        let name = if fields.layers == 1 { "height".to_owned() } else { format!("layer {layer}") };
        let found = channel(&mut at, &name, &fields, last);
        last = found.as_ref().ok().map(|it| it.shape);
        channels.push(Channel::or_unreadable(name, found));
        if last.is_none() {
            break; // where the layers behind it are is not known
        }
    }
    Ok(channels)
}

/// The layer behind the last one, which has a shape unless there is none.
fn channel<'a>(
    at: &mut ByteReader<'a>,
    name: &str,
    fields: &Fields,
    last: Option<[usize; 2]>,
) -> io::Result<Channel<'a>> {
    last.map_or(Ok(()), |shape| skip_rest(at, shape, fields.pictures))?;
    let (shape, heights) = layer_of(at)?;
    if fields.is_profile && shape[0] != 1 {
        return Err(malformed(format!("it is a profile, but states {} rows", shape[0])));
    }
    Ok(Channel {
        is_profile: fields.is_profile,
        spacing: Some(fields.spacing),
        lateral_unit: Some(MICROMETRE),
        unit: Some(MICROMETRE),
        header: fields.header.clone(),
        doubts: doubt(fields, name, shape).into_iter().collect(),
        ..Channel::map(name, shape, move || heights.chunks_exact(4).map(height).collect())
    })
}

/// The doubt that a layer of a topography has other counts than the fields.
fn doubt(fields: &Fields, name: &str, [ny, nx]: [usize; 2]) -> Option<String> {
    let [rows, columns] = fields.counts;
    let is_other = !fields.is_profile && rows > 0 && columns > 0 && [rows as usize, columns as usize] != [ny, nx];
    is_other.then(|| format!("the header states {rows} rows of {columns} points, but {name} has {ny} rows of {nx}"))
}

fn fields(at: &mut ByteReader) -> io::Result<Fields> {
    let date = at.text(128)?;
    at.u32()?; // the date as a number
    let comment = at.text(256)?;
    let counts = [at.u32()?, at.u32()?];
    at.u32()?; // number of profiles in a series
    at.f32()?; // distance of profiles in a series
    let [x, y, x_0, y_0] = [at.f32()?, at.f32()?, at.f32()?, at.f32()?];
    at.f32()?; // distance of points in a cut
    let z_0 = at.f32()?;
    let [kind, algorithm, method, objective] = [at.u32()?, at.u32()?, at.u32()?, at.u32()?];
    at.take(4 + 40)?; // kind of area and settings of the scan
    let [_, layers, version, hardware, pictures] = [at.u8()?, at.u8()?, at.u8()?, at.u8()?, at.u8()?];
    at.take(3 + 4)?; // reserved, and a factor of the display
    let is_profile = is_profile(kind)?;
    let spacing = [if is_profile { x } else { y }, x].map(f64::from);
    let kind = if is_profile { "profile" } else { "topography" };
    let header = [
        ("Date", date),
        ("Comment", comment),
        ("Measurement", kind.to_owned()),
        ("Algorithm", algorithm.to_string()),
        ("Method", method.to_string()),
        ("Objective", objective.to_string()),
        ("Version", version.to_string()),
        ("Hardware", hardware.to_string()),
        ("X0", format!("{x_0} µm")),
        ("Y0", format!("{y_0} µm")),
        ("Z0", format!("{z_0} µm")),
    ];
    let header = header.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    Ok(Fields { spacing, is_profile, counts, layers, pictures, header })
}

fn is_profile(kind: u32) -> io::Result<bool> {
    match kind {
        1 => Ok(true),
        3 => Ok(false),
        _ => Err(malformed(format!("it is a measurement of type {kind}, neither a profile nor a topography"))),
    }
}

/// Rows and columns of a layer, and the bytes of its heights.
fn layer_of<'a>(at: &mut ByteReader<'a>) -> io::Result<([usize; 2], &'a [u8])> {
    let [rows, columns] = [at.u32()?, at.u32()?];
    let shape = nodes(rows.into(), columns.into(), 4, at.rest().len())?;
    Ok((shape, at.take(4 * shape[0] * shape[1])?))
}

/// Passes over what is between the heights of a layer and the next one.
fn skip_rest(at: &mut ByteReader, [ny, nx]: [usize; 2], pictures: u8) -> io::Result<()> {
    at.take(8)?; // the smallest and the largest height
    (0..pictures).try_for_each(|_| at.take(3 * ny * nx).map(drop))
}

fn height(bytes: &[u8]) -> io::Result<f64> {
    ByteReader::new(bytes).f32().map(|z| if z == VOID { f64::NAN } else { z.into() })
}
