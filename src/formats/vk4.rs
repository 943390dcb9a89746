//! The VK4 files of Keyence's laser microscopes of the series VK.

use super::bytes::{ByteReader, left_over, nodes};
use super::channel::{Channel, listed};
use super::format::malformed;
use super::instrument::Instrument;
use std::io;

/// Four bytes that name the format, a table of places, settings of the measurement, and images: columns, rows, bits of a number, a palette
/// and numbers without sign, row by row. Up to three images are heights, in a number of picometres that the settings say; so is the distance
/// of points. Up to three are intensities, which are not read. The format knows no void points. VK6 and VK7, which pack the same, are refused.
///
/// # Source
/// Gwyddion 2.61 (`keyence.c`), torkian/vk4-python-driver and SurfaceTopography 1.27 (`VK.py`). Files that follow them are read; no file of an
/// instrument has been tried yet.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Keyence VK4", is_it, channels };

/// What files of each version begin with.
const MAGIC: [&[u8]; 2] = [b"VK3_", b"VK4_"];
/// What files that pack the others begin with.
const PACKED: [&[u8]; 2] = [b"VK6", b"VK7"];
/// The place of the table of places.
const TABLE: usize = 12;
/// Places in the table of the images of intensities and of heights.
const IMAGES: [(&str, usize); 6] =
    [("light", 3), ("light 2", 4), ("light 3", 5), ("height", 6), ("height 2", 7), ("height 3", 8)];
/// Where dates are among the settings, and where the distances of points and of heights are.
const DATE: usize = 4;
const DISTANCES: usize = 4 * 42;
/// Bytes of a palette.
const PALETTE: usize = 768;
/// Metres in the unit of all lengths.
const PICOMETRE: f64 = 1e-12;

fn is_it(bytes: &[u8]) -> bool {
    MAGIC.iter().chain(&PACKED).any(|magic| bytes.starts_with(magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let at = ByteReader::new(bytes);
    if PACKED.iter().any(|magic| bytes.starts_with(magic)) {
        return Err(malformed("it is of the version VK6 or VK7: save it as VK4"));
    }
    let settings = at.seek(TABLE)?.u32()? as usize;
    let mut date = at.seek(settings.saturating_add(DATE))?;
    let [year, month, day, hour, minute, second] =
        [date.u32()?, date.u32()?, date.u32()?, date.u32()?, date.u32()?, date.u32()?];
    let date = format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02}");
    let mut distances = at.seek(settings.saturating_add(DISTANCES))?;
    let [x, y, z] = [distances.u32()?, distances.u32()?, distances.u32()?].map(f64::from);
    let mut found = Vec::new();
    for (name, place) in IMAGES {
        let place = at.seek(TABLE + 4 * place)?.u32()? as usize;
        if place > 0 {
            let channel = at.seek(place).and_then(|at| image(name, at)).map(|it| Channel {
                is_height: name.starts_with("height"),
                spacing: Some([y, x]),
                lateral_unit: Some(PICOMETRE),
                unit: Some(z * PICOMETRE),
                header: vec![("Date".to_owned(), date.clone())],
                ..it
            });
            found.push((name, channel));
        }
    }
    listed(found)
}

/// The channel of an image.
fn image<'a>(name: &str, mut at: ByteReader<'a>) -> io::Result<Channel<'a>> {
    let [columns, rows, bits, _, length] = [at.u32()?, at.u32()?, at.u32()?, at.u32()?, at.u32()?];
    let length = length as usize;
    at.take(2 * 4 + PALETTE)?; // the range of the palette
    let size = match bits {
        8 | 16 | 32 => bits as usize / 8,
        _ => return Err(malformed(format!("its image {name:?} has numbers of {bits} bits, not 8, 16 or 32"))),
    };
    let [ny, nx] = nodes(rows.into(), columns.into(), size, at.rest().len().min(length))?;
    let points = at.take(nx * ny * size)?;
    let values = move || points.chunks_exact(size).map(number).collect();
    let doubts = left_over(length - points.len(), &format!("the points of {name:?}")).into_iter().collect();
    Ok(Channel { doubts, ..Channel::map(name, [ny, nx], values) })
}

/// The number without sign in one, two or four bytes.
fn number(bytes: &[u8]) -> io::Result<f64> {
    let mut at = ByteReader::new(bytes);
    match bytes.len() {
        1 => at.u8().map(f64::from),
        2 => at.u16().map(f64::from),
        _ => at.u32().map(f64::from),
    }
}
