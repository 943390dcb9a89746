//! The binary waves of Igor Pro, and with them the maps of Asylum Research's microscopes.

use super::bytes::{ByteReader, latin, left_over};
use super::channel::{Channel, may_be_height, new_name};
use super::entries::Entries;
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::check_channels;
use super::number_type::NumberType;
use super::raster::ChannelRaster;
use super::unit::metres_of_si;
use std::io;

/// A header whose version also tells the order of bytes, a wave of numbers, and texts. A wave of version 5 has up to three axes, the first one
/// the fastest: x, y and layers. Older waves have one, and are profiles. The header says the distance of neighbours along each axis, and the
/// units of distances and of numbers; units of more than three letters are texts behind the numbers. Rows follow each other upwards, so that
/// the last one is at `y = 0`. Layers have the labels of the third axis, whose first label is that of the axis itself. No value is void but
/// NaN. In files of Asylum Research all layers are stated to be metres, and those of a height or of the Z sensor are.
///
/// # Source
/// `IgorBin.h` of technical note 003 of WaveMetrics; Gwyddion (`igorfile.c`) for the files of Asylum Research and the order of rows.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Igor binary wave (IBW)", is_it, channels };

/// Bytes of the header of a wave of version 5, and of the older ones.
const WAVES: [usize; 2] = [320, 110];
/// Bytes behind the numbers of an older wave.
const PADDING: usize = 16;
/// Bytes of the label of a layer.
const LABEL: usize = 32;
/// What a file of maps of Asylum Research ends with.
const MAPS: &[u8] = b"MFP3D";
/// What a file of curves of Asylum Research ends with.
const CURVES: &[u8] = b"Force";
/// Words in the names of layers of heights in files of Asylum Research.
const HEIGHTS: [&str; 2] = ["height", "zsensor"];

/// The version, and the bytes behind it in their order.
fn version(bytes: &[u8]) -> Option<(u16, ByteReader<'_>)> {
    let mut at = ByteReader::new(bytes).big_endian(bytes.first() == Some(&0));
    Some((at.u16().ok()?, at))
}

/// Bytes of all headers of a version.
fn head(version: u16) -> Option<usize> {
    match version {
        1 => Some(8 + WAVES[1]),
        2 => Some(16 + WAVES[1]),
        3 => Some(20 + WAVES[1]),
        5 => Some(64 + WAVES[0]),
        _ => None,
    }
}

/// Whether the version is known and the numbers of two bytes in the headers add up to zero.
fn is_it(bytes: &[u8]) -> bool {
    let sum = || {
        let (version, mut at) = version(bytes)?;
        (2..head(version)?).step_by(2).try_fold(version, |sum, _| Some(sum.wrapping_add(at.u16().ok()?)))
    };
    sum() == Some(0)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    if bytes.ends_with(CURVES) {
        return Err(malformed("it contains force curves, not a map"));
    }
    let Some((version, at)) = version(bytes) else { return Ok(Vec::new()) };
    let wave = if version == 5 { IbwWave::new(at)? } else { IbwWave::old(version, at)? };
    let is_asylum = bytes.ends_with(MAPS);
    let [columns, rows, layers, more] = wave.counts.map(|it| it as usize);
    if more > 0 {
        return Err(malformed("its wave has four axes, but at most three are read: x, y and layers"));
    }
    check_channels(layers)?;
    let (is_profile, shape) = (rows == 0, [rows.max(1) as i64, columns as i64]);
    let across = if is_profile { 1 } else { 0 };
    let (steps, units) =
        ([across, 1].map(|i| wave.steps[i]), [across, 1].map(|i| metres_of_si(&wave.lateral_units[i])));
    let (kind, header, mut at) = (number_type(wave.kind)?, wave.header(), wave.numbers);
    let mut channels: Vec<Channel> = Vec::new();
    for layer in 0..layers.max(1) {
        let raster = ChannelRaster::new(&mut at, kind, shape)?;
        let name = new_name(&wave.layer_name(layer), &channels);
        let unit = metres_of_si(&wave.unit);
        let is_length = unit.is_some() || wave.unit.is_empty();
        let map = Channel::map(name, raster.shape, move || raster.numbers_from_below());
        channels.push(Channel {
            is_height: is_length && if is_asylum { is_height(&map.name) } else { may_be_height(&map.name) },
            is_profile,
            unit,
            header: header.clone(),
            ..map.spaced(steps, units)
        });
    }
    let rest = left_over(at.rest().len(), "the numbers of the wave");
    channels.iter_mut().for_each(|it| it.doubts.extend(rest.clone()));
    Ok(channels)
}

/// Whether a layer of Asylum Research holds heights, judged by its name.
fn is_height(name: &str) -> bool {
    let name = name.to_lowercase();
    HEIGHTS.iter().any(|word| name.contains(word))
}

/// The type of numbers by its code, whose bits are real types, and a flag for complex numbers and one for integers without a sign.
fn number_type(code: u16) -> io::Result<NumberType> {
    match code {
        0x02 => Ok(NumberType::F32),
        0x04 => Ok(NumberType::F64),
        0x08 => Ok(NumberType::I8),
        0x10 => Ok(NumberType::I16),
        0x20 => Ok(NumberType::I32),
        0x48 => Ok(NumberType::U8),
        0x50 => Ok(NumberType::U16),
        0x60 => Ok(NumberType::U32),
        0 => Err(malformed("its wave consists of texts, not of numbers")),
        _ if code & 1 == 1 => Err(malformed("its wave consists of complex numbers: save their real parts")),
        _ => Err(malformed(format!("its numbers are of the type {code:#04x}, which is not known"))),
    }
}

