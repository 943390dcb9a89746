//! The AL3D files of Alicona's focus variation microscopes.

use super::bytes::{ByteReader, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use std::io;
use std::str::FromStr;

/// Tags of 52 bytes, a name, a value as text and a line end, of which the second one counts those behind it; a comment; and images at places
/// that tags say. The depth image has heights in metres, row by row in single precision, its rows filled up to a multiple of eight bytes. A
/// height is void if it is `InvalidPixelValue`, but for the digits that a text loses. The icon and the texture are passed over.
///
/// # Source
/// The files themselves, whose tags are text; Gwyddion 2.61 (`alicona.c`) for the filling of rows and the comparison with the void value.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Alicona AL3D", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"AliconaImaging\0\r\n";
/// Bytes of a tag.
const TAG: usize = 52;
/// Tags that hold nothing but fill space.
const FILLING: [&str; 2] = ["DirSpacer", "PlaceHolder"];
/// The relative deviation from the void value up to which a height is void.
const ROUNDING: f64 = 1e-6;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes).seek(MAGIC.len())?;
    let tags = tags(&mut at)?;
    let depth = depth(at, number(&tags, "DepthImageOffset")?)?;
    let shape = nodes(number(&tags, "Rows")?, number(&tags, "Cols")?, 4, depth.len())?;
    let void = void(&tags)?;
    let doubts = doubts(&tags, bytes.len(), shape)?;
    Ok(vec![Channel {
        spacing: Some([number(&tags, "PixelSizeYMeter")?, number(&tags, "PixelSizeXMeter")?]),
        lateral_unit: Some(1.0),
        unit: Some(1.0),
        doubts,
        header: tags.into_iter().filter(|it| !FILLING.contains(&it.0.as_str())).collect(),
        ..Channel::map("depth", shape, move || heights(depth, shape, void))
    }])
}

/// What begins with the depth image, at a place behind the header.
fn depth(header_end: ByteReader<'_>, place: usize) -> io::Result<&[u8]> {
    match place < header_end.at() {
        true => Err(malformed(format!("its depth image cannot be at byte {place}, where the header is"))),
        false => Ok(header_end.seek(place)?.rest()),
    }
}

/// The doubt that the depth image ends where its rows and columns say: at the next image, or else at the end of the file.
fn doubts(tags: &[(String, String)], length: usize, [ny, nx]: [usize; 2]) -> io::Result<Vec<String>> {
    let start: usize = number(tags, "DepthImageOffset")?;
    let end = start + ny * (4 * nx).next_multiple_of(8);
    let places = tags.iter().filter(|it| it.0.ends_with("Offset")).filter_map(|it| it.1.parse().ok());
    let next = places.filter(|place: &usize| *place > start && *place <= length).min().unwrap_or(length);
    Ok(match next.checked_sub(end) {
        Some(rest) => left_over(rest, "the depth image").into_iter().collect(),
        None => {
            vec![format!("the depth image of {ny} rows of {nx} points overlaps the next part by {} bytes", end - next)]
        }
    })
}

/// Names and values of all tags, and the comment if there is one.
fn tags(at: &mut ByteReader) -> io::Result<Vec<(String, String)>> {
    let mut tags = vec![tag(at)?, tag(at)?];
    let count: usize = number(&tags, "TagCount")?;
    if count > at.rest().len() / TAG {
        return Err(malformed(format!("it states {count} tags, but has only {} bytes for them", at.rest().len())));
    }
    for _ in 0..count {
        tags.push(tag(at)?);
    }
    let comment = at.text(256)?;
    tags.extend((!comment.is_empty()).then(|| ("Comment".to_owned(), comment)));
    Ok(tags)
}

fn tag(at: &mut ByteReader) -> io::Result<(String, String)> {
    let tag = (at.text(20)?, at.text(30)?);
    match at.take(2)? {
        b"\r\n" => Ok(tag),
        _ => Err(malformed(format!("its tag {:?} does not end in a line end", tag.0))),
    }
}

fn find<'a>(tags: &'a [(String, String)], name: &str) -> Option<&'a str> {
    tags.iter().find(|it| it.0 == name).map(|it| it.1.as_str())
}

fn number<T: FromStr>(tags: &[(String, String)], name: &str) -> io::Result<T> {
    let value = find(tags, name).ok_or_else(|| malformed(format!("it has no tag {name}")))?;
    value.parse().map_err(|_| malformed(format!("its tag {name} is {value:?}")))
}

/// The height that marks a void; NaN if there is no other.
fn void(tags: &[(String, String)]) -> io::Result<f64> {
    match find(tags, "InvalidPixelValue") {
        None => Ok(f64::NAN),
        Some(value) if value.contains('#') => Ok(f64::NAN), // as some compilers write NaN
        Some(_) => number(tags, "InvalidPixelValue"),
    }
}

fn heights(depth: &[u8], [ny, nx]: [usize; 2], void: f64) -> io::Result<Vec<f64>> {
    let stride = (4 * nx).next_multiple_of(8);
    let numbers = depth.chunks(stride).take(ny).flat_map(|row| row.chunks_exact(4).take(nx));
    numbers.map(|bytes| ByteReader::new(bytes).f32().map(|z| known(z.into(), void))).collect()
}

/// A height, NaN if it is void.
fn known(height: f64, void: f64) -> f64 {
    if (height - void).abs() <= ROUNDING * void.abs() { f64::NAN } else { height }
}
