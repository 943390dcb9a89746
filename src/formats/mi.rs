//! The files of PicoView, with which microscopes of Molecular Imaging, Agilent and Keysight measure.

use super::bytes::{ByteReader, latin, left_over, nodes};
use super::channel::{Channel, may_be_height, new_name};
use super::entries::Entries;
use super::format::malformed;
use super::instrument::Instrument;
use super::limits::check_channels;
use super::number_type::NumberType;
use super::raster::{ChannelRaster, from_below};
use super::unit::metres_of_si;
use std::io;

/// A header of lines whose first 14 bytes are a name and whose rest is a value, up to the line `data`, and numbers. Each line `bufferLabel`
/// begins a channel; those before it say points and lengths, which are metres. The value of `data` tells integers of two bytes (nothing or
/// `BINARY`), of four bytes (`BINARY_32`), and of two bytes as text (`ASCII`), all one channel after the other, and values of all channels
/// point by point as text below a line of names (`ASCII_MULTICOLUMN`). Integers span twice the `bufferRange`; values are in the `bufferUnit`.
/// Rows follow each other upwards, so that the last one is at `y = 0`. No value is void. Files of curves are refused.
///
/// # Source
/// Gwyddion (`mifile.c`); SurfaceTopography 1.27 (`MI.py`) for integers of four bytes.
pub(super) const INSTRUMENT: Instrument = Instrument { name: "Molecular Imaging (MI)", is_it, channels };

/// What a file begins with.
const MAGIC: &[u8] = b"fileType      ";
/// The last line of the header, up to its value.
const DATA: &[u8] = b"\ndata          ";
/// Bytes of a name.
const NAME: usize = 14;

fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

fn channels(bytes: &[u8]) -> io::Result<Vec<Channel<'_>>> {
    let end = bytes.windows(DATA.len()).position(|it| it == DATA);
    let end = end.ok_or_else(|| malformed("its header has no end, which is a line \"data\""))?;
    let (common, parts) = parts(&latin(&bytes[..end]));
    let kind = common.need("fileType")?;
    if kind != "Image" {
        return Err(malformed(format!("it is a file of the type {kind:?}, not an image")));
    }
    check_channels(parts.len())?;
    let rest = &bytes[end + DATA.len()..];
    let length = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
    let data = rest.get(length + 1..).unwrap_or_default();
    let image = MiImage { shape: [common.number("yPixels")?, common.number("xPixels")?], common, parts, data };
    match latin(&rest[..length]).trim() {
        "" | "BINARY" => image.binary(NumberType::I16),
        "BINARY_32" => image.binary(NumberType::I32),
        "ASCII" => image.text(false),
        "ASCII_MULTICOLUMN" => image.text(true),
        other => Err(malformed(format!("its numbers are of the type {other:?}, which is not known"))),
    }
}

/// What is said of the image, and of each channel.
fn parts(header: &str) -> (Entries, Vec<Entries>) {
    let (mut common, mut parts) = (Entries::default(), Vec::new());
    for line in header.lines() {
        let (name, value) = line.split_at_checked(NAME).unwrap_or((line, ""));
        if name.trim() == "bufferLabel" {
            parts.push(Entries::default());
        }
        parts.last_mut().unwrap_or(&mut common).push(name, value);
    }
    (common, parts)
}

/// A file of an image.
struct MiImage<'a> {
    /// Rows and columns as the header states them.
    shape: [i64; 2],
    common: Entries,
    parts: Vec<Entries>,
    data: &'a [u8],
}

impl<'a> MiImage<'a> {
    /// Channels of integers one after the other.
    fn binary(&self, kind: NumberType) -> io::Result<Vec<Channel<'a>>> {
        let mut at = ByteReader::new(self.data);
        let mut channels: Vec<Channel> = Vec::new();
        for part in &self.parts {
            let raster = ChannelRaster::new(&mut at, kind, self.shape)?;
            let scale = 2.0 * scale(part)? / 256_f64.powi(kind.size() as i32);
            let values = move || Ok(raster.numbers_from_below()?.into_iter().map(|it| it * scale).collect());
            let map = Channel::map(new_name(label(part), &channels), raster.shape, values);
            channels.push(self.finished(map, part)?);
        }
        let rest = left_over(at.rest().len(), "the last channel");
        channels.iter_mut().for_each(|it| it.doubts.extend(rest.clone()));
        Ok(channels)
    }

    /// Channels of text, one after the other or point by point.
    fn text(&self, is_by_point: bool) -> io::Result<Vec<Channel<'a>>> {
        let (data, parts) = (self.data, self.parts.len());
        let head = data.iter().position(|byte| *byte == b'\n').filter(|_| is_by_point);
        let data = &data[head.unwrap_or(0)..];
        let shape = nodes(self.shape[0], self.shape[1], 2 * parts, data.len() + 1)?;
        let count = shape[0] * shape[1];
        let mut channels: Vec<Channel> = Vec::new();
        for (i, part) in self.parts.iter().enumerate() {
            let scale = if is_by_point { 1.0 } else { scale(part)? / 32768.0 };
            let (first, step) = if is_by_point { (i, parts) } else { (i * count, 1) };
            let values = move || {
                let text = latin(data);
                let words = text.split_whitespace().skip(first).step_by(step).take(count);
                Ok(from_below(&words.map(|word| height(word, scale)).collect::<io::Result<Vec<_>>>()?, shape[1]))
            };
            let map = Channel::map(new_name(label(part), &channels), shape, values);
            channels.push(self.finished(map, part)?);
        }
        Ok(channels)
    }

    /// A channel with what is said of it.
    fn finished(&self, map: Channel<'a>, part: &Entries) -> io::Result<Channel<'a>> {
        let mut header = self.common.clone();
        header.extend(part.clone());
        let unit = part.find("bufferUnit").and_then(metres_of_si);
        let [ny, nx] = map.shape.map(|it| it as f64);
        let spacing = [self.common.number::<f64>("yLength")? / ny, self.common.number::<f64>("xLength")? / nx];
        let is_height = unit.is_some() && may_be_height(&map.name);
        Ok(Channel { is_height, unit, header: header.header(), ..map.spaced(spacing, [Some(1.0); 2]) })
    }
}

/// The name of a channel.
fn label(part: &Entries) -> &str {
    part.find("bufferLabel").filter(|it| !it.is_empty()).unwrap_or("image")
}

/// The value of the largest integer, one if it is not said.
fn scale(part: &Entries) -> io::Result<f64> {
    part.find("bufferRange").map_or(Ok(1.0), |_| part.number("bufferRange"))
}

/// The value of a word.
fn height(word: &str, scale: f64) -> io::Result<f64> {
    let number: f64 = word.parse().map_err(|_| malformed(format!("its heights contain {word:?}")))?;
    Ok(number * scale)
}
