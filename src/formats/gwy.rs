//! Channels of Gwyddion.

use super::bytes::{ByteReader, latin, nodes};
use super::channel::Channel;
use super::format::malformed;
use super::instrument::Instrument;
use super::unit::metres_of_si;
use std::collections::HashMap;
use std::io;

/// A tree of objects, each a name, a length and components of a name, a type and a value, the least significant byte
/// first. The channel of number N is the data field `/N/data`, whose heights are double-precision numbers row by row
/// from the top in base units; its title is `/N/data/title`, its metadata `/N/meta`. Points that its mask `/N/mask`
/// marks are void: that is how Gwyddion keeps missing points of other files, whose heights it makes up. Graphs, volumes
/// and point clouds are passed over.
///
/// # Source
/// "Gwyddion file format" in the user's guide of Gwyddion 2.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Gwyddion (GWY)", is_it, channels };

/// What a file of the version that is read begins with.
const MAGIC: &[u8] = b"GWYP";
/// A masked point has a number above this one.
const MASKED: f64 = 0.5;

fn is_it(bytes: &[u8]) -> bool {
    [MAGIC, b"GWYO", b"GWYQ"].iter().any(|magic| bytes.starts_with(magic))
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(malformed(format!(
            "it has the version {:?}, not GWYP: save it with Gwyddion 2",
            latin(&bytes[..4])
        )));
    };
    let file = ComponentMap::new(&mut ByteReader::new(rest))?;
    let mut numbers: Vec<u64> = file.components.keys().filter_map(|it| number(it)).collect();
    numbers.sort_unstable();
    Ok(numbers.into_iter().map(|it| Channel::or_unreadable(name(&file, it), channel(&file, it))).collect())
}

/// The number of the channel whose data have a name.
fn number(name: &str) -> Option<u64> {
    let number = name.strip_prefix('/')?.strip_suffix("/data")?.parse().ok()?;
    (name == format!("/{number}/data")).then_some(number)
}

/// The title of a channel, or else where it is.
fn name(file: &ComponentMap, number: u64) -> String {
    let title = file.text(&format!("/{number}/data/title")).filter(|it| !it.is_empty());
    title.map_or_else(|| format!("/{number}/data"), str::to_owned)
}

/// A value, of which an object and the numbers of an array are not read before they are asked for.
enum ComponentValue<'a> {
    Integer(i32),
    Double(f64),
    Text(String),
    Object(ByteReader<'a>),
    /// The bytes of double-precision numbers.
    Doubles(&'a [u8]),
    /// A value of no use here.
    Other,
}

impl<'a> ComponentValue<'a> {
    /// The value of a type at a place, and the place behind it.
    fn new(at: &mut ByteReader<'a>, kind: u8) -> io::Result<Self> {
        Ok(match kind {
            b'b' | b'c' => at.u8().map(|_| Self::Other)?,
            b'i' => Self::Integer(at.i32()?),
            b'q' => at.i64().map(|_| Self::Other)?,
            b'd' => Self::Double(at.f64()?),
            b's' => Self::Text(string(at)?),
            b'o' => {
                let object = *at;
                skip(at)?;
                Self::Object(object)
            }
            b'C' => array(at, 1).map(|_| Self::Other)?,
            b'I' => array(at, 4).map(|_| Self::Other)?,
            b'Q' => array(at, 8).map(|_| Self::Other)?,
            b'D' => Self::Doubles(array(at, 8)?),
            b'S' => (0..at.u32()?).try_for_each(|_| string(at).map(drop)).map(|()| Self::Other)?,
            b'O' => (0..at.u32()?).try_for_each(|_| skip(at).map(drop)).map(|()| Self::Other)?,
            _ => return Err(malformed(format!("it contains a value of the unknown type {:?}", char::from(kind)))),
        })
    }
}

/// The text up to the next zero.
fn string(at: &mut ByteReader) -> io::Result<String> {
    let length = at.rest().iter().position(|byte| *byte == 0);
    let length = length.ok_or_else(|| malformed(format!("the text at byte {} has no end", at.at())))?;
    let text = latin(at.take(length)?);
    at.u8()?;
    Ok(text)
}

/// The bytes of an array of items of a size.
fn array<'a>(at: &mut ByteReader<'a>, size: usize) -> io::Result<&'a [u8]> {
    let count = at.u32()? as usize;
    at.take(count.saturating_mul(size))
}

/// The name and the bytes of an object.
fn skip<'a>(at: &mut ByteReader<'a>) -> io::Result<(String, &'a [u8])> {
    let name = string(at)?;
    let size = at.u32()?;
    Ok((name, at.take(size as usize)?))
}

/// The components of an object by their names.
struct ComponentMap<'a> {
    name: String,
    components: HashMap<String, ComponentValue<'a>>,
}

