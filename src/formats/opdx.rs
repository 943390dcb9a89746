//! The OPDx files of Vision64, the software of Dektak profilers.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::{Channel, listed};
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::metres;
use std::io;

/// A tree of items, each of a name, a type and a content; a container ends in an item of the type 127. `1D_Data` holds profiles and `2D_Data`
/// maps, each of them heights or other values, row by row in the order of the file, times `DataScale`. Extents are those from the first to the
/// last point; a profile may have its positions too. Where `MetaData` names the channels of heights, only those are heights. Points that are
/// not numbers are void.
///
/// # Source
/// Gwyddion 2.61 (`dektakvca.c`) for types and names; SurfaceTopography 1.27 for matrices without a name and what extents mean.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Dektak OPDx", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"VCA DATA\x01\x00\x00\x55";
/// Containers within containers at most.
const DEPTH: usize = 32;
/// The longest name in bytes.
const LONGEST: usize = 1024;
/// The most profiles and maps that a file may have, each with a header of its own.
const MOST: usize = 32;
/// The most values of a header.
const VALUES: usize = 1000;
/// Bytes in front of the numbers of an array: their type and their size.
const ARRAY_HEAD: [u8; 5] = [DOUBLE, 8, 0, 0, 0];

/// Codes of types of items.
const MATRIX: u8 = 0x00;
const FLOAT: u8 = 0x0c;
const DOUBLE: u8 = 0x0d;
const TEXT: u8 = 0x12;
const QUANTITY: u8 = 0x13;
const UNIT: u8 = 0x18;
const ARRAY: u8 = 0x40;
const TEXTS: u8 = 0x42;
const NAMELESS_MATRIX: u8 = 0x45;
const END: u8 = 0x7f;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let mut at = ByteReader::new(bytes).seek(MAGIC.len())?;
    let root = Container(items(&mut at, 0)?);
    let about = root.container("MetaData");
    let header: Vec<_> = about.map(|it| it.header("", DEPTH).into_iter().take(VALUES).collect()).unwrap_or_default();
    let names = |dimension| about?.container(dimension)?.texts("Height");
    let mut found = Vec::new();
    for (part, dimension) in [("2D_Data", "2D_Channels"), ("1D_Data", "1D_Channels")] {
        let heights = names(dimension);
        for (name, data) in root.container(part).into_iter().flat_map(Container::containers) {
            let channel = if part == "2D_Data" { data.map(name) } else { data.profile(name) };
            let is_named = heights.as_ref().is_none_or(|it| it.iter().any(|it| it == name));
            found.push((name, channel.map(|it| Channel { is_height: it.is_height && is_named, ..it })));
        }
    }
    if found.len() > MOST {
        return Err(malformed(format!("it contains {} profiles and maps, but at most {MOST} are read", found.len())));
    }
    let mut channels = listed(found)?;
    channels.iter_mut().for_each(|it| it.header.clone_from(&header));
    let primary = about.and_then(|it| it.text("PrimaryData2D"));
    channels.sort_by_key(|it| it.is_profile || primary.as_deref() != Some(it.name.as_str()));
    Ok(channels)
}

/// A part of the tree.
struct OpdxItem<'a> {
    name: String,
    content: Content<'a>,
}

enum Content<'a> {
    Items(Container<'a>),
    /// The bytes of a value of a type.
    Value(u8, &'a [u8]),
}

struct Container<'a>(Vec<OpdxItem<'a>>);

/// The items up to the end of a container or of the bytes.
fn items<'a>(at: &mut ByteReader<'a>, depth: usize) -> io::Result<Vec<OpdxItem<'a>>> {
    if depth > DEPTH {
        return Err(malformed(format!("its containers are nested more than {DEPTH} times")));
    }
    let mut items = Vec::new();
    while !at.rest().is_empty() {
        let (name, kind) = (latin(name(at)?), at.u8()?);
        let content = match kind {
            END => break,
            0x46 | 0x47 | 0x7d => {
                let inner = sized(at)?;
                Content::Items(Container(self::items(&mut ByteReader::new(inner), depth + 1)?))
            }
            _ => Content::Value(kind, value(at, kind)?),
        };
        items.push(OpdxItem { name, content });
    }
    Ok(items)
}

