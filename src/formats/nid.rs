//! The files of Nanosurf's scanning probe microscopes.

use super::bytes::{ByteReader, latin, left_over};
use super::channel::{Channel, may_be_height, new_name};
use super::entries::{Entries, EntrySection, sections};
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::check_channels;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use super::unit::metres_of_si;
use std::io;

/// A header of `[parts]` with lines of `name=value`, a line that begins with `#!`, and behind these two letters the channels one after the
/// other as integers. The part `DataSet` names the part of each channel, `Gr0-Ch1` that of the second channel of the first group; those that
/// are not there have no numbers. The part of a channel says rows (`Lines`) and columns (`Points`), bits, sign and order of bytes of a number,
/// and for each of the axes 0, 1 and 2, thus x, y and z, the unit, the range, and the value at its lower end: the numbers of so many bits span
/// the range of z. Rows follow each other upwards, so that the last one is at `y = 0`. No value is void.
///
/// # Source
/// Gwyddion (`ezdfile.c`) and SurfaceTopography 1.27 (`EZD.py`).
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Nanosurf (NID, EZD)", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"[DataSet]";
/// What the numbers follow.
const DATA: &[u8] = b"\n#!";

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let end = bytes.windows(DATA.len()).position(|it| it == DATA);
    let end = end.ok_or_else(|| malformed("its header has no end, which is a line that begins with #!"))?;
    let sections = sections(&latin(&bytes[..end]), '=');
    let find = |name: &str| sections.iter().find(|it| it.name == name).map(|it| &it.entries);
    let mut parts: Vec<_> =
        find("DataSet").into_iter().flat_map(Entries::iter).filter_map(|it| Some((place(it.0)?, it.1))).collect();
    parts.sort_unstable();
    let parts: Vec<&EntrySection> =
        parts.iter().filter_map(|it| sections.iter().find(|section| section.name == it.1)).collect();
    check_channels(parts.len())?;
    let common = find("DataSet-Info").cloned().unwrap_or_default();
    let mut at = ByteReader::new(bytes).seek(end + DATA.len())?;
    let mut channels: Vec<Channel> = Vec::new();
    for part in parts {
        let name = format!("{} ({})", part.entries.need("Frame")?, part.entries.need("Dim2Name")?);
        let name = new_name(&name, &channels);
        channels.push(channel(&mut at, name, &part.entries, &common)?);
    }
    let rest = left_over(at.rest().len(), "the last channel");
    channels.iter_mut().for_each(|it| it.doubts.extend(rest.clone()));
    Ok(channels)
}

/// Group and channel out of a name such as `Gr0-Ch1`.
fn place(name: &str) -> Option<[u32; 2]> {
    let (group, channel) = name.strip_prefix("Gr")?.split_once("-Ch")?;
    Some([group.parse().ok()?, channel.parse().ok()?])
}

/// The channel of a part, whose numbers are the next ones.
fn channel<'a>(at: &mut ByteReader<'a>, name: String, part: &Entries, common: &Entries) -> io::Result<Channel<'a>> {
    *at = at.big_endian(part.need("SaveOrder")? != "Intel");
    let kind = number_type(&name, part)?;
    let raster = ChannelRaster::new(at, kind, [part.number("Lines")?, part.number("Points")?])?;
    let [ny, nx] = raster.shape;
    let mut entries = common.clone();
    entries.extend(part.clone());
    let unit = metres_of_si(part.need("Dim2Unit")?).filter(|_| may_be_height(&name));
    let map = Channel { header: entries.header(), ..Channel::map(name, raster.shape, || Ok(Vec::new())) };
    let Some(unit) = unit else { return Ok(Channel { is_height: false, ..map }) };
    let [range, lowest] = [finite(part, "Dim2Range")?, finite(part, "Dim2Min")?];
    let steps = 256_f64.powi(kind.size() as i32);
    let first = if part.need("SaveSign")? == "Signed" { steps / 2.0 } else { 0.0 };
    let height = move |number: f64| (number + first) / steps * range + lowest;
    let values = move || Ok(raster.numbers_from_below()?.into_iter().map(height).collect());
    let spacing = [finite(part, "Dim1Range")? / ny as f64, finite(part, "Dim0Range")? / nx as f64];
    let lateral = [metres_of_si(part.need("Dim1Unit")?), metres_of_si(part.need("Dim0Unit")?)];
    Ok(Channel { unit: Some(unit), values: Box::new(values), ..map.spaced(spacing, lateral) })
}

/// The type of the numbers of a channel.
fn number_type(name: &str, part: &Entries) -> io::Result<NumberType> {
    let mode = part.need("SaveMode")?;
    if mode != "Binary" {
        return Err(malformed(format!("its channel {name:?} is saved as {mode:?}: save it as \"Binary\"")));
    }
    match (part.number("SaveBits")?, part.need("SaveSign")?) {
        (8, "Signed") => Ok(NumberType::I8),
        (16, "Signed") => Ok(NumberType::I16),
        (32, "Signed") => Ok(NumberType::I32),
        (8, _) => Ok(NumberType::U8),
        (16, _) => Ok(NumberType::U16),
        (32, _) => Ok(NumberType::U32),
        (bits, _) => Err(malformed(format!("its channel {name:?} has {bits} bits per point, none of 8, 16 and 32"))),
    }
}

/// A number that is finite.
fn finite(part: &Entries, name: &str) -> io::Result<f64> {
    match part.number(name)? {
        value if f64::is_finite(value) => Ok(value),
        value => Err(malformed(format!("its header has the invalid value {name} = {value:?}"))),
    }
}
