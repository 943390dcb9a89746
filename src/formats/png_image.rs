//! Heights as grey values of PNG images.

use super::bytes::{ByteReader, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::zlib::unpack;
use std::io;

/// Chunks of a length, a name, bytes and a check sum, the most significant byte first: `IHDR` with columns, rows, bits, the kind of colours and
/// the way of interlacing, and `IDAT` with the points as a zlib stream, row by row from the top. Each row begins with the filter that predicts
/// its bytes from those before and above. Heights are the grey values as numbers, without a unit or a size. Images with colours, of which no one
/// can know what they mean, with transparency, interlaced or of fewer than 8 bits are refused.
///
/// # Source
/// "Portable Network Graphics (PNG) Specification (Third Edition)", W3C.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "PNG image", is_it, channels };

/// What files begin with.
const MAGIC: &[u8] = b"\x89PNG\r\n\x1a\n";
/// The kind of colours of grey values alone.
const GREY: u8 = 0;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes).big_endian(true).seek(MAGIC.len())?;
    let mut header = chunk(&mut at)?.filter(|it| it.0 == b"IHDR").ok_or_else(|| malformed("it has no header"))?.1;
    let [columns, rows] = [header.u32()?, header.u32()?].map(i64::from);
    let [bits, colours, _, _, interlaced] = [header.u8()?, header.u8()?, header.u8()?, header.u8()?, header.u8()?];
    if colours != GREY {
        return Err(malformed("its colours say no heights: export the heights themselves, or an image of grey values"));
    }
    if ![8, 16].contains(&bits) || interlaced != 0 {
        return Err(malformed(format!(
            "it has {bits} bits per point and way {interlaced} of interlacing: save 8 or 16 bits without interlacing"
        )));
    }
    let size = usize::from(bits / 8);
    let mut stream = Vec::new();
    while let Some((name, part)) = chunk(&mut at)? {
        match name {
            b"IDAT" => stream.extend_from_slice(part.rest()),
            b"IEND" => break,
            _ => {}
        }
    }
    // a stream can be unpacked to about a thousand times its length
    let shape = nodes(rows, columns, size, stream.len().saturating_mul(super::limits::LARGEST_RATIO))?;
    Ok(vec![Channel::map("grey value", shape, move || points(&stream, shape, size))])
}

/// The name and the bytes of the next chunk, none at the end of the file.
fn chunk<'a>(at: &mut ByteReader<'a>) -> io::Result<Option<(&'a [u8], ByteReader<'a>)>> {
    if at.rest().is_empty() {
        return Ok(None);
    }
    let length = at.u32()? as usize;
    let name = at.take(4)?;
    let part = at.part(length)?;
    at.take(4)?;
    Ok(Some((name, part)))
}

/// The points of a stream, each of one byte or two.
fn points(stream: &[u8], [ny, nx]: [usize; 2], size: usize) -> io::Result<Vec<f64>> {
    let width = nx * size;
    let mut packed = Vec::new();
    unpack(stream, ((width + 1) * ny) as u64, &mut packed)?;
    if packed.len() < (width + 1) * ny {
        return Err(malformed("its points are incomplete"));
    }
    let mut above = vec![0_u8; width];
    let mut values = Vec::with_capacity(ny * nx);
    for row in packed.chunks_exact_mut(width + 1).take(ny) {
        let (filter, row) = (row[0], &mut row[1..]);
        for i in 0..width {
            let before = |row: &[u8]| if i >= size { row[i - size] } else { 0 };
            let (left, up, corner) = (before(row), above[i], before(&above));
            let predicted = match filter {
                0 => 0,
                1 => left,
                2 => up,
                3 => ((u16::from(left) + u16::from(up)) / 2) as u8,
                4 => nearest(left, up, corner),
                _ => return Err(malformed(format!("it has a row with the filter {filter}"))),
            };
            row[i] = row[i].wrapping_add(predicted);
        }
        above.copy_from_slice(row);
        let value = |bytes: &[u8]| bytes.iter().fold(0.0, |number, byte| 256.0 * number + f64::from(*byte));
        values.extend(row.chunks_exact(size).map(value));
    }
    Ok(values)
}

/// Paeth's prediction: that of three bytes that is nearest to left + up - corner.
fn nearest(left: u8, up: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, up, corner].map(i32::from);
    let off = |byte: i32| (a + b - c - byte).abs();
    match (off(a), off(b), off(c)) {
        (to_a, to_b, to_c) if to_a <= to_b && to_a <= to_c => left,
        (_, to_b, to_c) if to_b <= to_c => up,
        _ => corner,
    }
}