/// The bytes of a value of a type.
fn value<'a>(at: &mut ByteReader<'a>, kind: u8) -> io::Result<&'a [u8]> {
    match kind {
        0x01 => at.take(1),
        0x04 | 0x05 => at.take(2),
        0x06 | 0x07 | FLOAT => at.take(4),
        0x0a | 0x0b | DOUBLE => at.take(8),
        0x15 => at.take(9),
        TEXT | QUANTITY | UNIT => sized(at),
        0x0e | ARRAY | TEXTS | NAMELESS_MATRIX | 0x7c => {
            name(at)?; // that of the type
            sized(at)
        }
        MATRIX => {
            name(at)?; // that of the type
            at.u32()?;
            name(at)?;
            sized(at)
        }
        _ => Err(malformed(format!("it has an item of the unknown type {kind} at byte {}", at.at()))),
    }
}

/// Bytes whose number is in the four bytes before them.
fn name<'a>(at: &mut ByteReader<'a>) -> io::Result<&'a [u8]> {
    match at.u32()? as usize {
        length @ ..=LONGEST => at.take(length),
        length => Err(malformed(format!("it has a name of {length} bytes at byte {}", at.at()))),
    }
}

/// Bytes whose number is in as many bytes before them as another byte says.
fn sized<'a>(at: &mut ByteReader<'a>) -> io::Result<&'a [u8]> {
    let length = match at.u8()? {
        1 => at.u8()?.into(),
        2 => at.u16()?.into(),
        4 => at.u32()? as usize,
        size => return Err(malformed(format!("it has a length of {size} bytes at byte {}", at.at()))),
    };
    at.take(length)
}

/// A number with a unit.
struct OpdxQuantity {
    value: f64,
    unit: String,
}

impl OpdxQuantity {
    fn new(bytes: &[u8]) -> io::Result<Self> {
        let mut at = ByteReader::new(bytes);
        Ok(Self { value: at.f64()?, unit: symbol(&mut at)? })
    }

    /// The number in metres, if it is a length.
    fn metres(&self) -> Option<f64> {
        Some(self.value * metres(&self.unit)?)
    }
}

/// The symbol behind the name of a unit.
fn symbol(at: &mut ByteReader) -> io::Result<String> {
    name(at)?;
    Ok(latin(name(at)?).trim_end_matches('.').to_owned())
}

