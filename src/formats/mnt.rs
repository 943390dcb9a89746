//! The MNT documents of Digital Surf's Mountains.

use super::bytes::{ByteReader, nodes};
use super::channel::{Channel, listed};
use super::compound::{self, stream};
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::LARGEST_RATIO;
use super::unit::metres;
use super::zlib::unpack;
use std::io;

/// A compound document whose stream `ScopedContents` is a tree of entries, each of a tag of two bytes, a length of eight and its data. Objects
/// of the class 9012 are measured surfaces: two axes, heights as integers in blocks of zlib, their step and their origin, and a mask of the
/// points that were measured. Rows are kept in the order of the file. What Mountains derives from a surface is not in the file.
///
/// # Source
/// SurfaceTopography 1.27 (`MNT.py` and its description), which found this out from files. Streams of the document follow \[MS-CFB\].
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Digital Surf (MNT)", is_it, channels };

/// The stream with the measured surfaces.
const CONTENTS: &str = "ScopedContents";
/// The most surfaces of a document.
const MOST: usize = 32;
/// Classes of objects: a surface, its measurement, its heights, its mask and the points of the mask.
const SURFACE: u32 = 9012;
const MEASUREMENT: u32 = 9062;
const HEIGHTS: u32 = 9049;
const MASK: u32 = 9056;
const POINTS: u32 = 9048;
/// The tag of what an object inherits.
const PARENT: u16 = 0xffff;
/// The mark of a text.
const TEXT: u8 = 4;
/// The mark of a point that was measured.
const MEASURED: u8 = 9;

fn is_it(bytes: &[u8]) -> bool {
    let name: Vec<u8> = CONTENTS.encode_utf16().flat_map(u16::to_le_bytes).collect();
    bytes.starts_with(compound::MAGIC) && bytes.windows(name.len()).any(|it| it == name)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let contents = stream(bytes, CONTENTS)?;
    let main = find(contents.get(8..).unwrap_or_default(), &[1]).ok_or_else(|| malformed("it has no contents"))?;
    let mut surfaces = Vec::new();
    for (place, object) in objects(find(main, &[0x02bd, 2, 1]).unwrap_or_default())?.into_iter().enumerate() {
        if class(object) != Some(SURFACE) {
            continue;
        }
        let title = text(object, &[2, PARENT, 4]).unwrap_or_else(|| format!("surface {}", place + 1));
        surfaces.push((title.clone(), surface(object, &title)));
    }
    if surfaces.len() > MOST {
        return Err(malformed(format!("it contains {} surfaces, but at most {MOST} are read", surfaces.len())));
    }
    let header = header(main);
    let mut channels = listed(surfaces)?;
    channels.iter_mut().for_each(|it| it.header.clone_from(&header));
    Ok(channels)
}

/// Tag and data of the entry at a place.
fn entry<'a>(at: &mut ByteReader<'a>) -> io::Result<(u16, &'a [u8])> {
    let (tag, length) = (at.u16()?, at.i64()?);
    Ok((tag, at.take(usize::try_from(length).unwrap_or(usize::MAX))?))
}

/// The data at the end of a path of tags.
fn find<'a>(data: &'a [u8], path: &[u16]) -> Option<&'a [u8]> {
    let Some((wanted, rest)) = path.split_first() else { return Some(data) };
    let mut at = ByteReader::new(data);
    while let Ok((tag, inner)) = entry(&mut at) {
        if tag == *wanted {
            return find(inner, rest);
        }
    }
    None
}

fn u32_of(data: &[u8], path: &[u16]) -> Option<u32> {
    ByteReader::new(find(data, path)?).u32().ok()
}

fn f64_of(data: &[u8], path: &[u16]) -> Option<f64> {
    ByteReader::new(find(data, path)?).f64().ok()
}

/// A text that is not empty.
fn text(data: &[u8], path: &[u16]) -> Option<String> {
    let [TEXT, letters @ ..] = find(data, path)? else { return None };
    let letters: Vec<u16> = letters.chunks_exact(2).map(|it| u16::from_le_bytes([it[0], it[1]])).collect();
    let text = String::from_utf16_lossy(&letters).trim_matches(['\0', ' ']).to_owned();
    (!text.is_empty()).then_some(text)
}

