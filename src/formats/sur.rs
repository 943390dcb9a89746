//! Surfaces and profiles of Digital Surf's Mountains and of the instruments that write for it.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::LARGEST_RATIO;
use super::unit::{lateral, metres, ratio};
use super::zlib::unpack;
use std::borrow::Cow;
use std::io;

/// Objects one after the other, each of a header of 512 bytes, a comment, a private zone and points of 16 or 32 bits row by row, the least
/// significant byte first; the first header says how many objects there are. Points are numbers times the step along z plus the offset
/// along z, in the unit of that step. Where the header says that there are points without a measurement, they are those two below the
/// smallest number. Compressed points are streams of zlib behind a directory of their lengths.
///
/// # Source
/// The readers of Gwyddion (`surffile.c`), RosettaSciIO (`digitalsurf`) and surfalize (`sur.py`), which follow the description that comes
/// with the software. RosettaSciIO measures numbers from the smallest one on, which moves the heights as a whole; the others do not. An
/// inversion of the heights that the header mentions is not undone.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Digital Surf (SUR, PRO)", is_it, channels };

/// What objects of plain and of compressed points begin with.
const MAGIC: [&[u8; 12]; 2] = [b"DIGITAL SURF", b"DSCOMPRESSED"];
/// The kinds of files whose objects all are profiles or surfaces: one, a series, several layers.
const HEIGHTS: [i16; 6] = [1, 2, 4, 5, 7, 8];
/// The kinds of files whose first object is a surface and whose others are images of it.
const PICTURED: [i16; 3] = [11, 13, 16];

fn is_it(bytes: &[u8]) -> bool {
    MAGIC.iter().any(|magic| bytes.starts_with(*magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes);
    let first = ObjectHeader::new(&mut at)?;
    let (kind, count) = (first.kind, first.count);
    let mut channels = vec![Channel::or_unreadable(object_name(0), first.channel(kind, 0))];
    for place in 1..count {
        match ObjectHeader::new(&mut at) {
            Ok(object) => channels.push(Channel::or_unreadable(object_name(place), object.channel(kind, place))),
            // where the objects behind it are is not known
            Err(error) => {
                channels.push(Channel::or_unreadable(object_name(place), Err(error)));
                return Ok(channels);
            }
        }
    }
    let rest = left_over(at.rest().len(), "the last object");
    channels.iter_mut().for_each(|it| it.doubts.extend(rest.clone()));
    Ok(channels)
}

/// The name of an object that cannot be read.
fn object_name(place: usize) -> String {
    format!("object {}", place + 1)
}

/// Points as they are in the file.
enum PointData<'a> {
    Plain(&'a [u8]),
    /// Streams and the lengths of what they hold.
    Packed(Vec<(&'a [u8], u32)>),
}

impl<'a> PointData<'a> {
    /// The streams behind a directory.
    fn packed(at: &mut ByteReader<'a>) -> io::Result<Self> {
        let lengths = (0..at.u32()?).map(|_| Ok((at.u32()?, at.u32()?))).collect::<io::Result<Vec<_>>>()?;
        let streams = lengths.into_iter().map(|(length, packed)| Ok((at.take(packed as usize)?, length)));
        Ok(Self::Packed(streams.collect::<io::Result<_>>()?))
    }

    /// The bytes that they can have at most.
    fn length(&self) -> usize {
        match self {
            Self::Plain(bytes) => bytes.len(),
            Self::Packed(streams) => streams.iter().map(|it| it.0.len().saturating_mul(LARGEST_RATIO)).sum(),
        }
    }

    /// The first `count` bytes, or all that there are.
    fn bytes(self, count: usize) -> io::Result<Cow<'a, [u8]>> {
        match self {
            Self::Plain(bytes) => Ok(bytes.into()),
            Self::Packed(streams) => {
                let mut bytes = Vec::new();
                for (stream, length) in streams {
                    let length = count.saturating_sub(bytes.len()).min(length as usize);
                    unpack(stream, length as u64, &mut bytes)
                        .map_err(|error| malformed(format!("its points cannot be unpacked: {error}")))?;
                }
                Ok(bytes.into())
            }
        }
    }
}

/// An object of a file.
struct ObjectHeader<'a> {
    count: usize,
    kind: i16,
    has_voids: bool,
    /// Bytes of a point.
    size: usize,
    smallest: i32,
    shape: [i64; 2],
    /// Points as the header counts them again.
    total: i64,
    /// Numbers at each place of the map: more than one for spectra.
    depth: usize,
    steps: [f32; 3],
    offset: f32,
    name: String,
    units: [String; 3],
    header: Vec<(String, String)>,
    points: PointData<'a>,
}

/// Refuses the numbers of machines other than PCs.
fn check_machine(kind: i16) -> io::Result<()> {
    match kind {
        0 => Ok(()),
        _ => Err(malformed(format!("it is written for machines of type {kind}: only the type PC can be read"))),
    }
}

/// The size of a point in bytes.
fn bytes_of_point(bits: i16) -> io::Result<usize> {
    match bits {
        16 | 32 => Ok(bits as usize / 8),
        _ => Err(malformed(format!("its points have {bits} bits, neither 16 nor 32"))),
    }
}

impl<'a> ObjectHeader<'a> {
    /// The object at a place, and the place behind it.
    fn new(at: &mut ByteReader<'a>) -> io::Result<Self> {
        let is_packed = is_packed(at)?;
        check_machine(at.i16()?)?;
        let objects = at.i16()?;
        at.i16()?; // version
        let kind = at.i16()?;
        let [object, operator] = [at.text(30)?, at.text(30)?];
        let parts = at.i16()?;
        let acquisition = at.i16()?;
        at.i16()?; // range
        let has_voids = at.i16()? == 1;
        at.take(2 + 4)?; // absolute heights, resolution of the gauge
        let depth = at.i32()?.max(1) as usize;
        let bits = at.i16()?;
        let [smallest, _, columns, rows, total] = [at.i32()?, at.i32()?, at.i32()?, at.i32()?, at.i32()?];
        let steps = [at.f32()?, at.f32()?, at.f32()?];
        let [x, y, name] = [at.text(16)?, at.text(16)?, at.text(16)?];
        let units = [at.text(16)?, at.text(16)?, at.text(16)?];
        at.take(3 * 16 + 3 * 4)?; // units of lengths, ratios of both kinds of units
        let [replica, inverted, levelled] = [at.i16()?, at.i16()?, at.i16()?];
        at.take(12)?;
        let date = date(at)?;
        let seconds = at.f32()?;
        at.take(10)?;
        let [comment, private] = [at.u16()?, at.u16()?].map(usize::from);
        at.take(128 + 2 * 4)?; // the client's zone, offsets along x and y
        let offset = at.f32()?;
        at.take(34)?;
        let comment = at.text(comment)?;
        at.take(private)?;
        let header = [
            ("object", object),
            ("operator", operator),
            ("date", date),
            ("duration in seconds", known(seconds)),
            ("acquisition", known(acquisition)),
            ("replica", known(replica)),
            ("inversion", known(inverted)),
            ("levelling", known(levelled)),
            ("offset along z", known(offset)),
            ("axes", format!("{x}, {y}, {name}")),
            ("comment", comment),
        ];
        let header = header.into_iter().filter(|it| !it.1.is_empty()).map(|it| (it.0.to_owned(), it.1)).collect();
        let size = bytes_of_point(bits)?;
        let shape = [rows, columns].map(i64::from);
        let points = if is_packed { PointData::packed(at)? } else { plain(at, shape, size, depth)? };
        let total = i64::from(total);
        let count = objects.max(1) as usize * parts.max(1) as usize;
        Ok(Self {
            count,
            kind,
            has_voids,
            size,
            smallest,
            shape,
            total,
            depth,
            steps,
            offset,
            name,
            units,
            header,
            points,
        })
    }

    /// The channel of an object by its place in a file of a kind.
    fn channel(self, kind: i16, place: usize) -> io::Result<Channel<'a>> {
        let size = self.size.saturating_mul(self.depth);
        let shape = nodes(self.shape[0], self.shape[1], size, self.points.length())?;
        let [x, y, z] = self.steps.map(f64::from);
        let [along_x, along_y, unit] = self.units.each_ref().map(|it| metres(it));
        let is_profile = shape[0] == 1 && [1, 4, 7].contains(&kind);
        let across = if is_profile { x } else { y * ratio(along_y, along_x) };
        let name = if self.name.is_empty() { "height" } else { &self.name };
        let name = if place == 0 { name.to_owned() } else { format!("{name} {}", place + 1) };
        let may_be = HEIGHTS.contains(&kind) || (PICTURED.contains(&kind) && place == 0);
        let is_height = may_be && self.depth == 1 && (unit.is_some() || self.units[2].is_empty());
        let void = self.has_voids.then(|| i64::from(self.smallest) - 2);
        let (points, size, offset, count) = (self.points, self.size, f64::from(self.offset), shape[0] * shape[1]);
        let height = move |number: i64| if Some(number) == void { f64::NAN } else { number as f64 * z + offset };
        let values = move || {
            let bytes = points.bytes(count * size)?;
            bytes.chunks_exact(size).take(count).map(|it| Ok(height(number(it)?))).collect()
        };
        let doubt = (self.total > 0 && self.total != count as i64)
            .then(|| format!("it states {} points, but {} rows of {} are {count}", self.total, shape[0], shape[1]));
        Ok(Channel {
            is_height,
            is_profile,
            doubts: doubt.into_iter().collect(),
            spacing: Some([across, x]),
            lateral_unit: if is_profile { along_x } else { lateral(along_y, along_x) },
            unit,
            header: self.header,
            ..Channel::map(name, shape, values)
        })
    }
}