impl<'a> Container<'a> {
    fn content(&self, name: &str) -> Option<&Content<'a>> {
        self.0.iter().find(|it| it.name == name).map(|it| &it.content)
    }

    fn container(&self, name: &str) -> Option<&Self> {
        match self.content(name)? {
            Content::Items(container) => Some(container),
            Content::Value(..) => None,
        }
    }

    /// All containers in this one and their names.
    fn containers(&self) -> impl Iterator<Item = (&str, &Self)> {
        self.0.iter().filter_map(|it| match &it.content {
            Content::Items(container) => Some((it.name.as_str(), container)),
            Content::Value(..) => None,
        })
    }

    /// The bytes of a value of one of some types.
    fn value(&self, name: &str, kinds: &[u8]) -> Option<&'a [u8]> {
        match self.content(name)? {
            Content::Value(kind, bytes) if kinds.contains(kind) => Some(bytes),
            _ => None,
        }
    }

    fn quantity(&self, name: &str) -> io::Result<OpdxQuantity> {
        let bytes = self.value(name, &[QUANTITY]);
        OpdxQuantity::new(bytes.ok_or_else(|| malformed(format!("it has no {name} of its points")))?)
    }

    fn text(&self, name: &str) -> Option<String> {
        self.value(name, &[TEXT]).map(latin)
    }

    fn texts(&self, list: &str) -> Option<Vec<String>> {
        let mut at = ByteReader::new(self.value(list, &[TEXTS])?);
        let texts = std::iter::from_fn(|| (!at.rest().is_empty()).then(|| name(&mut at).map(latin)));
        texts.collect::<io::Result<_>>().ok()
    }

    /// Names and values of all items, and of those in them.
    fn header(&self, before: &str, depth: usize) -> Vec<(String, String)> {
        let mut header = Vec::new();
        for OpdxItem { name, content } in &self.0 {
            match content {
                Content::Items(inner) if depth > 0 => header.extend(inner.header(&format!("{name}/"), depth - 1)),
                Content::Value(kind, bytes) => {
                    header.extend(text(*kind, bytes).map(|it| (format!("{before}{name}"), it)))
                }
                Content::Items(_) => {}
            }
            if header.len() >= VALUES {
                break;
            }
        }
        header
    }

    /// The channel of a map.
    fn map(&self, name: &str) -> io::Result<Channel<'a>> {
        let matrix = self.value("Matrix", &[MATRIX, NAMELESS_MATRIX]);
        let mut at = ByteReader::new(matrix.ok_or_else(|| malformed(format!("its map {name:?} has no Matrix")))?);
        let [rows, columns] = [at.u32()?, at.u32()?];
        let points = at.rest();
        let [ny, nx] = nodes(rows.into(), columns.into(), 1, points.len())?;
        let has_singles = (4..8).contains(&(points.len() / (nx * ny)));
        let extents = [self.quantity("Dimension1Extent")?, self.quantity("Dimension2Extent")?];
        let [y, x] = [step(&extents[0], ny), step(&extents[1], nx)];
        let spacing = y.zip(x).map(|(y, x)| [y, x]);
        let unit = self.quantity("DataScale")?.metres();
        let values = move || points.chunks_exact(4).take(nx * ny).map(single).collect();
        let rest = points.len().saturating_sub(4 * nx * ny);
        Ok(Channel {
            is_height: has_singles && unit.is_some(),
            lateral_unit: spacing.map(|_| 1.0),
            spacing,
            unit,
            doubts: left_over(rest, &format!("the points of {name:?}")).into_iter().collect(),
            ..Channel::map(name, [ny, nx], values)
        })
    }

    /// The channel of a profile.
    fn profile(&self, name: &str) -> io::Result<Channel<'a>> {
        let points = self.array("Array")?.ok_or_else(|| malformed(format!("its profile {name:?} has no Array")))?;
        let count = nodes(1, (points.len() / 8) as i64, 8, points.len())?[1];
        let extent = self.quantity("Extent")?;
        let positions = self.positions(count)?;
        let step = step(&extent, count);
        let unit = self.quantity("DataScale")?.metres();
        Ok(Channel {
            is_height: unit.is_some(),
            is_profile: true,
            spacing: step.filter(|_| positions.is_none()).map(|dx| [dx; 2]),
            lateral_unit: step.map(|_| 1.0),
            positions,
            unit,
            doubts: self.doubt(name, count).into_iter().collect(),
            ..Channel::map(name, [1, count], move || doubles(points))
        })
    }

    /// The doubt that a profile has another number of points than it says.
    fn doubt(&self, name: &str, count: usize) -> Option<String> {
        let stated = ByteReader::new(self.value("NumPoints", &[0x0a, 0x0b])?).i64().ok()?;
        (usize::try_from(stated) != Ok(count)).then(|| format!("{name:?} states {stated} points, but has {count}"))
    }

    /// The positions of as many points in metres, if they are there.
    fn positions(&self, count: usize) -> io::Result<Option<Vec<f64>>> {
        let Some(unit) = self.value("PositionUnits", &[UNIT]) else { return Ok(None) };
        let Some(unit) = metres(&symbol(&mut ByteReader::new(unit))?) else { return Ok(None) };
        let Some(positions) = self.array("PositionArray")?.filter(|it| it.len() == 8 * count) else { return Ok(None) };
        Ok(Some(doubles(positions)?.into_iter().map(|x| x * unit).collect()))
    }

    /// The bytes of the numbers of an array.
    fn array(&self, name: &str) -> io::Result<Option<&'a [u8]>> {
        let Some(bytes) = self.value(name, &[ARRAY]) else { return Ok(None) };
        let numbers = bytes.strip_prefix(&ARRAY_HEAD);
        numbers.map(Some).ok_or_else(|| malformed(format!("its array {name} holds other numbers than doubles")))
    }
}

/// The distance of as many points in metres, if it is a length.
fn step(extent: &OpdxQuantity, count: usize) -> Option<f64> {
    extent.metres().map(|extent| extent / (count - 1).max(1) as f64)
}

fn single(bytes: &[u8]) -> io::Result<f64> {
    ByteReader::new(bytes).f32().map(f64::from)
}

fn doubles(bytes: &[u8]) -> io::Result<Vec<f64>> {
    bytes.chunks_exact(8).map(|it| ByteReader::new(it).f64()).collect()
}

/// A value as a person reads it; none for an empty text and for types that say nothing to a person.
fn text(kind: u8, bytes: &[u8]) -> Option<String> {
    let mut at = ByteReader::new(bytes);
    match kind {
        0x01 => at.u8().ok().map(|it| (it != 0).to_string()),
        0x06 => at.i32().ok().map(|it| it.to_string()),
        0x07 => at.u32().ok().map(|it| it.to_string()),
        0x0a | 0x0b => at.i64().ok().map(|it| it.to_string()),
        FLOAT => at.f32().ok().map(|it| it.to_string()),
        DOUBLE => at.f64().ok().map(|it| it.to_string()),
        QUANTITY => OpdxQuantity::new(bytes).ok().map(|it| format!("{} {}", it.value, it.unit).trim().to_owned()),
        TEXT => Some(latin(bytes)),
        _ => None,
    }
    .filter(|it| !it.is_empty())
}