/// The class of an object.
fn class(object: &[u8]) -> Option<u32> {
    u32_of(object, &[1, 1])
}

/// The objects of a list, in front of each of which its length stands.
fn objects(list: &[u8]) -> io::Result<Vec<&[u8]>> {
    let mut at = ByteReader::new(list);
    let mut objects = Vec::new();
    while !at.rest().is_empty() {
        at.i64()?;
        let (tag, object) = entry(&mut at)?;
        objects.extend((tag == 1).then_some(object));
    }
    Ok(objects)
}

/// What the document says of the software that wrote it.
fn header(main: &[u8]) -> Vec<(String, String)> {
    let version: Option<Vec<String>> =
        (1..=4).map(|part| u32_of(main, &[0xc8, part]).map(|it| it.to_string())).collect();
    let serial = text(main, &[0xcb]).map(|it| ("Serial number".to_owned(), it));
    version.map(|it| ("Version".to_owned(), it.join("."))).into_iter().chain(serial).collect()
}

/// A scale along an axis: metres of a step and of its origin, none for one that is no length.
struct MntScale {
    step: Option<f64>,
    origin: f64,
}

impl MntScale {
    fn new(data: &[u8], name: &str) -> io::Result<Self> {
        let missing = || malformed(format!("its axis {name} has no step with a unit"));
        let (step, unit) = f64_of(data, &[1]).zip(text(data, &[2])).ok_or_else(missing)?;
        let shown = text(data, &[3]).unwrap_or_else(|| unit.clone());
        let origin = f64_of(data, &[5]).unwrap_or(0.0);
        Ok(Self { step: metres(&unit).map(|it| it * step), origin: metres(&shown).map_or(0.0, |it| it * origin) })
    }
}

/// The channel of a measured surface.
fn surface<'a>(object: &[u8], title: &str) -> io::Result<Channel<'a>> {
    let missing = |what: &str| malformed(format!("its surface {title:?} has no {what}"));
    let measurement = find(object, &[2, 1]).filter(|it| class(it) == Some(MEASUREMENT));
    let data = measurement.and_then(|it| find(it, &[2, PARENT])).ok_or_else(|| missing("measurement"))?;
    let axis = |tag: u16, name: &str| {
        let axis = find(data, &[PARENT, tag, PARENT]).ok_or_else(|| missing("axes"))?;
        let count = u32_of(axis, &[1]).ok_or_else(|| missing("number of points"))?;
        Ok::<_, io::Error>((MntScale::new(find(axis, &[PARENT]).unwrap_or_default(), name)?.step, count))
    };
    let [(x, columns), (y, rows)] = [axis(1, "x")?, axis(2, "y")?];
    let scale = MntScale::new(find(data, &[2, PARENT]).ok_or_else(|| missing("axis of heights"))?, "z")?;
    let heights = find(data, &[1]).filter(|it| class(it) == Some(HEIGHTS)).ok_or_else(|| missing("heights"))?;
    let heights = MntBlocks::new(heights)?;
    let shape = nodes(rows.into(), columns.into(), 2, heights.total)?;
    let mask = find(data, &[PARENT, 3]).filter(|it| class(it) == Some(MASK)).map(|it| mask(it, shape)).transpose()?;
    let name = text(data, &[PARENT, PARENT, PARENT, 1]).unwrap_or_else(|| title.to_owned());
    let spacing = y.zip(x).map(|(y, x)| [y, x]);
    let (step, origin) = (scale.step.unwrap_or(f64::NAN), scale.origin);
    let values = move || {
        let mut values = heights.numbers(shape[0] * shape[1])?;
        values.iter_mut().for_each(|it| *it = *it * step + origin);
        if let Some(mask) = mask {
            hide(&mut values, &mask.bytes((shape[0] + 2) * (shape[1] + 2))?, shape);
        }
        Ok(values)
    };
    Ok(Channel {
        is_height: scale.step.is_some(),
        lateral_unit: spacing.map(|_| 1.0),
        spacing,
        unit: Some(1.0),
        ..Channel::map(name, shape, values)
    })
}