/// A wave, and what is said of it.
struct IbwWave<'a> {
    name: String,
    kind: u16,
    /// Points along x and y, layers, and points along a fourth axis; zero along an axis that the wave does not have.
    counts: [u32; 4],
    /// Distance of rows and of columns.
    steps: [f64; 2],
    /// Units of the distances of rows and of columns.
    lateral_units: [String; 2],
    unit: String,
    note: String,
    labels: Vec<String>,
    numbers: ByteReader<'a>,
}

impl<'a> IbwWave<'a> {
    /// The wave of a file of version 5.
    fn new(mut at: ByteReader<'a>) -> io::Result<Self> {
        at.u16()?; // check sum
        let [length, formula, note, unit] = [at.u32()?, at.u32()?, at.u32()?, at.u32()?].map(|it| it as usize);
        let lateral_units = [at.u32()?, at.u32()?, at.u32()?, at.u32()?].map(|it| it as usize);
        let labels = [at.u32()?, at.u32()?, at.u32()?, at.u32()?].map(|it| it as usize);
        at.take(3 * 4 + 3 * 4 + 4)?; // texts of a wave of texts, reserved; a pointer, dates, number of all points
        let kind = at.u16()?;
        at.take(2 + 6 + 2)?;
        let name = at.text(32)?;
        at.take(2 * 4)?;
        let counts = [at.u32()?, at.u32()?, at.u32()?, at.u32()?];
        let [x, y, ..] = [at.f64()?, at.f64()?, at.f64()?, at.f64()?];
        at.take(4 * 8)?; // positions of the first points
        let short = [at.text(4)?, at.text(4)?, at.text(4)?];
        let mut at = at.seek(64 + WAVES[0])?;
        let numbers = at.part(numbers_in(length, WAVES[0])?)?;
        at.take(formula)?;
        let note = latin(at.take(note)?);
        let long = [at.text(unit)?, at.text(lateral_units[0])?, at.text(lateral_units[1])?];
        at.take(lateral_units[2])?;
        at.take(lateral_units[3])?;
        at.take(labels[0])?;
        at.take(labels[1])?;
        let mut labels = at.part(labels[2])?;
        let labels = (0..labels.rest().len() / LABEL).map(|_| labels.text(LABEL)).collect::<io::Result<_>>()?;
        let [unit, x_unit, y_unit] = [0, 1, 2].map(|i| if long[i].is_empty() { &short[i] } else { &long[i] }.clone());
        Ok(Self { name, kind, counts, steps: [y, x], lateral_units: [y_unit, x_unit], unit, note, labels, numbers })
    }

    /// The wave of a file of an older version.
    fn old(version: u16, mut at: ByteReader<'a>) -> io::Result<Self> {
        let length = at.u32()? as usize;
        let note = if version > 1 { at.u32()? as usize } else { 0 };
        let formula = if version == 3 { at.u32()? as usize } else { 0 };
        at.take(if version > 1 { 4 + 2 } else { 2 })?; // reserved, check sum
        let kind = at.u16()?;
        at.take(4)?;
        let name = at.text(20)?;
        at.take(2 + 2 + 4)?;
        let [unit, lateral_unit] = [at.text(4)?, at.text(4)?];
        let count = at.u32()?;
        at.take(2)?;
        let step = at.f64()?;
        let mut at = at.seek(head(version).unwrap_or_default())?;
        let numbers = at.part(numbers_in(length, WAVES[1] + PADDING)?)?;
        // some writers leave out what is behind the numbers
        at.take(PADDING.min(at.rest().len()))?;
        let note = latin(at.take(note.min(at.rest().len()))?);
        at.take(formula.min(at.rest().len()))?;
        let (counts, labels) = ([count, 0, 0, 0], Vec::new());
        let lateral_units = [lateral_unit.clone(), lateral_unit];
        Ok(Self { name, kind, counts, steps: [step; 2], lateral_units, unit, note, labels, numbers })
    }

    /// The name of a layer: its label, or that of the wave if there are no others.
    fn layer_name(&self, layer: usize) -> String {
        let label = self.labels.get(layer + 1).filter(|it| !it.is_empty());
        let wave = Some(&self.name).filter(|it| self.counts[2] < 2 && !it.is_empty());
        label.or(wave).cloned().unwrap_or_else(|| format!("layer {}", layer + 1))
    }

    /// The name of the wave and the lines of its note.
    fn header(&self) -> Vec<(String, String)> {
        let mut entries = Entries::default();
        entries.push("Wave", &self.name);
        entries.extend(Entries::from_lines(self.note.split(['\r', '\n']), ':'));
        entries.header()
    }
}

/// Bytes of the numbers, of a length that includes those of a header.
fn numbers_in(length: usize, header: usize) -> io::Result<usize> {
    let none = || malformed(format!("its wave has {length} bytes, fewer than its header of {header} bytes"));
    length.checked_sub(header).ok_or_else(none)
}