impl<'a> ComponentMap<'a> {
    fn new(at: &mut ByteReader<'a>) -> io::Result<Self> {
        let (name, bytes) = skip(at)?;
        let mut at = ByteReader::new(bytes);
        let mut components = HashMap::new();
        while !at.rest().is_empty() {
            let name = string(&mut at)?;
            let kind = at.u8()?;
            components.insert(name, ComponentValue::new(&mut at, kind)?);
        }
        Ok(Self { name, components })
    }

    /// The object of a name, if there is one.
    fn object(&self, name: &str) -> io::Result<Option<Self>> {
        match self.components.get(name) {
            Some(ComponentValue::Object(at)) => Self::new(&mut at.clone()).map(Some),
            _ => Ok(None),
        }
    }

    /// The text of a name.
    fn text(&self, name: &str) -> Option<&str> {
        match self.components.get(name) {
            Some(ComponentValue::Text(text)) => Some(text.trim()),
            _ => None,
        }
    }

    /// The integer of a name.
    fn integer(&self, name: &str) -> io::Result<i64> {
        match self.components.get(name) {
            Some(ComponentValue::Integer(integer)) => Ok((*integer).into()),
            _ => Err(malformed(format!("its {} has no integer {name:?}", self.name))),
        }
    }

    /// The double-precision number of a name.
    fn double(&self, name: &str) -> Option<f64> {
        match self.components.get(name) {
            Some(ComponentValue::Double(double)) => Some(*double),
            _ => None,
        }
    }

    /// The unit of a name: nothing where the object has none.
    fn unit(&self, name: &str) -> io::Result<String> {
        let unit = self.object(name)?;
        Ok(unit.and_then(|it| it.text("unitstr").map(str::to_owned)).unwrap_or_default())
    }

    /// Rows and columns of a data field, and the bytes of its numbers.
    fn field(&self) -> io::Result<([usize; 2], &'a [u8])> {
        let Some(ComponentValue::Doubles(bytes)) = self.components.get("data") else {
            return Err(malformed(format!("its {} has no data", self.name)));
        };
        Ok((nodes(self.integer("yres")?, self.integer("xres")?, 8, bytes.len())?, bytes))
    }
}

/// The numbers in bytes.
fn doubles(bytes: &[u8]) -> impl Iterator<Item = io::Result<f64>> {
    bytes.chunks_exact(8).map(|it| ByteReader::new(it).f64())
}

/// The channel of a number.
fn channel<'a>(file: &ComponentMap<'a>, number: u64) -> io::Result<Channel<'a>> {
    let named = |name: &str| format!("/{number}/{name}");
    let missing = || malformed(format!("its {} is not a data field", named("data")));
    let field = file.object(&named("data"))?.ok_or_else(missing)?;
    let (shape, bytes) = field.field()?;
    let mask = file.object(&named("mask"))?.map(|it| it.field()).transpose()?;
    if let Some(([ny, nx], _)) = mask.filter(|it| it.0 != shape) {
        return Err(malformed(format!("it masks {ny} rows of {nx} points of {} rows of {}", shape[0], shape[1])));
    }
    let [along, across] = [field.unit("si_unit_xy")?, field.unit("si_unit_z")?];
    let size = [field.double("yreal"), field.double("xreal")];
    let spacing = size[0].zip(size[1]).map(|(y, x)| [y / shape[0] as f64, x / shape[1] as f64]);
    let count = shape[0] * shape[1];
    let values = move || match mask {
        None => doubles(bytes).take(count).collect(),
        Some((_, mask)) => doubles(bytes).zip(doubles(mask)).take(count).map(|(z, m)| unmasked(z?, m?)).collect(),
    };
    Ok(Channel {
        is_height: across.is_empty() || metres_of_si(&across).is_some(),
        spacing,
        lateral_unit: metres_of_si(&along),
        unit: metres_of_si(&across),
        header: header(file, &field, &named("meta"), mask.is_some())?,
        ..Channel::map(name(file, number), shape, values)
    })
}

/// The height of a point, void if it is masked.
fn unmasked(height: f64, mask: f64) -> io::Result<f64> {
    Ok(if mask > MASKED { f64::NAN } else { height })
}

/// What is known of a channel, sorted by name.
fn header(file: &ComponentMap, field: &ComponentMap, meta: &str, is_masked: bool) -> io::Result<Vec<(String, String)>> {
    let meta = file.object(meta)?;
    let texts =
        meta.iter().flat_map(|it| it.components.keys().filter_map(|name| Some((name.as_str(), it.text(name)?))));
    let mut header: Vec<_> = texts.map(|(name, text)| (name.to_owned(), text.to_owned())).collect();
    header.sort_unstable();
    let offsets = ["xoff", "yoff"].into_iter().filter_map(|name| Some((name, field.double(name)?)));
    header.extend(offsets.map(|(name, offset)| (name.to_owned(), format!("{offset:?}"))));
    header.extend(is_masked.then(|| ("mask".to_owned(), "masked points are void".to_owned())));
    Ok(header)
}