/// The points of a mask, which has a rim of one point around the surface.
fn mask(mask: &[u8], shape: [usize; 2]) -> io::Result<MntBlocks> {
    let counts = u32_of(mask, &[2, 2]).zip(u32_of(mask, &[2, 1])).map(|(ny, nx)| [ny as usize, nx as usize]);
    let points = find(mask, &[2, 5]).filter(|it| class(it) == Some(POINTS) && counts == Some(shape));
    MntBlocks::new(
        points.ok_or_else(|| malformed(format!("its mask does not have the {shape:?} points of its surface")))?,
    )
}

/// Makes those values void that a mask with a rim does not call measured.
fn hide(values: &mut [f64], mask: &[u8], [_, nx]: [usize; 2]) {
    let rows = mask.chunks_exact(nx + 2).skip(1);
    for (row, marks) in values.chunks_exact_mut(nx).zip(rows) {
        row.iter_mut().zip(&marks[1..]).filter(|(_, mark)| **mark != MEASURED).for_each(|(value, _)| *value = f64::NAN);
    }
}

/// Numbers in blocks of zlib, in any order.
struct MntBlocks {
    /// Bytes of all numbers.
    total: usize,
    packed: Vec<u8>,
}

impl MntBlocks {
    /// The blocks of an array.
    fn new(array: &[u8]) -> io::Result<Self> {
        let data = find(array, &[2, 2]).ok_or_else(|| malformed("its array has no numbers"))?;
        let mut at = ByteReader::new(data);
        let total = usize::try_from(at.i64()?).unwrap_or(usize::MAX);
        let packed = at.rest().to_vec();
        match total <= packed.len().saturating_mul(LARGEST_RATIO) {
            true => Ok(Self { total, packed }),
            false => Err(malformed(format!("its array states {total} bytes, which {} cannot hold", packed.len()))),
        }
    }

    /// As many integers.
    fn numbers(&self, count: usize) -> io::Result<Vec<f64>> {
        let bytes = self.bytes(count)?;
        match bytes.len() / count {
            2 => bytes.chunks_exact(2).map(|it| ByteReader::new(it).i16().map(f64::from)).collect(),
            4 => bytes.chunks_exact(4).map(|it| ByteReader::new(it).i32().map(f64::from)).collect(),
            size => Err(malformed(format!("its heights have {size} bytes each, neither 2 nor 4"))),
        }
    }

    /// The bytes of as many numbers, each block at its place.
    fn bytes(&self, count: usize) -> io::Result<Vec<u8>> {
        let size = self.total / count;
        if size == 0 || size * count != self.total {
            return Err(malformed(format!("its array states {} bytes for {count} numbers", self.total)));
        }
        let (mut bytes, mut left, mut block) = (vec![0; self.total], self.total, Vec::new());
        let mut at = ByteReader::new(&self.packed);
        while !at.rest().is_empty() {
            let (start, numbers, packed) = (at.i64()?, at.u32()? as usize, at.u32()? as usize);
            let stream = at.take(packed)?;
            let start = usize::try_from(start).unwrap_or(usize::MAX).saturating_mul(size);
            let length = numbers.saturating_mul(size);
            let beyond = || malformed(format!("it has a block of {numbers} numbers beyond the end of its array"));
            left = left.checked_sub(length).ok_or_else(beyond)?;
            let place = bytes.get_mut(start..start.saturating_add(length)).ok_or_else(beyond)?;
            block.clear();
            unpack(stream, length as u64, &mut block)
                .map_err(|error| malformed(format!("its numbers cannot be unpacked: {error}")))?;
            match block.len() == length {
                true => place.copy_from_slice(&block),
                false => return Err(malformed(format!("it has a block with fewer than {numbers} numbers"))),
            }
        }
        match left {
            0 => Ok(bytes),
            _ => Err(malformed(format!("{left} bytes of its array are missing"))),
        }
    }
}