/// Whether the object at a place has compressed points.
fn is_packed(at: &mut ByteReader) -> io::Result<bool> {
    match at.take(12)? {
        magic if magic == MAGIC[0] => Ok(false),
        magic if magic == MAGIC[1] => Ok(true),
        other => Err(malformed(format!("it has {:?} instead of an object at byte {}", latin(other), at.at() - 12))),
    }
}

/// The date and the time of a measurement, nothing where the year is not known.
fn date(at: &mut ByteReader) -> io::Result<String> {
    let [second, minute, hour, day, month, year, _] =
        [at.i16()?, at.i16()?, at.i16()?, at.i16()?, at.i16()?, at.i16()?, at.i16()?];
    let date = || format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02}");
    Ok(if year > 0 { date() } else { String::new() })
}

/// Points that are not compressed.
fn plain<'a>(at: &mut ByteReader<'a>, shape: [i64; 2], size: usize, depth: usize) -> io::Result<PointData<'a>> {
    let size = size.saturating_mul(depth);
    let [ny, nx] = nodes(shape[0], shape[1], size, at.rest().len())?;
    Ok(PointData::Plain(at.take(ny * nx * size)?))
}

/// The number in two or four bytes.
fn number(bytes: &[u8]) -> io::Result<i64> {
    let is_short = bytes.len() == 2;
    let mut bytes = ByteReader::new(bytes);
    Ok(if is_short { bytes.i16()?.into() } else { bytes.i32()?.into() })
}

/// The text of a number, none for zero.
fn known<T: Default + PartialEq + ToString>(number: T) -> String {
    if number == T::default() { String::new() } else { number.to_string() }
}
